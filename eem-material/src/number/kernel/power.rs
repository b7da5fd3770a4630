//! Powers: reciprocal and roots, rational in the values at the two ends; powers with a real exponent that is the same at both
//! ends; integer powers, sums of products of equal sign, for ends of any sign.

use super::logarithm::ln_dd;
use super::primitives::{
    by_definition, ends, half, in_range_or, log_ratio, near_or_far, phi, phi2_near, twice,
    two_product,
};
use crate::number::scalar::{Scalar, natural_power};

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

/// `f[a,b]` of a power with a constant exponent, for `a, b ≥ 0`: `mᵖ expm1(x)/d`
/// with `x = p ln(1 + d/m)`, `m = min(a,b)`, `d = |b − a|` for |x| < 1,
/// `(Mᵖ − mᵖ)/d` with `M = max(a,b)` for |x| ≥ 1, where the quotient of the two powers exceeds e.
///
/// ```
/// assert_eq!(eem::kernel::powf_dd(1.0, 4.0, 1.5), 7.0 / 3.0);
/// assert_eq!(eem::kernel::powf_dd(0.0, 4.0, 0.5), 0.5);
/// assert_eq!(eem::kernel::powf_dd(4.0, 4.0, 1.5), 3.0);
/// ```
#[inline]
pub fn powf_dd<S: Scalar>(a: S, b: S, p: S) -> S {
    let (low, high, d) = ends(a, b);
    if d == S::zero() {
        return slope(low, p);
    }
    let x = p * log_ratio(d, low);
    near_or_far(
        x,
        || low.powf(p) * x.exp_m1() / d,
        || (high.powf(p) - low.powf(p)) / d,
    )
}

/// `f[a,b,b]` of a power with a constant exponent, for `a, b ≥ 0`: `pL bᵖ (p φ₂(pδ)/b − L φ(pδ) φ₂(δ))`
/// with `L = ln[a,b]`, `δ = (b − a)L = ln(b/a)` for |δ|, |pδ| < 1; by definition elsewhere. For `½ < p < 3/2`, where the
/// terms would cancel, `xᵖ = x·x^(p−1)` with the Leibniz rule.
///
/// ```
/// assert!((eem::kernel::powf_dd2(4.0, 4.0, 1.5_f64) - 0.1875).abs() < 1e-15);
/// assert_eq!(eem::kernel::powf_dd2(1.0, 4.0, 2.0), 1.0);
/// ```
#[inline]
pub fn powf_dd2<S: Scalar>(a: S, b: S, p: S) -> S {
    let reduced = p - S::one();
    if b == S::zero() {
        at_zero_dd2(a, p)
    } else if reduced.abs() < S::from_f64(0.5) {
        product_dd2(a, b, reduced)
    } else {
        direct_dd2(a, b, p)
    }
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
    if a == zero {
        half(p) * slope(zero, p - S::one())
    } else {
        by_definition(slope(zero, p), powf_dd(a, zero, p), a, zero)
    }
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
    if b < a {
        b * second() + powf_dd(a, b, q)
    } else if a == S::zero() {
        // a·g[a,b,b] vanishes with a, although g may be singular.
        slope(b, q)
    } else {
        slope(b, q) + a * second()
    }
}

/// `f[a,b]` of an integer power, for any signs (negative `n`: `a, b ≠ 0`).
///
/// ```text
/// f = xⁿ:   f[a,b] = Pₙ(a,b) = Σ a^i b^(n−1−i)
/// n = 2j:   Pₙ = (a + b)·P_j(a²,b²)
/// n = 2j+1: Pₙ = ½(a^(2j) + b^(2j) + (a + b)²·P_j(a²,b²))
/// f = x⁻ⁿ:  f[a,b] = −Pₙ(a,b)/(aⁿbⁿ)
/// ```
///
/// The factor `a + b` carries the exact zero at `b = −a`; everything else is
/// positive. The error is at most `½|n| + 1` ulp.
///
/// ```
/// assert_eq!(eem::kernel::powi_dd(2.0, 3.0, 3), 19.0);
/// assert_eq!(eem::kernel::powi_dd(-7.0, 7.0, 4), 0.0);
/// assert_eq!(eem::kernel::powi_dd(2.0, 4.0, -1), -0.125);
/// ```
#[inline]
pub fn powi_dd<S: Scalar>(a: S, b: S, n: i32) -> S {
    let order = n.unsigned_abs();
    if n >= 0 {
        return difference(a, b, order);
    }
    in_range_or(-over_powers(difference(a, b, order), a, b, order), || {
        let (x, y, _) = ends(a.recip(), b.recip());
        -difference(x, y, order) * x * y
    })
}

