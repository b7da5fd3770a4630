//! The weight of the end of a step with which a decay is exact.

use eem_material::number::kernel::{tanh_dd, tanh_dd2};
use eem_material::number::scalar::Scalar;

/// α with which `y¹ − y⁰ = −x (½ y⁰ + ½ y¹ + α (y¹ − y⁰))` is the exact decay `y¹ = y⁰ e^−x`, for x ≥ 0 (Liniger &
/// Willoughby 1970):
///
/// ```text
/// α(x) = 1/(1 − e^−x) − 1/x − 1/2 = (z − tanh z)/(2 z tanh z),   z = x/2
/// ```
///
/// `x/12` for small x, `½ − 1/x` for large ones. With divided differences of tanh no difference is formed:
/// `tanh[z,0,0] = −(z − tanh z)/z²`, `tanh[0,z] = tanh(z)/z`.
pub(crate) fn end_weight(x: f64) -> f64 {
    // From 1/ε on, α is ½ to rounding.
    let z = 0.5 * Scalar::minimum(x, f64::EPSILON.recip());
    -0.5 * tanh_dd2(z, 0.0) / tanh_dd(0.0, z)
}

/// `α(x)/x`, also where a decay has the rate zero or grows: 1/12.
pub(crate) fn end_weight_over(x: f64) -> f64 {
    if x > 0.0 {
        end_weight(x) / x
    } else {
        1.0 / 12.0
    }
}

#[cfg(test)]
mod tests {
    use super::end_weight;

    #[test]
    fn decays_are_exact_for_any_rate() {
        for exponent in -60..40 {
            let x = 1.7_f64.powi(exponent);
            let alpha = end_weight(x);
            // α = x/12 − x³/720 + …, whose next term is x⁵/30240; else its definition, which loses 1/x digits.
            let (expected, error) = if x < 1e-2 {
                (x / 12.0 - x.powi(3) / 720.0, x.powi(5) / 30240.0)
            } else {
                let by_definition = -1.0 / (-x).exp_m1() - 1.0 / x - 0.5;
                (by_definition, 4.0 * f64::EPSILON * (1.0 / x + 1.0))
            };
            let rounding = 32.0 * f64::EPSILON * expected;
            assert!(
                (alpha - expected).abs() <= error + rounding,
                "x = {x}: {alpha}, {expected}"
            );
            assert!((0.0..=0.5).contains(&alpha));
        }
        // With the rounding of the kernels, as above.
        let ends = [(0.0, 0.0), (f64::MAX, 0.5), (f64::INFINITY, 0.5)];
        for (x, expected) in ends {
            assert!((end_weight(x) - expected).abs() <= 32.0 * f64::EPSILON * expected);
        }
    }
}
