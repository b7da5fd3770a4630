//! The number types that formulas are evaluated on, without a branch on a value.
//!
//! Generated code and the kernels need [`Scalar`] only. They decide with masks ([`Scalar::equal`], [`Scalar::less`],
//! [`Scalar::branch`]), so that SIMD lanes or a dual number can replace `f64`. [`Real`] adds the decisions of a time step.

mod floats;
mod number;
mod real;

pub use number::{Scalar, natural_power};
#[cfg(feature = "lanes")]
pub(crate) use real::sealed::Sealed;
pub use real::{Discord, MOST_LANES, Mask, Real, is_positive, unless};
