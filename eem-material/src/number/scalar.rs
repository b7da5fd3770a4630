//! The number types that formulas are evaluated on, without a branch on a value.
//!
//! Generated code and the kernels need [`Scalar`] only. They decide with masks ([`Scalar::equal`], [`Scalar::less`],
//! [`Scalar::branch`]), so that SIMD lanes or a dual number can replace `f64`. [`Real`] adds the decisions of a time step.

mod floats;

use core::fmt::Debug;
use core::ops::{
    Add, AddAssign, BitAnd, BitOr, Div, DivAssign, Mul, MulAssign, Neg, Not, Sub, SubAssign,
};

pub(crate) use sealed::Sealed;

/// A number type for evaluating free energies and divided differences.
///
/// Implemented for `f64` and `f32`. The methods have the names and the meaning of
/// the methods of `f64`, except [`minimum`](Self::minimum) and
/// [`maximum`](Self::maximum), which keep a NaN, and [`powi`](Self::powi),
/// which is the same sequence of multiplications on every platform.
///
/// ```
/// use eem::Scalar;
///
/// fn hill<S: Scalar>(x: S) -> S {
///     S::branch(x.less(S::zero()), S::zero, || x * (-x).exp())
/// }
///
/// assert!((hill(1.0_f64) - 1.0 / core::f64::consts::E).abs() < 1e-16);
/// assert_eq!(hill(-1.0_f32), 0.0);
/// ```
#[expect(
    clippy::must_use_candidate,
    clippy::return_self_not_must_use,
    reason = "a table of functions; an unused operator is not marked either"
)]
pub trait Scalar:
    nalgebra::Scalar
    + Copy
    + Send
    + Sync
    + Neg<Output = Self>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + AddAssign
    + SubAssign
    + MulAssign
    + DivAssign
{
    /// The result of a comparison: `bool`, or one `bool` per lane.
    type Mask: Copy;

    /// The nearest representable number.
    fn from_f64(value: f64) -> Self;

    /// `0`.
    #[inline]
    fn zero() -> Self {
        Self::from_f64(0.0)
    }

    /// `1`.
    #[inline]
    fn one() -> Self {
        Self::from_f64(1.0)
    }

    /// `self == other`.
    fn equal(self, other: Self) -> Self::Mask;

    /// `self < other`.
    fn less(self, other: Self) -> Self::Mask;

    /// `then()` where the mask holds and `otherwise()` elsewhere.
    ///
    /// A single number calls one closure. Lanes that differ call both and blend,
    /// so neither closure may panic or have effects.
    fn branch(
        mask: Self::Mask,
        then: impl FnOnce() -> Self,
        otherwise: impl FnOnce() -> Self,
    ) -> Self;

    /// `|self|`.
    fn abs(self) -> Self;

    /// The smaller of the two, NaN if either is NaN.
    fn minimum(self, other: Self) -> Self;

    /// The larger of the two, NaN if either is NaN.
    fn maximum(self, other: Self) -> Self;

    /// `√self`.
    fn sqrt(self) -> Self;

    /// `∛self`, odd in its argument.
    fn cbrt(self) -> Self;

    /// `e^self`.
    fn exp(self) -> Self;

    /// `e^self − 1`, accurate near zero.
    fn exp_m1(self) -> Self;

    /// `ln self`.
    fn ln(self) -> Self;

    /// `ln(1 + self)`, accurate near zero.
    fn ln_1p(self) -> Self;

    /// `log₂ self`.
    fn log2(self) -> Self;

    /// `log₁₀ self`.
    fn log10(self) -> Self;

    /// `sin self`, in radians.
    fn sin(self) -> Self;

    /// `cos self`, in radians.
    fn cos(self) -> Self;

    /// `tan self`, in radians.
    fn tan(self) -> Self;

    /// `sinh self`.
    fn sinh(self) -> Self;

    /// `cosh self`.
    fn cosh(self) -> Self;

    /// `tanh self`.
    fn tanh(self) -> Self;

    /// `arsinh self`.
    fn asinh(self) -> Self;

    /// `arctan self`, in radians.
    fn atan(self) -> Self;

    /// The angle of the point `(x, self)`, in radians, in `[−π, π]`.
    fn atan2(self, x: Self) -> Self;

    /// `artanh self`.
    fn atanh(self) -> Self;

    /// `√(self² + other²)` without undue overflow.
    fn hypot(self, other: Self) -> Self;

    /// `self^exponent`.
    fn powf(self, exponent: Self) -> Self;

    /// `1 / self`.
    #[inline]
    fn recip(self) -> Self {
        Self::one() / self
    }

    /// `self^n` by repeated squaring; `1 / self^|n|` for negative `n`.
    ///
    /// The relative error is below `|n| / 2` ulp.
    #[inline]
    fn powi(self, n: i32) -> Self {
        let power = natural_power(self, n.unsigned_abs());
        if n < 0 { power.recip() } else { power }
    }
}

/// `base^n` by repeated squaring.
#[inline]
pub fn natural_power<S: Scalar>(base: S, n: u32) -> S {
    let mut remaining = n;
    let mut square = base;
    let mut power = if n % 2 == 1 { base } else { S::one() };
    while remaining > 1 {
        remaining /= 2;
        square *= square;
        if remaining % 2 == 1 {
            power *= square;
        }
    }
    power
}

/// The error if numbers in SIMD lanes would take different branches.
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
mod sealed {
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
pub trait Real: Scalar<Mask: Mask> + Sealed {
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

/// Finite and greater than zero, in every lane.
#[inline]
pub fn is_positive<S: Real>(value: S) -> bool {
    (S::zero().less(value) & value.at_most(S::MAX)).all()
}

/// `kept` in the lanes that have converged, `new` in all others. A single number is not evaluated again after convergence.
#[inline]
pub fn unless<S: Real>(converged: S::Mask, kept: S, new: S) -> S {
    if S::LANES == 1 {
        new
    } else {
        S::select(converged, kept, new)
    }
}
