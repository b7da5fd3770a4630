//! The model at the stages of a trial.

use super::ValuesMember;
use crate::element::conjugates::Infeasible;
use crate::element::error::StateError;
use crate::element::group::respond::{check_measures, check_temperature};
use crate::element::group::stages::heat;
use crate::element::group::stages::member::StatePoint;
use crate::element::group::view::{StepView, Trial};
use crate::element::handle::Element;
use crate::element::kinematics::{Arms, Kinematics};
use crate::element::tableau::Tableau;
use crate::material::free_energy::{Array, FreeEnergy};
use crate::number::scalar::Real;

impl<S, M, K, const D: usize> ValuesMember<S, M, K, D>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S, D>,
{
    /// Evaluates the model at all stages of the trial.
    pub(super) fn evaluate_stages(
        &mut self,
        own: &mut StatePoint<S, M, K, D>,
        rule: &Tableau,
        view: &StepView<'_, S>,
        trial: &Trial<S, D>,
    ) -> Result<(), StateError> {
        for stage in 0..rule.stages() {
            // The measures of a known stage are those of the old state.
            if let Some(set) = rule.set_of(stage) {
                let r = self.arms_of_set(set, trial);
                self.move_to(own.element, stage, &r)?;
            }
            let heat = match own.slots().thermal {
                Some(slot) => heat::received(rule, stage, slot, view, trial),
                None => S::zero(),
            };
            self.evaluate_stage(own, view, stage, heat)?;
        }
        Ok(())
    }

    /// Measures and their gradients at a stage, whose arms are given.
    fn move_to(
        &mut self,
        element: Element,
        stage: usize,
        r: &Arms<K, S, D>,
    ) -> Result<(), StateError> {
        let measures = self.kinematics.measure(r);
        check_measures::<K, S, D>(&self.kinematics, element, &measures, r)?;
        self.own.gradients[stage] = self.kinematics.gradient(r, &measures);
        for (a, &measure) in measures.as_ref().iter().enumerate() {
            self.own.x[stage][a] = measure;
        }
        Ok(())
    }

    /// The model at a stage whose variables are known, with the heat from other elements, W.
    fn evaluate_stage(
        &mut self,
        own: &mut StatePoint<S, M, K, D>,
        view: &StepView<'_, S>,
        stage: usize,
        heat: S,
    ) -> Result<(), StateError> {
        let (x, point) = (&self.own.x[stage], &mut self.own.points[stage]);
        let theta = x[M::Variables::LEN - 1];
        if M::THERMAL {
            check_temperature(own.element, theta)?;
        }
        (point.gradient, point.hessian) = own.model.hessian(x);
        let mut values = point.gradient.as_ref().iter();
        if let Some(value) = values.find(|value| !value.is_finite()) {
            return Err(StateError::NotFinite {
                element: own.element,
                quantity: "force or entropy",
                value: value.to_f64(),
            });
        }
        own.find_viscosities(theta)?;
        let dissipation_by = point.creep(&own.viscosities);
        let Some(slot) = own.slots().thermal else {
            return Ok(());
        };
        let slope = point.entropy_by()[M::Variables::LEN - 1];
        Infeasible::unless_stable(theta * slope, theta)
            .map_err(|infeasible| infeasible.of(own.element))?;
        let mut flow = view.conduction.reservoir_flow(slot, theta);
        flow.heat += heat;
        point.warm(theta, &flow, &dissipation_by);
        Ok(())
    }
}
