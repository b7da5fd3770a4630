//! Gauss collocation of two stages, of order 4: the classical scheme of that order, for comparison.
//!
//! ```text
//! z_i = z⁰ + h Σ_j a_ij ż_j,   z¹ = z⁰ + ½h (ż_1 + ż_2),      z = (q, p, γ, s),   c = ½ ∓ √3/6
//! ```
//!
//! (Hairer, Lubich & Wanner 2006, *Geometric numerical integration*, table II.1.1). Positions and momenta together are
//! `q_i = q⁰ + h c_i p⁰/m − (h²/m) Σ_j (A²)_ij F_j`. It is symplectic where nothing is dissipated, conserves momenta up
//! to the residuals of Newton's method, and guarantees no law of thermodynamics.

use crate::element::tableau::{Ending, EntropyBalance, Tableau};

/// √3/6.
const ROOT: f64 = 0.288_675_134_594_812_9;
const FIRST: f64 = 0.5 - ROOT;
const SECOND: f64 = 0.5 + ROOT;

/// A.
const RATES: [[f64; 2]; 2] = [[0.25, 0.25 - ROOT], [0.25 + ROOT, 0.25]];

/// `A²/c`.
const POSITIONS: [[f64; 2]; 2] = [
    [1.0 / 24.0 / FIRST, (0.125 - 0.5 * ROOT) / FIRST],
    [(0.125 + 0.5 * ROOT) / SECOND, 1.0 / 24.0 / SECOND],
];

/// `A⁻¹`.
const MOTION: [[f64; 2]; 2] = [[3.0, 12.0 * ROOT - 3.0], [-3.0 - 12.0 * ROOT, 3.0]];

/// `½A⁻¹`, transposed.
const SUPPLY: [[f64; 2]; 2] = [[1.5, -1.5 - 6.0 * ROOT], [6.0 * ROOT - 1.5, 1.5]];

/// `θ_i` and `s_i` are those of the stage.
const OWN: [[f64; 2]; 2] = [[1.0, 0.0], [0.0, 1.0]];

/// See the module.
pub(crate) static TABLEAU: Tableau = RULE;

/// The coefficients, which [`eem_entropy_4`](super::eem_entropy_4) shares.
pub(super) const RULE: Tableau = Tableau {
    times: &[FIRST, SECOND],
    known: 0,
    positions: &[&POSITIONS[0], &POSITIONS[1]],
    rates: &[&RATES[0], &RATES[1]],
    weights: &[0.5, 0.5],
    temperatures: &[&OWN[0], &OWN[1]],
    entropies: &[balance(0), balance(1)],
    motion: &[&MOTION[0], &MOTION[1]],
    // bᵀA: b_j (1 − c_j).
    ending: Ending::Forces(&[0.5 * SECOND, 0.5 * FIRST]),
    path: None,
};

const fn balance(stage: usize) -> EntropyBalance {
    EntropyBalance::of_stage(stage, [&OWN[stage], &RATES[stage], &SUPPLY[stage]])
}
