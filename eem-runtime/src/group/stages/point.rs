//! One element at one stage: forces, rates of its internal variables, and their derivatives.

use super::member::{StageMember, StateMember};
use super::{StageGroup, heat};
use crate::conduction::HeatFlow;
use crate::error::StateError;
use crate::free_energy::{Array, FreeEnergy};
use crate::group::respond::{check_measures, check_temperature};
use crate::group::{StepView, Trial};
use crate::kinematics::{Arms, Kinematics};
use crate::scalar::Real;
use crate::scheme::Infeasible;

/// What a model says at a stage.
#[derive(Clone, Copy, Debug)]
pub(super) struct Point<S: Real, M: FreeEnergy<S>> {
    /// `∂ψ/∂x = (f, −g, −s)`.
    pub(super) gradient: M::Variables,
    /// `∂²ψ/∂x²`.
    pub(super) hessian: M::Hessian,
    /// At the place of each dashpot `γ̇ = g/η`, m/s, at that of the temperature `Φ`, W/K.
    pub(super) rates: M::Variables,
    /// Their derivatives by x, a row each; heat from other elements held.
    pub(super) rates_by: M::Hessian,
    /// `Σ g γ̇`, W.
    pub(super) dissipation: S,
}

impl<S: Real, M: FreeEnergy<S>> Point<S, M> {
    pub(super) fn zero() -> Self {
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
    pub(super) fn entropy(&self) -> S {
        -self.gradient[M::Variables::LEN - 1]
    }

    /// `∂s/∂x`.
    pub(super) fn entropy_by(&self) -> M::Variables {
        let mut row = self.hessian[M::Variables::LEN - 1];
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
            let (eta, slope) = (viscosities.0[k], viscosities.1[k]);
            let g = -self.gradient[index];
            let rate = g / eta;
            self.rates[index] = rate;
            self.dissipation += g * rate;
            for column in 0..M::Variables::LEN {
                let g_by = -self.hessian[index][column];
                let is_temperature = M::THERMAL && column == M::Variables::LEN - 1;
                let eta_by = if is_temperature { slope } else { S::zero() };
                let rate_by = (g_by - rate * eta_by) / eta;
                self.rates_by[index][column] = rate_by;
                dissipation_by[column] += g_by * rate + g * rate_by;
            }
        }
        dissipation_by
    }

    /// The rate `Φ` of the entropy at the temperature θ, with the heat received and the derivative
    /// of the dissipation.
    fn warm(&mut self, theta: S, flow: &HeatFlow<S>, dissipation_by: &M::Variables) {
        let last = M::Variables::LEN - 1;
        let rate = (self.dissipation + flow.heat) / theta;
        self.rates[last] = rate;
        for (column, &power_by) in dissipation_by.as_ref().iter().enumerate() {
            let by = if column == last {
                power_by - flow.conductance - rate
            } else {
                power_by
            };
            self.rates_by[last][column] = by / theta;
        }
    }
}

impl<S, M, K, const D: usize> StageGroup<S, M, K, D>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S, D>,
{
    /// Evaluates the model at all stages of the trial.
    pub(super) fn evaluate_all(
        &mut self,
        view: &StepView<'_, S>,
        trial: &Trial<S, D>,
    ) -> Result<(), StateError> {
        let (kinematics, rule) = (self.elements.kinematics, self.rule);
        let members = self.elements.members.iter_mut().zip(&mut self.members);
        for (member, stages) in members {
            for stage in 0..rule.stages() {
                // The measures of a known stage are those of the old state.
                if let Some(set) = rule.set_of(stage) {
                    let r = stages.arms_of_set(set, trial);
                    stages.move_to(kinematics, member, stage, &r)?;
                }
                let heat = match member.slots().thermal {
                    Some(slot) => heat::received(rule, stage, slot, view, trial),
                    None => S::zero(),
                };
                stages.evaluate(member, view, stage, heat)?;
            }
        }
        Ok(())
    }
}

impl<S, M, K, const D: usize> StageMember<S, M, K, D>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S, D>,
{
    /// Measures and their gradients at a stage, whose arms are given.
    fn move_to(
        &mut self,
        kinematics: K,
        member: &StateMember<S, M, K, D>,
        stage: usize,
        r: &Arms<K, S, D>,
    ) -> Result<(), StateError> {
        let measures = kinematics.measure(r);
        check_measures::<K, S, D>(kinematics, member.element, &measures, r)?;
        self.gradients[stage] = kinematics.gradient(r, &measures);
        for (a, &measure) in measures.as_ref().iter().enumerate() {
            self.x[stage][a] = measure;
        }
        Ok(())
    }

    /// The model at a stage whose variables are known, with the heat from other elements, W.
    fn evaluate(
        &mut self,
        member: &mut StateMember<S, M, K, D>,
        view: &StepView<'_, S>,
        stage: usize,
        heat: S,
    ) -> Result<(), StateError> {
        let (x, point) = (&self.x[stage], &mut self.points[stage]);
        let theta = x[M::Variables::LEN - 1];
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
        let Some(slot) = member.slots().thermal else {
            return Ok(());
        };
        let slope = point.entropy_by()[M::Variables::LEN - 1];
        Infeasible::unless_stable(theta * slope, theta)
            .map_err(|infeasible| infeasible.of(member.element))?;
        let mut flow = view.conduction.reservoir_flow(slot, theta);
        flow.heat += heat;
        point.warm(theta, &flow, &dissipation_by);
        Ok(())
    }
}
