//! Smooth building blocks of the kernels, accurate to a few ulp at and near zero.
//!
//! Each removes one removable singularity. Where the library function is
//! already right for tiny arguments (`ln_1p`, `exp_m1`, `sin`), only 0/0 is
//! caught; where a difference would cancel, a polynomial of fixed length
//! takes over for |x| < 1, where its remainder is below 2⁻⁵⁷ of the value.

use crate::number::scalar::Scalar;

/// All divided differences of a function between two ends, with the bits of the single kernels.
///
/// Computed together, because they share most of the work.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Differences<S> {
    /// `f[a,b]`.
    pub first: S,
    /// `f[b,a,a] = ∂f[a,b]/∂a`.
    pub second_a: S,
    /// `f[a,b,b] = ∂f[a,b]/∂b`.
    pub second_b: S,
}

/// Number of terms of `Σ (±x)^k/(k+2)!` for |x| < 1; the first omitted one is below 1/22! < 2⁻⁶⁹.
const EXPONENTIAL_TERMS: usize = 20;

/// Number of terms of `Σ 2k(±x²)^(k−1)/(2k+1)!` for |x| < 1; the first omitted one is below 20/21! < 2⁻⁶¹.
const SINC_TERMS: usize = 9;

/// Splits 53 binary digits into halves: 2²⁷ + 1.
const SPLIT: f64 = 134_217_729.0;

/// `1/(k+2)!` for `k = 0, 1, …`: correctly rounded, as 21!/2¹⁸ < 2⁵³.
const EXPONENTIAL: [f64; EXPONENTIAL_TERMS] = exponential_coefficients();

/// `(−1)^k 2k/(2k+1)!` for `k = 1, 2, …`.
const SINC_PRIME: [f64; SINC_TERMS] = odd_coefficients(-1.0, true);

/// `2k/(2k+1)!` for `k = 1, 2, …`.
const SINHC_PRIME: [f64; SINC_TERMS] = odd_coefficients(1.0, true);

/// `1/(2k+1)!` for `k = 1, 2, …`.
const SINH_TAIL: [f64; SINC_TERMS] = odd_coefficients(1.0, false);

/// The polynomial of degree 7 nearest to `Σ z²ᵏ/(2k+3)` for z² < 1/25, up to 2⁻⁵⁶ (Remez 1934).
const AREA_TANGENT: [f64; 8] = [
    0.333_333_333_333_333_3,
    0.200_000_000_000_039_56,
    0.142_857_142_836_472_08,
    0.111_111_115_222_648_6,
    0.090_908_689_871_007_77,
    0.076_944_261_534_507,
    0.066_050_199_029_756_49,
    0.068_031_535_940_109_52,
];

const fn exponential_coefficients() -> [f64; EXPONENTIAL_TERMS] {
    let mut coefficients = [0.0; EXPONENTIAL_TERMS];
    let mut factorial = 2.0;
    let mut n = 2.0;
    let mut k = 0;
    while k < EXPONENTIAL_TERMS {
        coefficients[k] = 1.0 / factorial;
        n += 1.0;
        factorial *= n;
        k += 1;
    }
    coefficients
}

/// `sign^k n_k/(2k+1)!` for `k = 1, 2, …`, where `n_k` is `2k` for a slope, else 1.
const fn odd_coefficients(sign: f64, of_slope: bool) -> [f64; SINC_TERMS] {
    let mut coefficients = [0.0; SINC_TERMS];
    let mut factorial = 6.0;
    let mut even = 2.0;
    let mut signed = sign;
    let mut k = 0;
    while k < SINC_TERMS {
        let numerator = if of_slope { signed * even } else { signed };
        coefficients[k] = numerator / factorial;
        even += 2.0;
        factorial *= even * (even + 1.0);
        signed *= sign;
        k += 1;
    }
    coefficients
}

/// `Σ c_k x^k`: groups of four terms (Estrin 1960), then Horner's rule in `x⁴`.
///
/// The cost of a polynomial is its chain of dependent operations; this one is a third as long as
/// Horner's, at the same error bound.
#[inline]
fn polynomial<S: Scalar, const N: usize>(coefficients: &[f64; N], x: S) -> S {
    let square = x * x;
    let fourth = square * square;
    let pair = |low: f64, high: f64| S::from_f64(low) + x * S::from_f64(high);
    let (groups, rest) = coefficients.as_chunks::<4>();
    let mut sum = S::zero();
    for (k, &coefficient) in rest.iter().enumerate().rev() {
        let last = k + 1 == rest.len();
        sum = if last {
            S::from_f64(coefficient)
        } else {
            S::from_f64(coefficient) + x * sum
        };
    }
    for (k, &[a, b, c, d]) in groups.iter().enumerate().rev() {
        let group = pair(a, b) + square * pair(c, d);
        let last = rest.is_empty() && k + 1 == groups.len();
        sum = if last { group } else { group + fourth * sum };
    }
    sum
}

/// `(artanh z/z − 1)/z² = 1/3 + z²/5 + …` for `square = z² < 1/25`.
#[inline]
pub(super) fn area_tangent_tail<S: Scalar>(square: S) -> S {
    polynomial(&AREA_TANGENT, square)
}

/// `2x`, exact.
#[inline]
pub(super) fn twice<S: Scalar>(x: S) -> S {
    x + x
}

/// `x/2`, exact unless subnormal.
#[inline]
pub(super) fn half<S: Scalar>(x: S) -> S {
    S::from_f64(0.5) * x
}

/// The smaller end, the larger end, and their distance.
#[inline]
pub(super) fn ends<S: Scalar>(a: S, b: S) -> (S, S, S) {
    let (low, high) = (a.minimum(b), a.maximum(b));
    (low, high, high - low)
}

