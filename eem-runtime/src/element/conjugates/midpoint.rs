//! The implicit midpoint rule in entropy variables: the ordinary rule, for comparison.
//!
//! ```text
//! f* = ∂ψ/∂λ,  g* = −∂ψ/∂γ,  θ* = θ̂      at (λ(q_m), γ_m, s_m)
//! ```
//!
//! It keeps the momenta exactly (Noether), energy and entropy only to second order.

use super::point::PointRule;
use crate::element::conjugates::element::Placement;

/// See the module.
#[derive(Debug)]
pub(crate) enum Midpoint {}

impl PointRule for Midpoint {
    const PLACEMENT: Placement = Placement::Middle;
    const IMPLICIT: f64 = 1.0;
    const AT: f64 = 0.5;
}
