//! Damping towards the end of a step: heat flows at a temperature Θ nearer to the end than θ*.
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
//! Dashpots are left as they are. A viscosity `η + h α k` would damp a free relaxation in the same way, but also slow a
//! dashpot that creeps steadily under a load, by the factor `1 + α hk/η`.

use eem_material::number::kernel::exp_dd2;
use eem_material::number::scalar::Scalar;

/// The damping of a point, constant in a step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Damping {
    /// `2α θ⁰`, K; zero without paths of heat, and where a thermostat prescribes the temperature.
    pub(super) weight: f64,
    /// `1/c⁰`, K/J.
    pub(super) per_capacity: f64,
}

impl Damping {
    pub(super) fn none() -> Self {
        Self {
            weight: 0.0,
            per_capacity: 0.0,
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
