//! Integer powers: sums of products of equal sign, for ends of any sign.

use super::primitives::{ends, half, in_range_or, twice, two_product};
use crate::number::scalar::{Scalar, natural_power};

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
/// use eem::kernel::powi_dd;
///
/// assert_eq!(powi_dd(2.0, 3.0, 3), 19.0);
/// assert_eq!(powi_dd(-7.0, 7.0, 4), 0.0);
/// assert_eq!(powi_dd(2.0, 4.0, -1), -0.125);
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
/// use eem::kernel::powi_dd2;
///
/// assert_eq!(powi_dd2(2.0, 3.0, 3), 8.0);
/// assert_eq!(powi_dd2(2.0, 4.0, -1), 0.03125);
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

/// `numerator/(aⁿbⁿ)`, the larger power first: what it divides is of nearly its size.
fn over_powers<S: Scalar>(numerator: S, a: S, b: S, n: u32) -> S {
    let (a_power, b_power) = (compensated_power(a, n), compensated_power(b, n));
    S::branch(
        a_power.abs().less(b_power.abs()),
        || numerator / b_power / a_power,
        || numerator / a_power / b_power,
    )
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
