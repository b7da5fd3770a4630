//! What a time step needs of its numbers to take decisions: comparisons that return masks.

use core::fmt::Debug;
use core::ops::{BitAnd, BitOr, Not};

use super::number::Scalar;

/// Several numbers in one would decide differently, so that they cannot take one branch together.
///
/// A single number never does. An [`Ensemble`](crate::Ensemble) runs the members of a bundle one by one
/// when this error reaches it, by `?`, from an [`Experiment`](crate::Experiment).
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("members that are stepped together would decide differently")]
pub struct Discord;

/// The result of a comparison: `bool`, or one `bool` for each of several numbers that move together.
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

    /// True everywhere. A branch on it must be right for every number, also for those whose own answer
    /// is another one: as in "an error of one number is an error of all".
    fn all(self) -> bool;

    /// True somewhere. A branch on it must be right for every number, as for [`all`](Self::all).
    fn any(self) -> bool;

    /// The one decision of all numbers, for a branch that differs between them.
    ///
    /// # Errors
    ///
    /// [`Discord`] if it is true for some numbers and false for others.
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

    #[inline]
    fn decide(self) -> Result<bool, Discord> {
        Ok(self)
    }
}

/// The largest [`Real::LANES`].
pub(crate) const MOST_LANES: usize = 4;

/// Keeps [`Real`] closed: what a step decides by masks is known to be right for these types only.
pub(crate) mod sealed {
    pub trait Sealed {}

    impl Sealed for f64 {}
    impl Sealed for f32 {}
}

/// A real number that a time step can take decisions on: `f64`, `f32`.
///
/// An [`Ensemble`](crate::Ensemble) puts several `f64` in the place of one, one for each of so many
/// scenes. Such numbers have no order: comparisons ([`equal`](Scalar::equal), [`less`](Scalar::less),
/// [`at_most`](Self::at_most)) return a [`Mask`], from which [`select`](Self::select) takes the right
/// value for each scene, and [`Mask::decide`] one branch for all of them, or the error that they differ.
/// `==` says whether all of them are equal; a branch on it hides that they differ.
///
/// The trait is sealed: `f64`, `f32` and the numbers of a bundle are all there are. A number for
/// evaluating formulas, as a dual number, implements [`Scalar`].
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

    /// Of how many numbers it consists.
    const LANES: usize = 1;

    /// The value in double precision, for messages and records; NaN for several numbers that differ.
    fn to_f64(self) -> f64;

    /// Neither infinite nor NaN, for every number.
    fn is_finite(self) -> bool;

    /// `self <= other`.
    fn at_most(self, other: Self) -> Self::Mask;

    /// `then` where the mask holds and `otherwise` elsewhere.
    #[inline]
    #[must_use]
    fn select(mask: Self::Mask, then: Self, otherwise: Self) -> Self {
        Self::branch(mask, || then, || otherwise)
    }

    /// The numbers of the lanes `0, 1, …` in one.
    #[inline]
    #[must_use]
    fn pack(mut number: impl FnMut(usize) -> f64) -> Self {
        Self::from_f64(number(0))
    }

    /// The number of one lane: to be put out, not to decide about the others.
    #[inline]
    fn lane(self, _: usize) -> f64 {
        self.to_f64()
    }
}

/// Finite and greater than zero.
#[inline]
pub(crate) fn is_positive<S: Real>(value: S) -> bool {
    (S::zero().less(value) & value.at_most(S::MAX)).all()
}

/// `kept` in the lanes that are settled, `new` in all others.
///
/// A single number that is settled is not asked any more.
#[inline]
pub(crate) fn unless<S: Real>(settled: S::Mask, kept: S, new: S) -> S {
    if S::LANES == 1 {
        new
    } else {
        S::select(settled, kept, new)
    }
}
