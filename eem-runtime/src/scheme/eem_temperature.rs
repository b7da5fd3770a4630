//! The energy–entropy–momentum scheme in temperature form.
//!
//! ```text
//! θ* = D_θ e / D_θ s,   f* = D_λ e − θ* D_λ s,   g* = −(D_γ e − θ* D_γ s)
//! ```
//!
//! with partitioned discrete derivatives of e(λ, γ, θ) and s(λ, γ, θ) (Conde Martín, Betsch & García
//! Orden 2016, eqs. 37–39). `f*Δλ − g*Δγ + θ*Δs = Δe` exactly, hence the first law; `θ*` is
//! a mean of temperatures weighted with the heat capacity, hence positive, hence the second. No
//! inversion is needed: the new temperature is the unknown.

use super::{Answer, ElementScheme, ElementTrial, Infeasible, Placement, Start};
use crate::free_energy::{Array, FreeEnergy};
use crate::scalar::Real;

/// See the module.
#[derive(Debug)]
pub(crate) enum EemTemperature {}

impl<S: Real, M: FreeEnergy<S> + Send + Sync + 'static> ElementScheme<S, M> for EemTemperature {
    const PLACEMENT: Placement = Placement::Ends;
    const IMPLICIT: f64 = 1.0;

    type Old = M::TemperatureFormOld;

    fn old(model: &M, x0: &M::Variables) -> Self::Old {
        model.temperature_form_old(x0)
    }

    fn respond(
        model: &M,
        start: &Start<S, M, Self::Old>,
        trial: &ElementTrial<'_, S, M>,
        _: &mut M::Corners,
        answer: &mut Answer<S, M>,
    ) -> Result<(), Infeasible> {
        let form = model.temperature_form(&start.old, trial.x);
        answer.response = form.0;
        answer.tangent = form.1;
        if M::THERMAL {
            // ∂Δs/∂θ¹ = C/θ¹
            let last = M::Variables::LEN - 1;
            let theta = trial.x[last];
            let slope = answer.tangent[last + 1][last];
            Infeasible::unless_stable(theta * slope, theta)?;
        }
        Ok(())
    }

    // That the new state is stable is left to the one who finds its temperature.
    fn respond_alone(
        model: &M,
        start: &Start<S, M, Self::Old>,
        trial: &ElementTrial<'_, S, M>,
        _: &mut M::Corners,
        answer: &mut Answer<S, M>,
    ) -> Result<(), Infeasible> {
        answer.response = model.temperature_form_response(&start.old, trial.x);
        Ok(())
    }
}
