//! Sine, cosine and tangent, relatively accurate also next to the zeros of `f[a,b]`.
//!
//! The mean and the half-distance of the ends are carried with their rounding
//! errors: `cos(½(a + b))` next to a zero depends on the last bit of `a + b`.

use super::primitives::{ends, half, sinc, sinc_prime, two_sum};
use crate::number::scalar::Scalar;

/// `f[a,b]` of the sine: `cos(½(a + b))·sinc(½(b − a))`.
///
/// ```
/// assert_eq!(eem::kernel::sin_dd(0.0, 0.0), 1.0);
/// assert!((eem::kernel::sin_dd(0.0, 1.0) - 1.0_f64.sin()).abs() < 1e-15);
/// ```
#[inline]
pub fn sin_dd<S: Scalar>(a: S, b: S) -> S {
    let (_, cos) = mean_sin_cos(a, b);
    cos * half_distance_sinc(a, b)
}

/// `f[a,b,b]` of the sine: `½(cos m·sinc′x − sin m·sinc x)` with `m = ½(a + b)`, `x = ½(b − a)`.
///
/// ```
/// let exact = 1.0_f64.sin() - 1.0;
/// assert!((eem_material::kernel::sin_dd2(1.0, 0.0) - exact).abs() < 1e-15);
/// ```
#[inline]
pub fn sin_dd2<S: Scalar>(a: S, b: S) -> S {
    let (sin, cos) = mean_sin_cos(a, b);
    let (value, slope) = half_distance_pair(a, b);
    half(cos * slope - sin * value)
}

/// `f[a,b]` of the cosine: `−sin(½(a + b))·sinc(½(b − a))`.
///
/// ```
/// assert_eq!(eem::kernel::cos_dd(-3.0, 3.0), 0.0);
/// assert!((eem::kernel::cos_dd(0.0, 1.0) - (1.0_f64.cos() - 1.0)).abs() < 1e-15);
/// ```
#[inline]
pub fn cos_dd<S: Scalar>(a: S, b: S) -> S {
    let (sin, _) = mean_sin_cos(a, b);
    -sin * half_distance_sinc(a, b)
}

/// `f[a,b,b]` of the cosine: `−½(sin m·sinc′x + cos m·sinc x)` with `m = ½(a + b)`, `x = ½(b − a)`.
///
/// ```
/// let exact = 1.0_f64.cos() - 1.0;
/// assert!((eem_material::kernel::cos_dd2(1.0, 0.0) - exact).abs() < 1e-15);
/// ```
#[inline]
pub fn cos_dd2<S: Scalar>(a: S, b: S) -> S {
    let (sin, cos) = mean_sin_cos(a, b);
    let (value, slope) = half_distance_pair(a, b);
    -half(sin * slope + cos * value)
}

/// `f[a,b]` of the tangent, for ends with no pole between them: `sinc(b − a)/(cos a·cos b)`.
///
/// ```
/// assert_eq!(eem::kernel::tan_dd(0.0, 0.0), 1.0);
/// assert!((eem::kernel::tan_dd(0.0, 1.0) - 1.0_f64.tan()).abs() < 1e-15);
/// ```
#[inline]
pub fn tan_dd<S: Scalar>(a: S, b: S) -> S {
    let (low, high, _) = ends(a, b);
    let (distance, error) = two_sum(high, -low);
    let value = sinc(distance) + error * sinc_prime(distance);
    value / (a.cos() * b.cos())
}

/// `f[a,b,b]` of the tangent, for ends with no pole between them: `(sinc′d + sinc d·tan b)/(cos a·cos b)`
/// with `d = b − a`.
///
/// ```
/// let difference: f64 = eem_material::kernel::tan_dd2(1.0, 0.0);
/// assert!((difference - (1.0_f64.tan() - 1.0)).abs() < 1e-15);
/// ```
#[inline]
pub fn tan_dd2<S: Scalar>(a: S, b: S) -> S {
    let (distance, error) = two_sum(b, -a);
    let (value, slope) = shifted_sinc(distance, error);
    (slope + value * b.tan()) / (a.cos() * b.cos())
}

/// Sine and cosine of `½(a + b)`, with the rounding error of the sum to first order.
#[inline]
fn mean_sin_cos<S: Scalar>(a: S, b: S) -> (S, S) {
    let (sum, error) = two_sum(a, b);
    let (mean, shift) = (half(sum), half(error));
    let (sin, cos) = (mean.sin(), mean.cos());
    (sin + shift * cos, cos - shift * sin)
}

/// `sinc(½|b − a|)`.
#[inline]
fn half_distance_sinc<S: Scalar>(a: S, b: S) -> S {
    let (low, high, _) = ends(a, b);
    let (distance, error) = two_sum(high, -low);
    let x = half(distance);
    sinc(x) + half(error) * sinc_prime(x)
}

/// `sinc x` and `sinc′x` at `x = ½(b − a)`.
#[inline]
fn half_distance_pair<S: Scalar>(a: S, b: S) -> (S, S) {
    let (distance, error) = two_sum(b, -a);
    shifted_sinc(half(distance), half(error))
}

/// `sinc` and `sinc′` at `x + shift` to first order in the shift, a rounding error of `x`.
///
/// `sinc″ = −sinc − 2 sinc′/x`; where `x` vanishes, so does the shift.
#[inline]
fn shifted_sinc<S: Scalar>(x: S, shift: S) -> (S, S) {
    let (value, slope) = (sinc(x), sinc_prime(x));
    let bend = if x == S::zero() {
        S::zero()
    } else {
        -(value + (slope + slope) / x)
    };
    (value + shift * slope, slope + shift * bend)
}
