//! The number types that formulas are evaluated on: `f64`, and in programs of users dual numbers and the like.

mod floats;

use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

/// A number type for evaluating free energies and divided differences.
///
/// Scenes step `f64`, for which it is implemented. Another type, such as a dual number, differentiates formulas; its order
/// is that of the values. The methods have the names and the meaning of the methods of `f64`, except
/// [`minimum`](Self::minimum) and [`maximum`](Self::maximum), which keep a NaN, and [`powi`](Self::powi), which is the same
/// sequence of multiplications on every platform. With the feature `portable`, elementary functions have the same bits
/// on every platform, too.
///
/// ```
/// use eem::Scalar;
///
/// fn hill<S: Scalar>(x: S) -> S {
///     if x < S::zero() { S::zero() } else { x * (-x).exp() }
/// }
///
/// assert!((hill(1.0_f64) - 1.0 / core::f64::consts::E).abs() < 1e-16);
/// assert_eq!(hill(-1.0), 0.0);
/// ```
#[expect(
    clippy::must_use_candidate,
    clippy::return_self_not_must_use,
    reason = "a table of functions; an unused operator is not marked either"
)]
pub trait Scalar:
    nalgebra::Scalar
    + Copy
    + PartialOrd
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

/// Finite and greater than zero.
#[inline]
#[must_use]
pub fn is_positive(value: f64) -> bool {
    value > 0.0 && value <= f64::MAX
}
