//! One element at one stage: forces, rates of its internal variables, and their derivatives.

use super::{StageTrial, StageView, ThreeStageGroup};
use crate::error::StateError;
use crate::free_energy::{Array, Caloric, FreeEnergy};
use crate::group::evaluate::{check_measures, check_temperature};
use crate::kinematics::Kinematics;
use crate::scalar::Real;
use crate::scheme::Infeasible;

/// What a model says at a stage.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Point<S: Real, M: FreeEnergy<S>> {
    /// `∂ψ/∂x = (f, −g, −s)`.
    pub(crate) gradient: M::Variables,
    /// `∂²ψ/∂x²`.
    pub(crate) hessian: M::Hessian,
    /// At the place of each dashpot `γ̇ = g/η`, m/s, at that of the temperature `Φ`, W/K.
    pub(crate) rates: M::Variables,
    /// Their derivatives by x, a row each; heat from other elements held.
    pub(crate) rates_by: M::Hessian,
    /// `Σ g γ̇`, W.
    pub(crate) dissipation: S,
}

impl<S: Real, M: FreeEnergy<S>> Point<S, M> {
    pub(crate) fn zero() -> Self {
        let zeros = M::Variables::filled(S::zero());
        Self {
            gradient: zeros,
            hessian: M::Hessian::filled(zeros),
            rates: zeros,
            rates_by: M::Hessian::filled(zeros),
            dissipation: S::zero(),
        }
    }

    /// s, J/K; only with a temperature.
    pub(crate) fn entropy(&self) -> S {
        -self.gradient.as_ref()[M::Variables::LEN - 1]
    }

    /// `∂s/∂x`.
    pub(crate) fn entropy_by(&self) -> M::Variables {
        let mut row = self.hessian.as_ref()[M::Variables::LEN - 1];
        for entry in row.as_mut() {
            *entry = -*entry;
        }
        row
    }

    /// The rates of the dashpots with the viscosities `η` and `dη/dθ`; returns `∂(Σ g γ̇)/∂x`.
    fn creep(&mut self, viscosities: &(M::Viscosities, M::Viscosities)) -> M::Variables {
        let mut dissipation_by = M::Variables::filled(S::zero());
        self.dissipation = S::zero();
        for k in 0..M::DASHPOTS {
            let index = M::MEASURES + k;
            let (eta, slope) = (viscosities.0.as_ref()[k], viscosities.1.as_ref()[k]);
            let g = -self.gradient.as_ref()[index];
            let rate = g / eta;
            self.rates.as_mut()[index] = rate;
            self.dissipation += g * rate;
            for column in 0..M::Variables::LEN {
                let g_by = -self.hessian.as_ref()[index].as_ref()[column];
                let is_temperature = M::THERMAL && column == M::Variables::LEN - 1;
                let eta_by = if is_temperature { slope } else { S::zero() };
                let rate_by = (g_by - rate * eta_by) / eta;
                self.rates_by.as_mut()[index].as_mut()[column] = rate_by;
                dissipation_by.as_mut()[column] += g_by * rate + g * rate_by;
            }
        }
        dissipation_by
    }

    /// The rate `Φ` of the entropy at the temperature θ, with the heat Q received, of which
    /// `∂Q/∂θ = −κ`, and the derivative of the dissipation.
    fn warm(&mut self, theta: S, heat: S, conductance: S, dissipation_by: &M::Variables) {
        let last = M::Variables::LEN - 1;
        let rate = (self.dissipation + heat) / theta;
        self.rates.as_mut()[last] = rate;
        for (column, &power_by) in dissipation_by.as_ref().iter().enumerate() {
            let by = if column == last {
                power_by - conductance - rate
            } else {
                power_by
            };
            self.rates_by.as_mut()[last].as_mut()[column] = by / theta;
        }
    }
}

impl<S, M, K> ThreeStageGroup<S, M, K>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S>,
{
    /// See [`StageGroup::evaluate`](super::StageGroup::evaluate).
    pub(super) fn evaluate_trial(
        &mut self,
        view: &StageView<'_, S>,
        trial: &StageTrial<S>,
    ) -> Result<(), StateError> {
        let kinematics = self.elements.kinematics;
        for i in 0..self.members.len() {
            for stage in 0..self.geometry.len() {
                let geometry = &mut self.geometry[stage];
                if stage > 0 {
                    geometry.aim(kinematics, i, &trial.positions[stage]);
                }
                let measures = &geometry.measures[geometry.measures_range(i)];
                check_measures(kinematics, self.elements.members[i].element, measures)?;
                let x = &mut self.members[i].x[stage];
                x.as_mut()[..M::MEASURES].copy_from_slice(measures);
                self.evaluate_stage(view, trial, i, stage)?;
            }
            self.condense(view.step, i)?;
        }
        Ok(())
    }

    /// The model of element `i` at a stage whose variables are known.
    fn evaluate_stage(
        &mut self,
        view: &StageView<'_, S>,
        trial: &StageTrial<S>,
        i: usize,
        stage: usize,
    ) -> Result<(), StateError> {
        let (member, stages) = (&mut self.elements.members[i], &mut self.members[i]);
        let (x, point) = (&stages.x[stage], &mut stages.points[stage]);
        let theta = x.as_ref()[M::Variables::LEN - 1];
        if M::THERMAL {
            check_temperature(member.element, theta)?;
        }
        (point.gradient, point.hessian) = member.model.hessian(x);
        let mut values = point.gradient.as_ref().iter();
        if let Some(value) = values.find(|value| !value.is_finite()) {
            return Err(StateError::NotFinite {
                element: member.element,
                quantity: "force or entropy",
                value: value.to_f64(),
            });
        }
        member.find_viscosities(theta)?;
        let dissipation_by = point.creep(&member.viscosities);
        let Some(slot) = member.slots.thermal else {
            return Ok(());
        };
        let slope = point.entropy_by().as_ref()[M::Variables::LEN - 1];
        let caloric = Caloric {
            entropy: point.entropy(),
            heat_capacity: theta * slope,
            magnitude: S::zero(),
        };
        Infeasible::unless_stable(&caloric, theta)
            .map_err(|infeasible| infeasible.of(member.element))?;
        let seen = &trial.seen_temperatures[stage];
        let heat = view.conduction.heat_flow(slot, theta, seen);
        let conductance = view.conduction.reservoir_conductance(slot);
        point.warm(theta, heat, conductance, &dissipation_by);
        Ok(())
    }
}
