//! The trapezoidal rule in entropy variables: the ordinary rule, for comparison.
//!
//! ```text
//! z¹ − z⁰ = ½h (ż(z⁰) + ż(z¹)),      z = (q, p, γ, s)
//! ```
//!
//! It keeps none of the laws.

use super::{ElementScheme, Infeasible, Placement, Start, point};
use crate::free_energy::FreeEnergy;
use crate::scalar::Real;

/// See the module.
#[derive(Debug)]
pub(crate) enum Trapezoidal {}

impl<S: Real, M: FreeEnergy<S> + Send + Sync + 'static> ElementScheme<S, M> for Trapezoidal {
    const PLACEMENT: Placement = Placement::End;
    const IMPLICIT: f64 = 0.5;

    type Old = ();

    fn old(_: &M, _: &M::Variables) -> Self::Old {}

    fn temperature(
        model: &M,
        start: &Start<S, M, Self::Old>,
        x: &M::Variables,
        entropy_change: S,
    ) -> Result<S, Infeasible> {
        point::temperature(model, start, x, entropy_change, S::one())
    }

    fn respond(
        model: &M,
        start: &Start<S, M, Self::Old>,
        x: &M::Variables,
        _: &mut M::Corners,
    ) -> Result<(M::Response, M::Tangent), Infeasible> {
        Ok(point::respond(model, start, x, S::one()))
    }
}
