//! Decisions of a time step: comparisons that return masks.

use core::fmt::Debug;
use core::ops::{BitAnd, BitOr, Not};

use super::number::Scalar;

/// Numbers in SIMD lanes take different branches.
///
/// A single number never returns this error. If an `Experiment` returns it with `?`, the
/// `Ensemble` runs its members one by one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("members that are stepped together would decide differently")]
pub struct Discord;

/// The result of a comparison: a `bool`, or one `bool` per lane.
///
/// ```
/// use eem::Mask;
///
/// assert!(true.all() && true.any());
/// assert!(!bool::none().any());
/// assert_eq!(true.decide(), Ok(true));
/// ```
pub trait Mask:
    Copy
    + Debug
    + Send
    + Sync
    + 'static
    + BitAnd<Output = Self>
    + BitOr<Output = Self>
    + Not<Output = Self>
{
    /// False everywhere.
    fn none() -> Self;

    /// True everywhere. A branch on it must be correct for every lane, including those where the mask is false.
    fn all(self) -> bool;

    /// True somewhere. A branch on it must be correct for every lane, as for [`all`](Self::all).
    fn any(self) -> bool;

    /// The common value of all lanes, for a branch.
    ///
    /// # Errors
    ///
    /// [`Discord`] if it is true in some lanes and false in others.
    #[inline]
    fn decide(self) -> Result<bool, Discord> {
        let all = self.all();
        if all == self.any() {
            Ok(all)
        } else {
            Err(Discord)
        }
    }
}

impl Mask for bool {
    #[inline]
    fn none() -> Self {
        false
    }

    #[inline]
    fn all(self) -> bool {
        self
    }

    #[inline]
    fn any(self) -> bool {
        self
    }
}

/// The largest [`Real::LANES`].
pub const MOST_LANES: usize = 4;

/// Seals [`Real`]: the decisions of a step by masks are verified for these types only.
pub(crate) mod sealed {
    pub trait Sealed {}

    impl Sealed for f64 {}
    impl Sealed for f32 {}
}

/// A number type for time steps: `f64`, `f32`.
///
/// An `Ensemble` also uses several `f64` in SIMD lanes, one per scene. These have no order:
/// comparisons ([`equal`](Scalar::equal), [`less`](Scalar::less), [`at_most`](Self::at_most)) return a [`Mask`].
/// [`select`](Self::select) chooses a value per lane, and [`Mask::decide`] a common branch, or an error if lanes
/// differ. `==` compares all lanes at once; do not branch on it.
///
/// The trait is sealed. A number type for evaluating formulas only, such as dual numbers, implements [`Scalar`].
///
/// ```
/// use eem::Real;
///
/// assert_eq!(f32::EPSILON.to_f64(), 2.0_f64.powi(-23));
/// assert!(!Real::is_finite(f64::NAN));
/// assert_eq!(f64::select(2.0.at_most(1.0), 3.0, 4.0), 4.0);
/// ```
pub trait Real: Scalar<Mask: Mask> + sealed::Sealed {
    /// The distance from 1 to the next larger number.
    const EPSILON: Self;

    /// The largest finite number.
    const MAX: Self;

    /// The smallest positive number of full precision; smaller ones are subnormal.
    const MIN_POSITIVE: Self;

    /// The number of lanes.
    const LANES: usize = 1;

    /// Whether this is `f64`.
    const IS_DOUBLE: bool = false;

    /// The value in double precision, for messages and records; NaN if lanes differ.
    fn to_f64(self) -> f64;

    /// Neither infinite nor NaN, in every lane.
    fn is_finite(self) -> bool;

    /// `self <= other`.
    fn at_most(self, other: Self) -> Self::Mask;

    /// `then` where the mask holds and `otherwise` elsewhere.
    #[inline]
    #[must_use]
    fn select(mask: Self::Mask, then: Self, otherwise: Self) -> Self {
        Self::branch(mask, || then, || otherwise)
    }

    /// Packs one number per lane `0, 1, …`.
    #[inline]
    #[must_use]
    fn pack(mut number: impl FnMut(usize) -> f64) -> Self {
        Self::from_f64(number(0))
    }

    /// The number of one lane, for output.
    #[inline]
    fn lane(self, _: usize) -> f64 {
        self.to_f64()
    }
}

/// Finite and greater than zero.
#[inline]
pub fn is_positive<S: Real>(value: S) -> bool {
    (S::zero().less(value) & value.at_most(S::MAX)).all()
}

/// `kept` in the lanes that have converged, `new` in all others. A scalar number is not evaluated again once it has.
#[inline]
pub fn unless<S: Real>(converged: S::Mask, kept: S, new: S) -> S {
    if S::LANES == 1 {
        new
    } else {
        S::select(converged, kept, new)
    }
}
