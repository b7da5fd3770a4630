//! Logarithms, based at the smaller end.

use super::primitives::{by_definition, ends, log_difference, near_or_far, phi2_near};
use crate::scalar::Scalar;

/// `f[a,b]` of the natural logarithm, for `a, b > 0`.
///
/// ```text
/// f = ln x:  f[a,b] = L(d/m)/m,  m = min(a,b),  d = |b − a|,  L(u) = ln(1 + u)/u
/// ```
///
/// ```
/// use eem_runtime::kernel::ln_dd;
///
/// assert!((ln_dd(1.0, 2.0) - 2.0_f64.ln()).abs() < 1e-15);
/// assert_eq!(ln_dd(4.0, 4.0), 0.25);
/// ```
#[inline]
pub fn ln_dd<S: Scalar>(a: S, b: S) -> S {
    let (low, _, d) = ends(a, b);
    log_difference(d, low)
}

/// `f[a,b,b]` of the natural logarithm, for `a, b > 0`.
///
/// ```text
/// f = ln x:  f[a,b,b] = −F²φ₂(δ),  F = ln[a,b],  δ = (b − a)F = ln(b/a),  |δ| < 1
/// ```
///
/// with `φ₂(x) = (e^(−x) − 1 + x)/x²`; by definition for |δ| ≥ 1.
///
/// ```
/// assert_eq!(eem_runtime::kernel::ln_dd2(2.0, 2.0), -0.125);
/// ```
#[inline]
pub fn ln_dd2<S: Scalar>(a: S, b: S) -> S {
    logarithm_dd2(a, b, b, ln_dd(a, b))
}

/// `f[a,b]` of `ln(1 + x)`, for `a, b > −1`.
///
/// ```text
/// f = ln(1 + x):  f[a,b] = L(d/w)/w,  w = 1 + min(a,b),  d = |b − a|
/// ```
///
/// ```
/// let difference: f64 = eem_runtime::kernel::ln_1p_dd(0.0, 1.0);
/// assert!((difference - 2.0_f64.ln()).abs() < 1e-15);
/// ```
#[inline]
pub fn ln_1p_dd<S: Scalar>(a: S, b: S) -> S {
    let (low, _, d) = ends(a, b);
    log_difference(d, S::one() + low)
}

/// `f[a,b,b]` of `ln(1 + x)`, for `a, b > −1`: [`ln_dd2`] with the base `1 + b`.
///
/// ```
/// assert_eq!(eem_runtime::kernel::ln_1p_dd2(1.0, 1.0), -0.125);
/// ```
#[inline]
pub fn ln_1p_dd2<S: Scalar>(a: S, b: S) -> S {
    logarithm_dd2(a, b, S::one() + b, ln_1p_dd(a, b))
}

/// `f[a,b]` of the binary logarithm, for `a, b > 0`: [`ln_dd`]` / ln 2`.
///
/// ```
/// let difference: f64 = eem_runtime::kernel::log2_dd(1.0, 2.0);
/// assert!((difference - 1.0).abs() < 1e-15);
/// ```
#[inline]
pub fn log2_dd<S: Scalar>(a: S, b: S) -> S {
    ln_dd(a, b) * S::from_f64(core::f64::consts::LOG2_E)
}

/// `f[a,b,b]` of the binary logarithm, for `a, b > 0`: [`ln_dd2`]` / ln 2`.
///
/// ```
/// let exact = -0.125 / 2.0_f64.ln();
/// assert!((eem_runtime::kernel::log2_dd2(2.0, 2.0) - exact).abs() < 1e-16);
/// ```
#[inline]
pub fn log2_dd2<S: Scalar>(a: S, b: S) -> S {
    ln_dd2(a, b) * S::from_f64(core::f64::consts::LOG2_E)
}

/// `f[a,b]` of the decimal logarithm, for `a, b > 0`: [`ln_dd`]` / ln 10`.
///
/// ```
/// let difference: f64 = eem_runtime::kernel::log10_dd(1.0, 10.0);
/// assert!((difference - 1.0 / 9.0).abs() < 1e-16);
/// ```
#[inline]
pub fn log10_dd<S: Scalar>(a: S, b: S) -> S {
    ln_dd(a, b) * S::from_f64(core::f64::consts::LOG10_E)
}

/// `f[a,b,b]` of the decimal logarithm, for `a, b > 0`: [`ln_dd2`]` / ln 10`.
///
/// ```
/// let exact = -0.125 / 10.0_f64.ln();
/// assert!((eem_runtime::kernel::log10_dd2(2.0, 2.0) - exact).abs() < 1e-16);
/// ```
#[inline]
pub fn log10_dd2<S: Scalar>(a: S, b: S) -> S {
    ln_dd2(a, b) * S::from_f64(core::f64::consts::LOG10_E)
}

/// The second difference of a logarithm with `f′(b) = 1/base` and `difference = f[a,b]`.
#[inline]
fn logarithm_dd2<S: Scalar>(a: S, b: S, base: S, difference: S) -> S {
    let step = (b - a) * difference;
    near_or_far(
        step,
        || -(difference * difference) * phi2_near(step),
        || by_definition(base.recip(), difference, a, b),
    )
}
