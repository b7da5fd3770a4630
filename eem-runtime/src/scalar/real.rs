//! What a time step needs of its numbers to take decisions: an order, and one mask per decision.

use core::fmt::Debug;
use core::ops::{BitAnd, BitOr, Not};

use super::Scalar;

/// The result of a comparison: `bool`, or one `bool` for each of several numbers that move together.
///
/// ```
/// use eem_runtime::Mask;
///
/// assert!(true.all() && true.any() && true.decide());
/// assert!(!bool::none().any());
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

    /// True everywhere. What is decided by it must be right for all numbers: nobody notices that they
    /// differ.
    fn all(self) -> bool;

    /// True somewhere. What is decided by it must be right for all numbers: nobody notices that they
    /// differ.
    fn any(self) -> bool;

    /// The one decision for all numbers, as in a comparison with `<`. Numbers that would decide
    /// differently cannot go on together: then it is `false`, and what they compute is not used.
    fn decide(self) -> bool;
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
    fn decide(self) -> bool {
        self
    }
}

/// A real number that a time step can take decisions on: `f64`, `f32`.
///
/// An [`Ensemble`](crate::Ensemble) puts several `f64` in the place of one, one for each of so many
/// scenes. The operators of comparison then hold only if they hold for all of them, and an
/// ensemble whose scenes differ in what such a comparison says runs them one by one; masks
/// ([`less`](Scalar::less), [`at_most`](Self::at_most), [`select`](Self::select)) decide for each
/// scene apart.
///
/// ```
/// use eem_runtime::Real;
///
/// assert_eq!(f32::EPSILON.to_f64(), 2.0_f64.powi(-23));
/// assert!(!Real::is_finite(f64::NAN));
/// assert_eq!(f64::select(2.0.at_most(1.0), 3.0, 4.0), 4.0);
/// ```
pub trait Real: Scalar<Mask: Mask> + PartialOrd {
    /// The distance from 1 to the next larger number.
    const EPSILON: Self;

    /// The largest finite number.
    const MAX: Self;

    /// The smallest positive number of full precision; smaller ones are subnormal.
    const MIN_POSITIVE: Self;

    /// Of how many numbers it consists.
    const LANES: usize = 1;

    /// The value in double precision; of several numbers only if they are the same, else NaN.
    fn to_f64(self) -> f64;

    /// Neither infinite nor NaN.
    fn is_finite(self) -> bool;

    /// `self <= other`.
    fn at_most(self, other: Self) -> Self::Mask;

    /// `then` where the mask holds and `otherwise` elsewhere.
    #[inline]
    #[must_use]
    fn select(mask: Self::Mask, then: Self, otherwise: Self) -> Self {
        Self::branch(mask, || then, || otherwise)
    }

    /// Says that its numbers cannot go on together, as when a comparison holds for some of them;
    /// nothing for a single one.
    #[inline]
    fn give_up() {}

    /// Whether that has been said, or found by a comparison: then what they compute is not used.
    #[inline]
    #[must_use]
    fn has_given_up() -> bool {
        false
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
    (S::zero().less(value) & value.at_most(S::MAX)).decide()
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