/// `f[a,b,b]` of an integer power, for any signs (negative `n`: `a, b` of one sign).
///
/// ```text
/// f = xⁿ:   f[a,b,b] = Qₙ(a,b) = Σ (i + 1) a^(n−2−i) b^i
/// n = 2j:   Qₙ = P_j(a²,b²) + 2b(a + b)·Q_j(a²,b²)
/// n = 2j+1: Qₙ = b·Q_2j(a,b) + P_2j(a,b)
/// f = x⁻ⁿ:  f[a,b,b] = Qₙ₊₁(b,a)/(aⁿbⁿ⁺¹)
/// ```
///
/// ```
/// assert_eq!(eem::kernel::powi_dd2(2.0, 3.0, 3), 8.0);
/// assert_eq!(eem::kernel::powi_dd2(2.0, 4.0, -1), 0.03125);
/// ```
#[inline]
pub fn powi_dd2<S: Scalar>(a: S, b: S, n: i32) -> S {
    let order = n.unsigned_abs();
    if n >= 0 {
        return second_difference(a, b, order);
    }
    let numerator = second_difference(b, a, order + 1);
    in_range_or(over_powers(numerator, a, b, order) / b, || {
        let (x, y) = (a.recip(), b.recip());
        second_difference(x, y, order + 1) * y * y * x
    })
}

/// `numerator/(aⁿbⁿ)`, divided by the larger power first, which is of nearly the size of the numerator.
fn over_powers<S: Scalar>(numerator: S, a: S, b: S, n: u32) -> S {
    let (a_power, b_power) = (compensated_power(a, n), compensated_power(b, n));
    if a_power.abs() < b_power.abs() {
        numerator / b_power / a_power
    } else {
        numerator / a_power / b_power
    }
}

/// `base^n` rounded nearly once: the rounding errors of the products are carried along.
///
/// Without this the two powers of a divisor would double the error of `Pₙ`.
fn compensated_power<S: Scalar>(base: S, n: u32) -> S {
    let mut remaining = n;
    let mut square = (base, S::zero());
    let mut power = if n.is_multiple_of(2) {
        (S::one(), S::zero())
    } else {
        square
    };
    while remaining > 1 {
        remaining /= 2;
        square = compensated_product(square, square);
        if !remaining.is_multiple_of(2) {
            power = compensated_product(power, square);
        }
    }
    power.0 + power.1
}

/// The product of two numbers with their errors, to first order in the errors.
#[inline]
fn compensated_product<S: Scalar>(a: (S, S), b: (S, S)) -> (S, S) {
    let (product, error) = two_product(a.0, b.0);
    (product, error + (a.0 * b.1 + a.1 * b.0))
}

/// `Pₙ(a,b)`, bitwise symmetric.
fn difference<S: Scalar>(a: S, b: S, n: u32) -> S {
    match n {
        0 => S::zero(),
        1 => S::one(),
        2 => a + b,
        _ => {
            let (a2, b2, sum) = (a * a, b * b, a + b);
            let inner = difference(a2, b2, n / 2);
            if n.is_multiple_of(2) {
                sum * inner
            } else {
                let ends = natural_power(a2, n / 2) + natural_power(b2, n / 2);
                half(ends + sum * sum * inner)
            }
        }
    }
}

/// `Qₙ(a,b)`.
fn second_difference<S: Scalar>(a: S, b: S, n: u32) -> S {
    difference_pair(a, b, n).1
}

/// `(Pₙ(a,b), Qₙ(a,b))`.
fn difference_pair<S: Scalar>(a: S, b: S, n: u32) -> (S, S) {
    match n {
        0 => (S::zero(), S::zero()),
        1 => (S::one(), S::zero()),
        2 => (a + b, S::one()),
        _ => {
            let (a2, b2, sum) = (a * a, b * b, a + b);
            let (first, second) = difference_pair(a2, b2, n / 2);
            let even = (sum * first, first + twice(b) * sum * second);
            if n.is_multiple_of(2) {
                even
            } else {
                // x·x²ʲ with the Leibniz rule, nodes in the order b, a, b.
                (natural_power(a2, n / 2) + b * even.0, even.0 + b * even.1)
            }
        }
    }
}
