//! The number types that formulas are evaluated on, without a branch on a value.
//!
//! [`Scalar`] is all that generated code and the kernels need. Decisions are
//! taken with masks ([`Scalar::equal`], [`Scalar::less`], [`Scalar::branch`]),
//! so that a bundle of SIMD lanes or a dual number can take the place of `f64`.
//! [`Real`] adds what a time step needs to decide something.

mod floats;
mod number;
mod real;

pub use number::Scalar;
pub use number::natural_power;
#[cfg(feature = "lanes")]
pub(crate) use real::sealed::Sealed;
pub use real::{Discord, Mask, Real};
pub use real::{MOST_LANES, is_positive, unless};