/// `near` for |x| < 1 and `far` elsewhere.
#[inline]
pub(super) fn near_or_far<S: Scalar>(x: S, near: impl FnOnce() -> S, far: impl FnOnce() -> S) -> S {
    if x.abs() < S::one() { near() } else { far() }
}

/// Neither infinite nor NaN: only then is the product with zero a number.
#[inline]
fn is_finite<S: Scalar>(x: S) -> bool {
    x * S::zero() == S::zero()
}

/// `value` if it is finite and not zero, `otherwise` if it over- or underflowed.
#[inline]
pub(super) fn in_range_or<S: Scalar>(value: S, otherwise: impl FnOnce() -> S) -> S {
    if value != S::zero() && is_finite(value) {
        value
    } else {
        otherwise()
    }
}

/// `f[a,b,b] = (f′(b) − f[a,b])/(b − a)` by definition: for distant ends only.
#[inline]
pub(super) fn by_definition<S: Scalar>(slope_at_b: S, difference: S, a: S, b: S) -> S {
    (slope_at_b - difference) / (b - a)
}

/// `φ₂(x) = (e^(−x) − 1 + x)/x²` for |x| < 1.
#[inline]
pub(super) fn phi2_near<S: Scalar>(x: S) -> S {
    polynomial(&EXPONENTIAL, -x)
}

/// `φ(d) = (1 − e^(−d))/d = 1 − d φ₂(d)` for `d ≥ 0`, condition at most 1.
///
/// Here and below the series is evaluated ahead of the branch: functions of the same argument share it.
#[inline]
pub(super) fn phi<S: Scalar>(d: S) -> S {
    let near = S::one() - d * phi2_near(d);
    near_or_far(d, || near, || phi_far(d))
}

/// `φ₂(x) = (e^(−x) − 1 + x)/x²` for `x ≥ 0`.
#[inline]
pub(super) fn phi2<S: Scalar>(x: S) -> S {
    let near = phi2_near(x);
    near_or_far(x, || near, || (S::one() - phi_far(x)) / x)
}

/// `φ₃(x) = (1 − (1 + x)e^(−x))/x² = 1 − (1 + x)φ₂(x)` for `x ≥ 0`.
#[inline]
pub(super) fn phi3<S: Scalar>(x: S) -> S {
    let near = S::one() - (S::one() + x) * phi2_near(x);
    near_or_far(x, || near, || (phi_far(x) - (-x).exp()) / x)
}

#[cold]
#[inline(never)]
fn phi_far<S: Scalar>(d: S) -> S {
    -(-d).exp_m1() / d
}

/// `ln(1 + d/w)` for `d ≥ 0`, `w ≥ 0`, also where `d/w` overflows.
#[inline]
pub(super) fn log_ratio<S: Scalar>(d: S, w: S) -> S {
    let u = d / w;
    if is_finite(u) {
        u.ln_1p()
    } else {
        d.ln() - w.ln()
    }
}

/// `ln(1 + d/w)/d` for `d ≥ 0`, `w > 0`: the divided difference of `ln` on `[w, w + d]`.
#[inline]
pub(super) fn log_difference<S: Scalar>(d: S, w: S) -> S {
    if d == S::zero() {
        w.recip()
    } else {
        log_ratio(d, w) / d
    }
}

/// `sinc x = sin x/x`.
#[inline]
pub(super) fn sinc<S: Scalar>(x: S) -> S {
    if x == S::zero() {
        S::one()
    } else {
        x.sin() / x
    }
}

/// `sinc′ x = (cos x − sinc x)/x`.
#[inline]
pub(super) fn sinc_prime<S: Scalar>(x: S) -> S {
    near_or_far(
        x,
        || x * polynomial(&SINC_PRIME, x * x),
        || (x.cos() - sinc(x)) / x,
    )
}

/// `sinhc x = sinh x/x`.
#[inline]
pub(super) fn sinhc<S: Scalar>(x: S) -> S {
    if x == S::zero() {
        S::one()
    } else {
        x.sinh() / x
    }
}

/// `sinhc′ x = (cosh x − sinhc x)/x` for |x| < 1.
#[inline]
pub(super) fn sinhc_prime_near<S: Scalar>(x: S) -> S {
    x * polynomial(&SINHC_PRIME, x * x)
}

/// `(sinhc x − 1)/x` for |x| < 1.
#[inline]
pub(super) fn sinhc_tail_near<S: Scalar>(x: S) -> S {
    x * polynomial(&SINH_TAIL, x * x)
}

/// `a + b = sum + error` exactly (Knuth 1969, `TwoSum`).
#[inline]
pub fn two_sum<S: Scalar>(a: S, b: S) -> (S, S) {
    let sum = a + b;
    let tail = sum - a;
    let error = (a - (sum - tail)) + (b - tail);
    (sum, error)
}

/// `ab = product + error` exactly in double precision (Dekker 1971), short of overflow.
#[inline]
pub(super) fn two_product<S: Scalar>(a: S, b: S) -> (S, S) {
    let product = a * b;
    let ((a_high, a_low), (b_high, b_low)) = (split(a), split(b));
    let cross = a_high * b_low + a_low * b_high;
    let error = ((a_high * b_high - product) + cross) + a_low * b_low;
    (product, error)
}

/// The upper and the lower half of the digits (Veltkamp 1968).
#[inline]
fn split<S: Scalar>(x: S) -> (S, S) {
    let shifted = S::from_f64(SPLIT) * x;
    let high = shifted - (shifted - x);
    (high, x - high)
}
