//! Damping towards the end of a step, of conduction and of dashpots in series.
//!
//! # Conduction
//!
//! Heat flows at a temperature Θ nearer to the end than θ*.
//!
//! ```text
//! Θ = θ* + 2α (θ⁰ eʸ − θ⁰ (eʸ − 1)/y) = θ* + 2α θ⁰ y exp[0,y,y],     y = Δs/c⁰
//! ```
//!
//! In a body of constant heat capacity whose entropy changes by Δs at fixed configuration, the bracket is the distance from
//! its mean temperature θ* to the new one: with α = 0, heat flows at the mean temperature, with α = ½ at the new one.
//!
//! Conduction is driven by Θ, and the heat balance stays `θ* Δs = Σ dissipation + Σ Q`. Then
//!
//! ```text
//! Δs = (Σ dissipation + Σ Q)/Θ + (Θ − θ*) Δs/Θ
//! ```
//!
//! Paths produce `Q (1/Θ_a − 1/Θ_b) ≥ 0`, dashpots their heat over Θ, and each element `(Θ − θ*) Δs/Θ ≥ 0`, because
//! `Θ − θ*` has the sign of Δs. So both laws hold for every α ≥ 0, whatever the heat capacity and the motion are.
//!
//! With `x_a = h Σ_b κ_ab (1/c_a + 1/c_b)`, [`α(x_a)`](crate::element::conjugates::end_weight) makes the decay of two bodies
//! exact for small differences of temperature, for larger ones up to their square over the temperature. No linear network
//! alternates: `½ − α ≤ 1/x`, and `hK ≤ diag(x_a c_a)` for every path, since `(u − v)² ≤ (1 + t) u² + (1 + 1/t) v²` with `t = c_a/c_b`. Reservoirs, and
//! elements at thermostats, have infinite capacity. Steady states stay the same, because Δs = 0 there.
//!
//! # Dashpots
//!
//! The forces g of the dashpots change in a step by `Δg = −(ψ_γπ Δπ + ψ_γγ Δγ)`, to first order, with the derivatives at its start. In
//! the [modes](super::modes) in which they relax at fixed measures π, at the rates ϱ, the dashpots have the viscosity 1 and Δg
//! the parts `Δg_i = b_i·(Δπ, Δγ)`. Artificial dashpots act against each part, with the dissipation `Σ P_i²` in a step:
//!
//! ```text
//! P_i = √(h α(x_i)/x_i) Δg_i,     x_i = h ϱ_i,     forces ∂(½ Σ P²)/∂Δπ beside f*, −∂(½ Σ P²)/∂Δγ beside g*
//! ```
//!
//! They are internal forces that depend on π and γ only, and their work `Σ P_i²` is heat of the element: both laws and all momenta stay
//! exact. At fixed measures a mode decays by the factor `e^−x_i`, if ψ is quadratic. A branch `½ k (λ − γ)²` has
//! `x = hk/η` and a dashpot of the viscosity `h α k` in parallel with its spring. It bears nothing while γ creeps as fast
//! as λ, so that a steady flow keeps its force. Since α(x)/x is 1/12 for short steps, the order stays 2. Other couplings, of the
//! branches by masses that they move and by temperatures, are not damped.

use eem_material::free_energy::Array;
use eem_material::number::kernel::exp_dd2;
use eem_material::number::scalar::Scalar;

/// The damping of a point; `V` has an entry per variable, `H` a row of them per variable.
#[derive(Clone, Copy, Debug)]
pub(super) struct Damping<V, H> {
    /// `2α θ⁰`, K, constant in a step; zero without paths of heat, and where a thermostat prescribes the temperature.
    pub(super) weight: f64,
    /// `1/c⁰`, K/J.
    pub(super) per_capacity: f64,
    /// The derivatives of P, constant in a step, a row per mode.
    pub(super) modes: H,
    /// P of the trial, an entry per mode, √J.
    pub(super) parts: V,
    /// What the trial adds to the rows of the response.
    pub(super) force: V,
}

impl<V: Array<f64>, H: Array<V>> Damping<V, H> {
    pub(super) fn none() -> Self {
        let zeros = V::filled(0.0);
        Self {
            weight: 0.0,
            per_capacity: 0.0,
            modes: H::filled(zeros),
            parts: zeros,
            force: zeros,
        }
    }

    /// `Θ − θ*` for a change Δs of the entropy, over it, K²/J, and its derivative with respect to Δs, K²/J.
    pub(super) fn shift(&self, change: f64) -> [f64; 2] {
        let y = change * self.per_capacity;
        let factor = self.weight * self.per_capacity;
        let difference = exp_dd2(0.0, y);
        // (y exp[0,y,y])′ = eʸ − exp[0,y,y]
        [factor * difference, factor * (Scalar::exp(y) - difference)]
    }
}
