//! Inverse hyperbolic functions and arc tangent.
//!
//! Their second differences are those of the inverse function at the images:
//! with the step `δ = (b − a)f[a,b]` of the value, addition theorems leave only
//! even functions of `δ` and `b`, and no difference of close numbers.

use super::primitives::{
    by_definition, ends, half, log_difference, near_or_far, sinc, sinc_prime, sinhc,
    sinhc_prime_near, sinhc_tail_near, twice,
};
use crate::number::scalar::Scalar;

/// `f[a,b]` of the inverse hyperbolic sine.
///
/// ```text
/// f = arsinh x:  f[a,b] = g·L(dg/X)/X,  L(u) = ln(1 + u)/u,  d = M − m
/// g = 1 + (m + M)/(c_m + c_M),  c_x = √(1 + x²),  X = m + c_m
/// ```
///
/// with `m < M` the ends in the order in which `m + M ≥ 0`, mirrored if necessary.
///
/// ```
/// assert_eq!(eem::kernel::asinh_dd(0.0, 0.0), 1.0);
/// assert!((eem::kernel::asinh_dd(0.0, 1.0) - 1.0_f64.asinh()).abs() < 1e-15);
/// ```
#[inline]
pub fn asinh_dd<S: Scalar>(a: S, b: S) -> S {
    let (smaller, larger, d) = ends(a, b);
    let sum = (a + b).abs();
    let low = if a + b < S::zero() { -larger } else { smaller };
    let cosines = smaller.hypot(S::one()) + larger.hypot(S::one());
    let growth = S::one() + sum / cosines;
    let cosine = low.hypot(S::one());
    let base = if low < S::zero() {
        (cosine - low).recip()
    } else {
        low + cosine
    };
    growth * log_difference(d * growth, base)
}

/// `f[a,b,b]` of the inverse hyperbolic sine.
///
/// ```text
/// f = arsinh x:  f[a,b,b] = −F²(½ sinhc²(½δ)·b/√(1 + b²) − (sinhc δ − 1)/δ)
/// F = f[a,b],  δ = (b − a)F,  |δ| < 1
/// ```
///
/// and by definition for |δ| ≥ 1.
///
/// ```
/// let difference: f64 = eem_material::kernel::asinh_dd2(1.0, 0.0);
/// assert!((difference - (1.0_f64.asinh() - 1.0)).abs() < 1e-15);
/// ```
#[inline]
pub fn asinh_dd2<S: Scalar>(a: S, b: S) -> S {
    let difference = asinh_dd(a, b);
    let slope = S::one().hypot(b).recip();
    second_difference([a, b], difference, slope, |step| {
        let value = sinhc(half(step));
        let bend = half(value * value) * (b * slope) - sinhc_tail_near(step);
        -(difference * difference) * bend
    })
}

/// `f[a,b]` of the arc tangent: `atan2(d, 1 + ab)/d` with `d = |b − a|`.
///
/// ```
/// assert_eq!(eem::kernel::atan_dd(2.0, 2.0), 0.2);
/// assert!((eem::kernel::atan_dd(0.0, 1.0) - core::f64::consts::FRAC_PI_4).abs() < 1e-15);
/// ```
#[inline]
pub fn atan_dd<S: Scalar>(a: S, b: S) -> S {
    let (_, _, d) = ends(a, b);
    let cosine = S::one() + a * b;
    if d == S::zero() {
        cosine.recip()
    } else {
        d.atan2(cosine) / d
    }
}

/// `f[a,b,b]` of the arc tangent: `−F(b + sinc′δ/sinc δ)/(1 + b²)` with `F = f[a,b]`, `δ = (b − a)F` for `|δ| < 1`,
/// by definition for |δ| ≥ 1.
///
/// ```
/// let difference: f64 = eem_material::kernel::atan_dd2(1.0, 0.0);
/// assert!((difference - (core::f64::consts::FRAC_PI_4 - 1.0)).abs() < 1e-15);
/// ```
#[inline]
pub fn atan_dd2<S: Scalar>(a: S, b: S) -> S {
    let difference = atan_dd(a, b);
    let slope = (S::one() + b * b).recip();
    second_difference([a, b], difference, slope, |step| {
        -difference * (b + sinc_prime(step) / sinc(step)) * slope
    })
}

/// `f[a,b]` of the inverse hyperbolic tangent, for `−1 < a, b < 1`: `L(2d/w)/w`
/// with `w = (1 − M)(1 + m)`, `d = M − m`, `L(u) = ln(1 + u)/u`, `m = min(a,b)`,
/// `M = max(a,b)`.
///
/// ```
/// assert!((eem::kernel::atanh_dd(0.0, 0.5) - 3.0_f64.ln()).abs() < 1e-15);
/// assert_eq!(eem::kernel::atanh_dd(0.5, 0.5), 4.0 / 3.0);
/// ```
#[inline]
pub fn atanh_dd<S: Scalar>(a: S, b: S) -> S {
    let (low, high, d) = ends(a, b);
    log_difference(twice(d), (S::one() - high) * (S::one() + low))
}

/// `f[a,b,b]` of the inverse hyperbolic tangent, for `−1 < a, b < 1`: `F(b − sinhc′δ/sinhc δ)/(1 − b²)`
/// with `F = f[a,b]`, `δ = (b − a)F` for `|δ| < 1`, by definition for |δ| ≥ 1.
///
/// ```
/// let difference: f64 = eem_material::kernel::atanh_dd2(0.5, 0.0);
/// assert!((difference - (2.0 * 3.0_f64.ln() - 2.0)).abs() < 1e-15);
/// ```
#[inline]
pub fn atanh_dd2<S: Scalar>(a: S, b: S) -> S {
    let difference = atanh_dd(a, b);
    let slope = ((S::one() - b) * (S::one() + b)).recip();
    second_difference([a, b], difference, slope, |step| {
        difference * (b - sinhc_prime_near(step) / sinhc(step)) * slope
    })
}

/// `f[a,b,b]` from `f[a,b]` and `f′(b)`: `near` of the step `δ = (b − a) f[a,b]` for |δ| < 1, and by definition elsewhere.
#[inline]
fn second_difference<S: Scalar>(
    [a, b]: [S; 2],
    difference: S,
    slope: S,
    near: impl FnOnce(S) -> S,
) -> S {
    let step = (b - a) * difference;
    let far = || by_definition(slope, difference, a, b);
    near_or_far(step, || near(step), far)
}
