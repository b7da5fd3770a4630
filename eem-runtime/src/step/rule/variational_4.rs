//! The variational integrator of fourth order.
//!
//! Hamilton's principle for the action with thermacies α, α̇ = θ, by Simpson's rule with q and α quadratic in time (Kern,
//! Romero, Conde Martín & García Orden 2021, §III.A, eqs. 21–24). Stages `i = 0, m, 1` are the nodes of the rule; λ
//! follows from the positions of the nodes there, `F = f ∂λ/∂q` less the loads. With `Φ = (Σ g²/η + Q)/θ` the equations
//! of one step are
//!
//! ```text
//! v_0 = (−3q⁰ + 4q_m − q¹)/h,   v_m = (q¹ − q⁰)/h,   v_1 = (q⁰ − 4q_m + 3q¹)/h,   θ_m = ½(θ_0 + θ_1)
//!
//! p⁰ =  ½m v_0 + ⅔m v_m − ⅙m v_1 + (h/6)F_0      s⁰ =  ½s_0 + ⅔s_m − ⅙s_1 − (h/6)Φ_0
//! 0  =  ⅔m(v_0 − v_1)            − (2h/3)F_m     0  =  ⅔(s_0 − s_1)        + (2h/3)Φ_m
//! p¹ = −⅙m v_0 + ⅔m v_m + ½m v_1 − (h/6)F_1      s¹ = −⅙s_0 + ⅔s_m + ½s_1 + (h/6)Φ_1
//! ```
//!
//! with `s_i = s(λ_i, γ_i, θ_i)`. For q and p this is the pair Lobatto IIIA–IIIB of three stages, so that
//!
//! ```text
//! q_m = q⁰ + (h/2m)(p⁰ − (h/12)(2F_0 + F_m))
//! q¹  = q⁰ + (h/m) (p⁰ − (h/6) (F_0 + 2F_m)),     p¹ = p⁰ − (h/6)(F_0 + 4F_m + F_1)
//! ```
//!
//! The temperatures `θ_0`, `θ_1` are those of the stages and not those of the states, from which they differ by O(h²). As
//! θ is linear in time, the balance of entropy leaves a residual; it is orthogonal to linear functions in Simpson's rule,
//! so that the scheme has the order four of the pair.
//!
//! Viscous stretches are collocated (Lobatto IIIA), `γ̇_i = g_i/η(θ_i)` at all stages:
//!
//! ```text
//! γ_m = γ⁰ + (h/24)(5γ̇_0 + 8γ̇_m − γ̇_1),   γ¹ = γ⁰ + (h/6)(γ̇_0 + 4γ̇_m + γ̇_1)
//! ```
//!
//! Here the scheme departs from the paper. L has no γ̇, so that the literal discrete equations for a quadratic γ carry a
//! momentum conjugate to γ from step to step, which should be zero and is not kept there: for `g = −kγ` and `x = hk/η`
//! their matrix has the trace `(8 + 2x²)/(4 + x)` and the determinant `(4 − x)/(4 + x)`, and besides the root `e^{−x}`
//! one that grows like `e^{x/2}`.
//!
//! Momenta are kept exactly. The energy stays near its value while steps resolve the motion:
//! vibrations of frequency ω are stable for `ωh < √8`, as with the pair, and not for any step as with
//! the midpoint rule. Dashpots and conduction are stable for any step; a rate z/h decays by the
//! Padé approximation `(1 − z/2 + z²/12)/(1 + z/2 + z²/12)` of `e^{−z}`. Total entropy never decreases: it
//! grows by `(h/6)(P_0 + 4P_m + P_1)` with the production `P ≥ 0` of each stage.

use crate::element::tableau::{Ending, EntropyBalance, Tableau};

/// Simpson's rule.
const STEP: [f64; 3] = [1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0];

/// From the start to the middle (Lobatto IIIA).
const TO_MIDDLE: [f64; 3] = [5.0 / 24.0, 8.0 / 24.0, -1.0 / 24.0];

/// See the module.
pub(crate) static TABLEAU: Tableau = Tableau {
    times: &[0.0, 0.5, 1.0],
    known: 1,
    positions: &[&[1.0 / 6.0, 1.0 / 12.0, 0.0], &[1.0 / 6.0, 1.0 / 3.0, 0.0]],
    rates: &[&TO_MIDDLE, &STEP],
    weights: &STEP,
    temperatures: &[&[1.0, 0.0], &[0.5, 0.5], &[0.0, 1.0]],
    entropies: &[
        EntropyBalance {
            entropies: &[1.0 / 2.0, 2.0 / 3.0, -1.0 / 6.0],
            old: 1.0,
            rates: &[1.0 / 6.0, 0.0, 0.0],
            stage: 0,
            unknown: 0,
            supply: &[1.0, 0.0, 0.0],
        },
        EntropyBalance {
            entropies: &[-1.0, 0.0, 1.0],
            old: 0.0,
            rates: &[0.0, 1.0, 0.0],
            stage: 1,
            unknown: 2,
            supply: &[0.0, 2.0 / 3.0, 0.0],
        },
    ],
    motion: &[&[4.0, -1.0], &[0.0, 1.0], &[-4.0, 3.0]],
    ending: Ending::StageByStage,
    path: None,
};

#[cfg(test)]
mod tests {
    /// The matrix of one step of `(γ, π)`, π conjugate to γ, by the literal discrete Euler–Lagrange
    /// equations with `L = −½kγ²`, `f = −ηγ̇` and a quadratic γ, where `x = hk/η`.
    fn literal_step(x: f64) -> [[f64; 2]; 2] {
        // In units of h k γ/6 and with v = hγ̇ from the interpolation:
        //   π⁰ = γ⁰ + v_0/x,   0 = γ_m + v_m/x,   π¹ = −γ¹ − v_1/x.
        let step = |gamma: f64, momentum: f64| {
            // v_m = γ¹ − γ⁰ = −x γ_m and v_0 = −3γ⁰ + 4γ_m − γ¹ = x(π⁰ − γ⁰).
            let middle = (4.0 * gamma + x * (momentum - gamma)) / (4.0 + x);
            let end = gamma - x * middle;
            let last = gamma - 4.0 * middle + 3.0 * end;
            [end, -end - last / x]
        };
        let (first, second) = (step(1.0, 0.0), step(0.0, 1.0));
        [[first[0], second[0]], [first[1], second[1]]]
    }

    #[test]
    fn literal_equations_for_the_viscous_stretch_have_a_root_that_grows() {
        for x in [0.01, 0.1, 1.0] {
            let [[a, b], [c, d]] = literal_step(x);
            let (trace, determinant) = (a + d, a * d - b * c);
            assert!((trace - (8.0 + 2.0 * x * x) / (4.0 + x)).abs() < 1e-12);
            assert!((determinant - (4.0 - x) / (4.0 + x)).abs() < 1e-12);
            let root = (0.25 * trace * trace - determinant).sqrt();
            let [decays, grows] = [0.5 * trace - root, 0.5 * trace + root];
            // Second and first order of the roots e^{−x} and e^{x/2}.
            assert!((decays - (-x).exp()).abs() < x * x * x, "{decays}");
            assert!((grows - (0.5 * x).exp()).abs() < x * x, "{grows}");
            assert!(grows > 1.0);
        }
    }
}
