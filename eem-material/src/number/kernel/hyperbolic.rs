//! Hyperbolic functions, as exponentials that decay away from the dominant end.

use super::exponential::exp_dd2;
use super::primitives::{
    by_definition, ends, half, near_or_far, phi, sinhc, sinhc_prime_near, twice,
};
use crate::number::scalar::Scalar;

/// `f[a,b]` of the hyperbolic sine: `½φ(d)(e^M + e^(−m))` with `m = min(a,b)`, `M = max(a,b)`, `d = M − m`.
///
/// ```
/// assert_eq!(eem::kernel::sinh_dd(0.0, 0.0), 1.0);
/// assert!((eem::kernel::sinh_dd(0.0, 1.0) - 1.0_f64.sinh()).abs() < 1e-15);
/// ```
#[inline]
pub fn sinh_dd<S: Scalar>(a: S, b: S) -> S {
    let (low, high, d) = ends(a, b);
    half(phi(d)) * (high.exp() + (-low).exp())
}

/// `f[a,b,b]` of the hyperbolic sine.
///
/// ```text
/// f = sinh x:  f[a,b,b] = ½(exp[a,b,b] − exp[−a,−b,−b])
///                       = ½(cosh m·sinhc′x + sinh m·sinhc x),  m = ½(a + b),  x = ½(b − a)
/// ```
///
/// The second form serves |a|, |b| < 1, where the first cancels.
///
/// ```
/// let difference: f64 = eem_material::kernel::sinh_dd2(1.0, 0.0);
/// assert!((difference - (1.0_f64.sinh() - 1.0)).abs() < 1e-15);
/// ```
#[inline]
pub fn sinh_dd2<S: Scalar>(a: S, b: S) -> S {
    near_or_far(
        a.abs().maximum(b.abs()),
        || {
            let (mean, x) = (half(a + b), half(b - a));
            half(mean.cosh() * sinhc_prime_near(x) + mean.sinh() * sinhc(x))
        },
        || half(exp_dd2(a, b) - exp_dd2(-a, -b)),
    )
}

/// `f[a,b]` of the hyperbolic cosine: `½φ(d)e^M(1 − e^(−s))` with `s = a + b ≥ 0`, `M = max(a,b)`, `d = |b − a|`;
/// the mirror image for `s < 0`.
///
/// ```
/// assert_eq!(eem::kernel::cosh_dd(-2.0, 2.0), 0.0);
/// assert!((eem::kernel::cosh_dd(0.0, 1.0) - (1.0_f64.cosh() - 1.0)).abs() < 1e-15);
/// ```
#[inline]
pub fn cosh_dd<S: Scalar>(a: S, b: S) -> S {
    let (low, high, d) = ends(a, b);
    let sum = a + b;
    let dominant = high.maximum(-low).exp();
    let size = half(phi(d)) * dominant * -(-sum.abs()).exp_m1();
    if sum < S::zero() { -size } else { size }
}

/// `f[a,b,b]` of the hyperbolic cosine: `½(exp[a,b,b] + exp[−a,−b,−b])`.
///
/// ```
/// let difference: f64 = eem_material::kernel::cosh_dd2(1.0, 0.0);
/// assert!((difference - (1.0_f64.cosh() - 1.0)).abs() < 1e-15);
/// ```
#[inline]
pub fn cosh_dd2<S: Scalar>(a: S, b: S) -> S {
    half(exp_dd2(a, b) + exp_dd2(-a, -b))
}

/// `f[a,b]` of the hyperbolic tangent: `4e^(−2μ)φ(2d)/((1 + e^(−2|a|))(1 + e^(−2|b|)))` with
/// `d = |b − a|`, and `μ = min(|a|, |b|)` for ends of one sign, else 0.
///
/// ```
/// assert_eq!(eem::kernel::tanh_dd(0.0, 0.0), 1.0);
/// assert!((eem::kernel::tanh_dd(-1.0, 1.0) - 1.0_f64.tanh()).abs() < 1e-15);
/// ```
#[inline]
pub fn tanh_dd<S: Scalar>(a: S, b: S) -> S {
    let (low, high, d) = ends(a, b);
    // μ: the smaller magnitude if both ends have one sign, else zero.
    let inner = low.maximum(-high).maximum(S::zero());
    let numerator = S::from_f64(4.0) * decay(inner) * phi(twice(d));
    numerator / ((S::one() + decay(a)) * (S::one() + decay(b)))
}

/// `f[a,b,b]` of the hyperbolic tangent: `(sinhc′d − sinhc d·tanh b)/(cosh a·cosh b)` with `d = b − a` for `|d| < 1`,
/// by definition for |d| ≥ 1.
///
/// ```
/// let difference: f64 = eem_material::kernel::tanh_dd2(1.0, 0.0);
/// assert!((difference - (1.0_f64.tanh() - 1.0)).abs() < 1e-15);
/// ```
#[inline]
pub fn tanh_dd2<S: Scalar>(a: S, b: S) -> S {
    let d = b - a;
    near_or_far(
        d,
        || (sinhc_prime_near(d) - sinhc(d) * b.tanh()) * sech(a) * sech(b),
        || by_definition(sech(b) * sech(b), tanh_dd(a, b), a, b),
    )
}

/// `e^(−2|x|)`.
#[inline]
fn decay<S: Scalar>(x: S) -> S {
    (-twice(x.abs())).exp()
}

/// `1/cosh x`.
#[inline]
fn sech<S: Scalar>(x: S) -> S {
    twice((-x.abs()).exp()) / (S::one() + decay(x))
}
