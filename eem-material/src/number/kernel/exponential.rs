//! The exponential function, and powers in which base and exponent both vary.

use super::primitives::{Differences, ends, phi, phi2, phi3};
use crate::number::scalar::Scalar;

/// `f[a,b]` of the exponential function, and of `eˣ − 1` (`exp_m1_dd`): `e^M φ(d)`
/// with `M = max(a,b)`, `d = |b − a|`, `φ(d) = (1 − e^(−d))/d`.
///
/// ```
/// assert!((eem::kernel::exp_dd(0.0, 1.0) - (1.0_f64.exp() - 1.0)).abs() < 1e-15);
/// assert_eq!(eem::kernel::exp_dd(0.0, 0.0), 1.0);
/// ```
#[inline]
pub fn exp_dd<S: Scalar>(a: S, b: S) -> S {
    let (_, high, d) = ends(a, b);
    high.exp() * phi(d)
}

/// `f[a,b,b]` of the exponential function, and of `eˣ − 1` (`exp_m1_dd2`).
///
/// ```text
/// f = eˣ:  f[a,b,b] = e^b φ₂(b − a)  (b ≥ a),   e^a φ₃(a − b)  (b < a)
/// φ₂(x) = (e^(−x) − 1 + x)/x²,  φ₃(x) = (1 − (1 + x)e^(−x))/x²
/// ```
///
/// ```
/// let difference: f64 = eem_material::kernel::exp_dd2(1.0, 0.0);
/// assert!((difference - (1.0_f64.exp() - 2.0)).abs() < 1e-15);
/// ```
#[inline]
pub fn exp_dd2<S: Scalar>(a: S, b: S) -> S {
    power_dd2(a.exp(), b.exp(), a, b)
}

/// `exp[X_a, X_b]` from values `e^X` that are already known.
///
/// ```text
/// exp[X_a,X_b] = max(e^X_a, e^X_b)·φ(|X_b − X_a|)
/// ```
///
/// For a power `gʰ` in which base and exponent both vary, `X = h ln g`. The
/// exponential of a rounded product would lose |h ln g| ulp; here
/// `value_a = g_aʰᵃ` and `value_b = g_bʰᵇ` come from [`Scalar::powf`], and
/// `X` enters only by its increment. The divided difference of `gʰ` is
/// this number times that of `h ln g`.
///
/// ```
/// let (x_a, x_b) = (2.0_f64.ln(), 2.0 * 2.0_f64.ln());
/// let difference = eem::kernel::power_dd(2.0, 4.0, x_a, x_b);
/// assert!((difference - 2.0 / 2.0_f64.ln()).abs() < 1e-15);
/// ```
#[inline]
pub fn power_dd<S: Scalar>(value_a: S, value_b: S, x_a: S, x_b: S) -> S {
    power_dds(value_a, value_b, x_a, x_b).first
}

/// `exp[X_a, X_b, X_b]` from values `e^X` that are already known.
///
/// ```text
/// exp[X_a,X_b,X_b] = e^X_b φ₂(X_b − X_a)  (X_b ≥ X_a),   e^X_a φ₃(X_a − X_b)  (X_b < X_a)
/// ```
///
/// The derivative of [`power_dd`] with respect to `X_b`.
///
/// ```
/// let e = 1.0_f64.exp();
/// let difference = eem_material::kernel::power_dd2(e, 1.0, 1.0, 0.0);
/// assert!((difference - (e - 2.0)).abs() < 1e-15);
/// ```
#[inline]
pub fn power_dd2<S: Scalar>(value_a: S, value_b: S, x_a: S, x_b: S) -> S {
    power_dds(value_a, value_b, x_a, x_b).second_b
}

/// All differences of the exponential function from values `e^X` that are already known:
/// [`power_dd`] and both [`power_dd2`].
///
/// ```
/// let all = eem_material::kernel::power_dds(1.0, 1.0, 0.0, 0.0);
/// assert_eq!((all.first, all.second_a, all.second_b), (1.0, 0.5, 0.5));
/// ```
#[expect(
    clippy::inline_always,
    reason = "what the caller does not use must not be computed"
)]
#[inline(always)]
pub fn power_dds<S: Scalar>(value_a: S, value_b: S, x_a: S, x_b: S) -> Differences<S> {
    let high = value_a.maximum(value_b);
    let distance = (x_b - x_a).abs();
    let [at_low, at_high] = [phi3(distance), phi2(distance)];
    Differences {
        first: high * phi(distance),
        second_a: high * if x_a < x_b { at_low } else { at_high },
        second_b: high * if x_b < x_a { at_low } else { at_high },
    }
}
