//! The trapezoidal rule in temperature variables: the ordinary rule, for comparison.
//!
//! ```text
//! z¹ − z⁰ = ½h (ż(z⁰) + ż(z¹)),      z = (q, p, γ, θ),   θ̇ = ((Σ g²/η + Q)/θ − s_λ λ̇ − s_γ γ̇)/s_θ
//! ```
//!
//! as Conde Martín, Betsch & García Orden (2016) run it. It keeps none of the laws.

use super::point::PointRule;
use crate::element::conjugates::element::Placement;

/// See the module.
#[derive(Debug)]
pub(crate) enum TrapezoidalTemperature {}

impl PointRule for TrapezoidalTemperature {
    const PLACEMENT: Placement = Placement::End;
    const IMPLICIT: f64 = 0.5;
    const AT: f64 = 1.0;
    const IN_TEMPERATURE: bool = true;
}
