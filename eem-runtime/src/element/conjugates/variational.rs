//! The variational integrator of second order.
//!
//! Hamilton's principle for the action with thermacies α, α̇ = θ, by the midpoint rule with λ, γ and α
//! linear in time (Kern, Romero, Conde Martín & García Orden 2021, §III.A):
//!
//! ```text
//! p⁰ = m v + ½h f_m ∂λ/∂q⁰,   p¹ = m v − ½h f_m ∂λ/∂q¹,   v = (q¹ − q⁰)/h
//! f_m = ∂ψ/∂λ,  g_m = −∂ψ/∂γ,  s_m = −∂ψ/∂θ      at (½(λ⁰ + λ¹), γ_m, θ_m)
//! s⁰ = s_m − ½hΦ,   s¹ = s_m + ½hΦ,   Φ = (Σ g_m γ̇ + Q)/θ_m,   γ̇ = g_m/η(θ_m)
//! ```
//!
//! Momenta are kept exactly, the energy stays near its value. With λ of the mean configuration
//! instead of the mean length it would be the implicit midpoint rule.

use super::point::PointRule;
use crate::element::conjugates::element::Placement;

/// See the module.
#[derive(Debug)]
pub(crate) enum Variational {}

impl PointRule for Variational {
    const PLACEMENT: Placement = Placement::Start;
    const IMPLICIT: f64 = 1.0;
    const AT: f64 = 0.5;
}
