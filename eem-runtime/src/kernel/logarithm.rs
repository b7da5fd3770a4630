//! Logarithms, summed up between close ends and based at the smaller of distant ones.

use super::primitives::{LogNear, by_definition, log_difference};
use crate::scalar::Scalar;

/// `f[a,b]` of the natural logarithm, for `a, b > 0`; of `ln |x|` if both are negative.
///
/// ```text
/// f = ln x:  f[a,b] = (artanh z)/(zμ),  μ = ½(a + b),  z = (b − a)/(2μ)
/// ```
///
/// summed up for |z| < 1/5, which needs no function of the library, and `ln(1 + d/m)/d` with
/// m = min(a,b) and d = |b − a| for larger ratios.
///
/// ```
/// use eem_runtime::kernel::ln_dd;
///
/// assert!((ln_dd(1.0, 2.0) - 2.0_f64.ln()).abs() < 1e-15);
/// assert_eq!(ln_dd(4.0, 4.0), 0.25);
/// ```
#[inline]
pub fn ln_dd<S: Scalar>(a: S, b: S) -> S {
    first(a.minimum(b), a, b)
}

/// `f[a,b,b]` of the natural logarithm, for `a, b > 0`; of `ln |x|` if both are negative.
///
/// ```text
/// f = ln x:  f[a,b,b] = ((1 − z)g′ − g)/(2μ²),  g = (artanh z)/z,  |z| < 1/5
/// ```
///
/// with μ and z of [`ln_dd`]; by definition for larger ratios.
///
/// ```
/// assert_eq!(eem_runtime::kernel::ln_dd2(2.0, 2.0), -0.125);
/// ```
#[inline]
pub fn ln_dd2<S: Scalar>(a: S, b: S) -> S {
    second(a.minimum(b), a, b, b)
}

/// `f[a,b]` of `ln(1 + x)`, for `a, b > −1`.
///
/// ```text
/// f = ln(1 + x):  f[a,b] = ln(1 + d/w)/d,  w = 1 + min(a,b),  d = |b − a|
/// ```
///
/// ```
/// let difference: f64 = eem_runtime::kernel::ln_1p_dd(0.0, 1.0);
/// assert!((difference - 2.0_f64.ln()).abs() < 1e-15);
/// ```
#[inline]
pub fn ln_1p_dd<S: Scalar>(a: S, b: S) -> S {
    first(S::one() + a.minimum(b), a, b)
}

/// `f[a,b,b]` of `ln(1 + x)`, for `a, b > −1`: [`ln_dd2`] with the base `1 + b`.
///
/// ```
/// assert_eq!(eem_runtime::kernel::ln_1p_dd2(1.0, 1.0), -0.125);
/// ```
#[inline]
pub fn ln_1p_dd2<S: Scalar>(a: S, b: S) -> S {
    second(S::one() + a.minimum(b), a, b, S::one() + b)
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

/// The first difference of `ln(x + c)` with `base = c + min(a, b)`.
#[inline]
fn first<S: Scalar>(base: S, a: S, b: S) -> S {
    let near = LogNear::new(base, a, b);
    let difference = near.first();
    let far = || log_difference((b - a).abs(), base);
    S::branch(near.applies, || difference, far)
}

/// The second difference of `ln(x + c)` with `base = c + min(a, b)` and `argument = c + b`.
#[inline]
fn second<S: Scalar>(base: S, a: S, b: S, argument: S) -> S {
    let near = LogNear::new(base, a, b);
    let difference = near.second();
    S::branch(
        near.applies,
        || difference,
        || {
            let far = log_difference((b - a).abs(), base);
            by_definition(argument.recip(), far, a, b)
        },
    )
}
