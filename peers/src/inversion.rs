//! The temperature of an entropy, by Newton's method on ln θ from the temperature found last.
//!
//! ```text
//! δ = (s − s(θ))/c(θ),   θ ← θ exp(δ),   until |δ| ≤ 10⁻⁸; then θ (1 + δ)
//! ```
//!
//! What is left is quadratic in the last δ: rounding. Where c is constant, the first update is exact.

use crate::springs::{Caloric, Number};

/// The last δ: its square is rounding.
const LAST: f64 = 1e-8;

/// Far more than any state of the cases needs.
const MOST: usize = 40;

/// θ with `s(θ) = entropy`, K; `warm`, K, is where the search begins, and afterwards what it found. Not a number
/// if there is no such temperature. Derivatives come along: those of the last update are exact.
pub(crate) fn temperature<R: Number>(caloric: Caloric<R>, entropy: R, warm: &mut f64) -> R {
    let Caloric { a, b, c, theta_ref } = caloric;
    let mut theta = *warm;
    for _ in 0..MOST {
        let capacity = -b / theta + c;
        let delta = (entropy - a - b / theta - c * (theta / theta_ref).ln()) / capacity;
        if delta.re().abs() <= LAST {
            let found = (delta + 1.0) * theta;
            *warm = found.re();
            return found;
        }
        theta *= delta.re().exp();
    }
    R::from(f64::NAN)
}
