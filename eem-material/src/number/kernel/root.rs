//! Reciprocal and roots: rational in the values at the two ends.

use super::primitives::{ends, half, in_range_or, twice};
use crate::number::scalar::Scalar;

/// `f[a,b]` of the reciprocal, for `a` and `b` of any sign: `−1/(ab)`.
///
/// ```
/// assert_eq!(eem_material::kernel::recip_dd(2.0, 4.0), -0.125);
/// assert_eq!(eem_material::kernel::recip_dd(1e-200, 1e200), -1.0);
/// ```
#[inline]
pub fn recip_dd<S: Scalar>(a: S, b: S) -> S {
    let (low, high, _) = ends(a, b);
    in_range_or(-(a * b).recip(), || -high.recip() / low)
}

/// `f[a,b,b]` of the reciprocal: `1/(ab²)`.
///
/// ```
/// assert_eq!(eem_material::kernel::recip_dd2(2.0, 4.0), 0.03125);
/// ```
#[inline]
pub fn recip_dd2<S: Scalar>(a: S, b: S) -> S {
    -recip_dd(a, b) / b
}

/// `f[a,b]` of the square root, for `a, b ≥ 0`: `1/(√a + √b)`.
///
/// ```
/// assert_eq!(eem_material::kernel::sqrt_dd(4.0, 9.0), 0.2);
/// ```
#[inline]
pub fn sqrt_dd<S: Scalar>(a: S, b: S) -> S {
    (a.sqrt() + b.sqrt()).recip()
}

/// `f[a,b,b]` of the square root, for `a ≥ 0`, `b > 0`: `−1/(2√b(√a + √b)²)`.
///
/// ```
/// assert_eq!(eem_material::kernel::sqrt_dd2(9.0, 1.0), -0.03125);
/// ```
#[inline]
pub fn sqrt_dd2<S: Scalar>(a: S, b: S) -> S {
    let y = b.sqrt();
    let sum = a.sqrt() + y;
    -(twice(y) * sum * sum).recip()
}

/// `f[a,b]` of the cube root, for `a` and `b` of any sign: `1/(x² + xy + y²) = 2/((x + y)² + x² + y²)`
/// with `x = ∛a, y = ∛b`.
///
/// The error is up to 6 ulp, nearly all of it from the cube roots themselves.
///
/// ```
/// let difference: f64 = eem_material::kernel::cbrt_dd(8.0, -1.0);
/// assert!((difference - 1.0 / 3.0).abs() < 1e-15);
/// ```
#[inline]
pub fn cbrt_dd<S: Scalar>(a: S, b: S) -> S {
    mean_square(a.cbrt(), b.cbrt()).recip()
}

/// `f[a,b,b]` of the cube root, for `a` of any sign and `b ≠ 0`: `−(x + 2y)/(3y²q²)` with `q = x² + xy + y²`.
///
/// ```
/// let difference: f64 = eem_material::kernel::cbrt_dd2(8.0, 1.0);
/// assert!((difference + 4.0 / 147.0).abs() < 1e-16);
/// ```
#[inline]
pub fn cbrt_dd2<S: Scalar>(a: S, b: S) -> S {
    let (x, y) = (a.cbrt(), b.cbrt());
    let q = mean_square(x, y);
    -((x + twice(y)) / q) / (S::from_f64(3.0) * (y * y) * q)
}

/// `x² + xy + y²` as a sum of squares.
#[inline]
fn mean_square<S: Scalar>(x: S, y: S) -> S {
    let sum = x + y;
    half(sum * sum + (x * x + y * y))
}
