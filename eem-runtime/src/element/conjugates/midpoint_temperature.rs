//! The implicit midpoint rule in temperature variables: the ordinary rule, for comparison.
//!
//! ```text
//! z¹ − z⁰ = h ż((z⁰ + z¹)/2),      z = (q, p, γ, θ),   θ̇ = ((Σ g²/η + Q)/θ − s_λ λ̇ − s_γ γ̇)/s_θ
//! ```
//!
//! as Conde Martín, Betsch & García Orden (2016) run it. It keeps the momenta exactly.

use super::point::PointRule;
use crate::element::conjugates::element::Placement;

/// See the module.
#[derive(Debug)]
pub(crate) enum MidpointTemperature {}

impl PointRule for MidpointTemperature {
    const PLACEMENT: Placement = Placement::Middle;
    const IMPLICIT: f64 = 1.0;
    const AT: f64 = 0.5;
    const IN_TEMPERATURE: bool = true;
}
