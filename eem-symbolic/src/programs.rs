//! From one free energy to all programs of a constitutive law.

mod point;

use crate::discrete::{self, Step};
use crate::model::Model;
use crate::node::Symbol;
use crate::program::Program;
use crate::verify_error::VerifyError;
use point::PointPrograms;

/// Everything that a constitutive law computes, scheduled.
///
/// N = M + K + T is the number of variables: M measures, K dashpots, T = 1 if there is a temperature
/// and 0 otherwise. R = M + K + 2 T is the number of algorithmic quantities. Inputs are the parameters
/// followed by x; in the two algorithmic forms and `mixed_states` the parameters, x⁰, x¹ and, except in
/// temperature form, the corner temperatures.
#[derive(Clone, Debug, PartialEq)]
pub struct Programs {
    /// `[ψ]`.
    pub free_energy: Program,
    /// `[magnitude of ψ]`: 8 ε times this bounds the rounding error of `free_energy`; see
    /// [`magnitude`](crate::magnitude()).
    pub energy_magnitude: Program,
    /// `[∂ψ/∂x_i]`.
    pub gradient: Program,
    /// `[∂ψ/∂x_i …, ∂²ψ/∂x_i∂x_j …]`, the Hessian by rows.
    pub hessian: Program,
    /// `[e]`; e is ψ without a temperature.
    pub internal_energy: Program,
    /// `[s, θ ∂s/∂θ, Σ |terms of s|]`; `None` without a temperature.
    pub caloric: Option<Program>,
    /// The same outputs and ψ; everything that does not depend on θ is at
    /// [`Stage::Old`](crate::Stage::Old).
    pub caloric_at: Option<Program>,
    /// `[f_a …, g_k …, c, ∂s/∂λ_a …, ∂s/∂γ_k …]` with `c = θ ∂s/∂θ`; f and g alone without a temperature.
    pub rates: Program,
    /// The same outputs, s and ψ; everything that does not depend on θ is at
    /// [`Stage::Old`](crate::Stage::Old). Without a temperature f, g and ψ.
    pub rates_at: Program,
    /// `[∂²s/∂x_i∂x_j …]` by rows; `None` without a temperature.
    pub entropy_hessian: Option<Program>,
    /// `[η_k …, dη_k/dθ …]`; inputs are the parameters and θ, if there is one. `None` without dashpots.
    pub viscosity: Option<Program>,
    /// `[η, dη/dθ]` of the dashpot in parallel with the spring, with the same inputs; `None` without one.
    pub drag: Option<Program>,
    /// `[f*_a …, g*_k …, θ*, Δs]` followed by the R×N tangent by rows, in entropy form.
    pub entropy_form: Program,
    /// The same outputs in temperature form; `None` without a temperature.
    pub temperature_form: Option<Program>,
    /// `[S(c) − s_c …, θ ∂s/∂θ …]` of the corners c of the entropy form, at trial temperatures; `None` without a
    /// temperature.
    pub mixed_states: Option<Program>,
    /// Whether `θ ∂s/∂θ` does not depend on θ.
    pub has_constant_capacity: bool,
}

impl Programs {
    /// Checks all programs; see [`Program::verify`].
    ///
    /// # Errors
    ///
    /// [`VerifyError::NonFiniteConstant`] if a derivative has a factor that does not fit an `f64`.
    pub fn verify(&self) -> Result<(), VerifyError> {
        let always = [
            &self.free_energy,
            &self.energy_magnitude,
            &self.gradient,
            &self.hessian,
            &self.internal_energy,
            &self.rates,
            &self.rates_at,
            &self.entropy_form,
        ];
        let sometimes = [
            &self.caloric,
            &self.caloric_at,
            &self.entropy_hessian,
            &self.viscosity,
            &self.drag,
            &self.mixed_states,
            &self.temperature_form,
        ];
        let sometimes = sometimes.into_iter().flatten();
        always
            .into_iter()
            .chain(sometimes)
            .try_for_each(Program::verify)
    }
}

impl Model {
    /// All programs of the law.
    #[must_use]
    pub fn programs(&self) -> Programs {
        let mut point = PointPrograms::new(self);
        Programs {
            free_energy: point.free_energy(),
            energy_magnitude: point.energy_magnitude(),
            gradient: point.gradient(),
            hessian: point.hessian(),
            internal_energy: point.internal_energy(),
            rates: point.rates(),
            rates_at: point.rates_at(),
            caloric: self.temperature.map(|theta| point.caloric(theta)),
            caloric_at: self.temperature.map(|theta| point.caloric_at(theta)),
            entropy_hessian: self.temperature.map(|theta| point.entropy_hessian(theta)),
            viscosity: (!self.viscosities.is_empty()).then(|| point.viscosity(&self.viscosities)),
            drag: self.drag.map(|law| point.viscosity(&[law])),
            entropy_form: self.entropy_form(),
            has_constant_capacity: self
                .temperature
                .is_some_and(|theta| point.is_capacity_constant(theta)),
            mixed_states: self.temperature.map(|theta| self.mixed_states(theta)),
            temperature_form: self.temperature.map(|_| self.temperature_form()),
        }
    }

    fn entropy_form(&self) -> Program {
        let mut step = Step::new(self, true);
        let form = match self.temperature {
            Some(_) => discrete::entropy_form(&mut step),
            None => discrete::elastic_form(&mut step),
        };
        step.program(&form)
    }

    fn mixed_states(&self, theta: Symbol) -> Program {
        let mut step = Step::new(self, true);
        let form = discrete::mixed_states(&mut step, theta);
        step.program(&form)
    }

    fn temperature_form(&self) -> Program {
        let mut step = Step::new(self, false);
        let form = discrete::temperature_form(&mut step);
        step.program(&form)
    }
}
