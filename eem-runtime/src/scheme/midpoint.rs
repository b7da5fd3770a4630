//! The implicit midpoint rule in entropy variables: the ordinary rule, for comparison.
//!
//! ```text
//! f* = ∂ψ/∂λ,  g* = −∂ψ/∂γ,  θ* = θ̂      at (λ(q_m), γ_m, s_m)
//! ```
//!
//! It keeps the momenta exactly (Noether), energy and entropy only to second order.

use super::{ElementScheme, Infeasible, Placement, Start, point};
use crate::free_energy::FreeEnergy;
use crate::scalar::Real;

/// See the module.
#[derive(Debug)]
pub(crate) enum Midpoint {}

impl<S: Real, M: FreeEnergy<S> + Send + Sync + 'static> ElementScheme<S, M> for Midpoint {
    const PLACEMENT: Placement = Placement::Middle;
    const IMPLICIT: f64 = 1.0;

    type Old = ();

    fn old(_: &M, _: &M::Variables) -> Self::Old {}

    fn temperature(
        model: &M,
        start: &Start<S, M, Self::Old>,
        x: &M::Variables,
        entropy_change: S,
    ) -> Result<S, Infeasible> {
        point::temperature(model, start, x, entropy_change, S::from_f64(0.5))
    }

    fn respond(
        model: &M,
        start: &Start<S, M, Self::Old>,
        x: &M::Variables,
        _: &mut M::Corners,
    ) -> Result<(M::Response, M::Tangent), Infeasible> {
        Ok(point::respond(model, start, x, S::from_f64(0.5)))
    }
}
