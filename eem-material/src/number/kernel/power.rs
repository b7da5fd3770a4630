//! Powers with a real exponent that is the same at both ends.

use super::logarithm::ln_dd;
use super::primitives::{
    by_definition, ends, half, in_range_or, log_ratio, near_or_far, phi, phi2_near,
};
use crate::number::scalar::Scalar;

/// `f[a,b]` of a power with a constant exponent, for `a, b ≥ 0`: `mᵖ expm1(x)/d`
/// with `x = p ln(1 + d/m)`, `m = min(a,b)`, `d = |b − a|` for |x| < 1,
/// `(Mᵖ − mᵖ)/d` with `M = max(a,b)` for |x| ≥ 1, where the quotient of the two powers exceeds e.
///
/// ```
/// use eem::kernel::powf_dd;
///
/// assert_eq!(powf_dd(1.0, 4.0, 1.5), 7.0 / 3.0);
/// assert_eq!(powf_dd(0.0, 4.0, 0.5), 0.5);
/// assert_eq!(powf_dd(4.0, 4.0, 1.5), 3.0);
/// ```
#[inline]
pub fn powf_dd<S: Scalar>(a: S, b: S, p: S) -> S {
    let (low, high, d) = ends(a, b);
    S::branch(
        d.equal(S::zero()),
        || slope(low, p),
        || {
            let x = p * log_ratio(d, low);
            near_or_far(
                x,
                || low.powf(p) * x.exp_m1() / d,
                || (high.powf(p) - low.powf(p)) / d,
            )
        },
    )
}

/// `f[a,b,b]` of a power with a constant exponent, for `a, b ≥ 0`: `pL bᵖ (p φ₂(pδ)/b − L φ(pδ) φ₂(δ))`
/// with `L = ln[a,b]`, `δ = (b − a)L = ln(b/a)` for |δ|, |pδ| < 1; by definition elsewhere. For `½ < p < 3/2`, where the
/// terms would cancel, `xᵖ = x·x^(p−1)` with the Leibniz rule.
///
/// ```
/// use eem::kernel::powf_dd2;
///
/// assert!((powf_dd2(4.0, 4.0, 1.5_f64) - 0.1875).abs() < 1e-15);
/// assert_eq!(powf_dd2(1.0, 4.0, 2.0), 1.0);
/// ```
#[inline]
pub fn powf_dd2<S: Scalar>(a: S, b: S, p: S) -> S {
    let reduced = p - S::one();
    S::branch(
        b.equal(S::zero()),
        || at_zero_dd2(a, p),
        || {
            S::branch(
                reduced.abs().less(S::from_f64(0.5)),
                || product_dd2(a, b, reduced),
                || direct_dd2(a, b, p),
            )
        },
    )
}

/// `p x^(p−1)`, without rounding the exponent where `xᵖ` is in range.
#[inline]
fn slope<S: Scalar>(x: S, p: S) -> S {
    in_range_or(p * (x.powf(p) / x), || p * x.powf(p - S::one()))
}

/// `f[a,0,0]`.
#[inline]
fn at_zero_dd2<S: Scalar>(a: S, p: S) -> S {
    let zero = S::zero();
    S::branch(
        a.equal(zero),
        || half(p) * slope(zero, p - S::one()),
        || by_definition(slope(zero, p), powf_dd(a, zero, p), a, zero),
    )
}

/// `f[a,b,b]` where the two terms do not cancel: |p − 1| ≥ ½.
#[inline]
fn direct_dd2<S: Scalar>(a: S, b: S, p: S) -> S {
    let log_dd = ln_dd(a, b);
    let step = (b - a) * log_dd;
    let x = p * step;
    near_or_far(
        step.abs().maximum(x.abs()),
        || {
            let curved = p * phi2_near(x) / b - log_dd * phi(x) * phi2_near(step);
            p * log_dd * b.powf(p) * curved
        },
        || by_definition(slope(b, p), powf_dd(a, b, p), a, b),
    )
}

/// `f[a,b,b]` of `x·g` with `g = x^q`, |q| < ½, by the Leibniz rule based at the smaller end.
#[inline]
fn product_dd2<S: Scalar>(a: S, b: S, q: S) -> S {
    let second = || direct_dd2(a, b, q);
    S::branch(
        b.less(a),
        || b * second() + powf_dd(a, b, q),
        // a·g[a,b,b] vanishes with a, although g may be singular.
        || slope(b, q) + S::branch(a.equal(S::zero()), S::zero, || a * second()),
    )
}
