//! Logarithms: a series for close ends, a formula based at the smaller one for distant ends.

use super::primitives::{Differences, area_tangent_tail, by_definition, half, log_difference};
use crate::number::scalar::Scalar;

/// Below this |z| = |b − a|/(a + b), a ratio of the ends of 3/2, differences are sums of series.
const CLOSE: f64 = 0.2;

/// All differences of the natural logarithm: [`ln_dd`] and both [`ln_dd2`].
///
/// ```
/// let all = eem_material::kernel::ln_dds(2.0, 2.0);
/// assert_eq!((all.first, all.second_a, all.second_b), (0.5, -0.125, -0.125));
/// ```
#[expect(
    clippy::inline_always,
    reason = "what the caller does not use must not be computed"
)]
#[inline(always)]
pub fn ln_dds<S: Scalar>(a: S, b: S) -> Differences<S> {
    differences(a + half(b - a), S::zero(), [a, b], [a, b])
}

/// All differences of `ln(1 + x)`: [`ln_1p_dd`] and both [`ln_1p_dd2`].
///
/// ```
/// let all = eem_material::kernel::ln_1p_dds(1.0, 1.0);
/// assert_eq!((all.first, all.second_a, all.second_b), (0.5, -0.125, -0.125));
/// ```
#[expect(
    clippy::inline_always,
    reason = "what the caller does not use must not be computed"
)]
#[inline(always)]
pub fn ln_1p_dds<S: Scalar>(a: S, b: S) -> Differences<S> {
    let mean = S::one() + a.minimum(b) + half(b - a).abs();
    differences(mean, S::one(), [S::one() + a, S::one() + b], [a, b])
}

/// `f[a,b]` of the natural logarithm, for `a, b > 0`; of `ln |x|` if both are negative: `ν artanh z/z`
/// with `ν = 2/(a + b)`, `z = ½(b − a)ν`, summed for |z| < 1/5 without a function of the library; `ln(1 + d/m)/d` with
/// `m = min(a,b)`, `d = |b − a|` for larger ratios.
///
/// ```
/// assert!((eem::kernel::ln_dd(1.0, 2.0) - 2.0_f64.ln()).abs() < 1e-15);
/// assert_eq!(eem::kernel::ln_dd(4.0, 4.0), 0.25);
/// ```
#[inline]
pub fn ln_dd<S: Scalar>(a: S, b: S) -> S {
    ln_dds(a, b).first
}

/// `f[a,b,b]` of the natural logarithm, for `a, b > 0`; of `ln |x|` if both are negative: `−½ν(1/b + νt)`
/// with `t = (artanh z/z − 1)/z` for |z| < 1/5, and ν and z of [`ln_dd`]; by definition for larger ratios.
///
/// ```
/// assert_eq!(eem_material::kernel::ln_dd2(2.0, 2.0), -0.125);
/// ```
#[inline]
pub fn ln_dd2<S: Scalar>(a: S, b: S) -> S {
    ln_dds(a, b).second_b
}

/// `f[a,b]` of `ln(1 + x)`, for `a, b > −1`: [`ln_dd`] between `1 + a` and `1 + b`, from the difference `b − a`.
///
/// ```
/// let difference: f64 = eem_material::kernel::ln_1p_dd(0.0, 1.0);
/// assert!((difference - 2.0_f64.ln()).abs() < 1e-15);
/// ```
#[inline]
pub fn ln_1p_dd<S: Scalar>(a: S, b: S) -> S {
    ln_1p_dds(a, b).first
}

/// `f[a,b,b]` of `ln(1 + x)`, for `a, b > −1`: [`ln_dd2`] between `1 + a` and `1 + b`, from the difference `b − a`.
///
/// ```
/// assert_eq!(eem_material::kernel::ln_1p_dd2(1.0, 1.0), -0.125);
/// ```
#[inline]
pub fn ln_1p_dd2<S: Scalar>(a: S, b: S) -> S {
    ln_1p_dds(a, b).second_b
}

/// `f[a,b]` of the binary logarithm, for `a, b > 0`: [`ln_dd`]` / ln 2`.
///
/// ```
/// let difference: f64 = eem_material::kernel::log2_dd(1.0, 2.0);
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
/// assert!((eem_material::kernel::log2_dd2(2.0, 2.0) - exact).abs() < 1e-16);
/// ```
#[inline]
pub fn log2_dd2<S: Scalar>(a: S, b: S) -> S {
    ln_dd2(a, b) * S::from_f64(core::f64::consts::LOG2_E)
}

/// `f[a,b]` of the decimal logarithm, for `a, b > 0`: [`ln_dd`]` / ln 10`.
///
/// ```
/// let difference: f64 = eem_material::kernel::log10_dd(1.0, 10.0);
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
/// assert!((eem_material::kernel::log10_dd2(2.0, 2.0) - exact).abs() < 1e-16);
/// ```
#[inline]
pub fn log10_dd2<S: Scalar>(a: S, b: S) -> S {
    ln_dd2(a, b) * S::from_f64(core::f64::consts::LOG10_E)
}

/// All differences of `ln(x + c)` with u = a + c, v = b + c and their mean ½(u + v).
///
/// ```text
/// ν = 1/mean,  z = ½(b − a)ν,  |z| < 1/5,  ln(v/u) = 2 artanh z
/// ln[a,b]   = ν artanh z/z = ν(1 + zt)         t = z/3 + z³/5 + …
/// ln[a,b,b] = −½ν(1/v + νt)
/// ```
///
/// Nothing cancels: zt is positive, and |νt| is less than a tenth of 1/v. The last line is
/// `(1/v − ln[a,b])/(b − a)` with `1/v = ν(1 − z/(1 + z))`; 1/v often occurs elsewhere.
#[expect(
    clippy::inline_always,
    reason = "what the caller does not use must not be computed"
)]
#[inline(always)]
fn differences<S: Scalar>(mean: S, c: S, [u, v]: [S; 2], [a, b]: [S; 2]) -> Differences<S> {
    let inverse = mean.recip();
    let z = half(b - a) * inverse;
    let tail = z * area_tangent_tail(z * z);
    let [shift, weight] = [inverse * tail, -half(inverse)];
    if z.abs() < S::from_f64(CLOSE) {
        Differences {
            first: inverse + z * shift,
            second_a: weight * (u.recip() - shift),
            second_b: weight * (v.recip() + shift),
        }
    } else {
        Differences {
            first: distant(c, a, b),
            second_a: distant_second(c, b, a),
            second_b: distant_second(c, a, b),
        }
    }
}

/// `ln[a,b]` of ends of a large ratio.
#[cold]
#[inline(never)]
fn distant<S: Scalar>(c: S, a: S, b: S) -> S {
    log_difference((b - a).abs(), c + a.minimum(b))
}

/// `ln[a,b,b]` of ends of a large ratio.
#[cold]
#[inline(never)]
fn distant_second<S: Scalar>(c: S, a: S, b: S) -> S {
    by_definition((c + b).recip(), distant(c, a, b), a, b)
}
