//! The model at the stages of a trial.

use super::ValuesPoint;
use crate::element::conjugates::Infeasible;
use crate::element::error::StateError;
use crate::element::group::respond::{check_measures, check_temperature};
use crate::element::group::stages::heat;
use crate::element::group::stages::member::{StageArms, StatePoint};
use crate::element::group::view::{StepView, Trial};
use crate::element::handle::Element;
use crate::element::kinematics::{Arms, Kinematics};
use crate::element::tableau::Tableau;
use eem_material::free_energy::{Array, Material};
use eem_material::number::scalar::Real;

impl<S: Real, M: Material<S>, K: Kinematics<S, D>, const D: usize> ValuesPoint<S, M, K, D> {
    /// Evaluates the model at all stages of the trial.
    pub(super) fn evaluate_stages(
        &mut self,
        in_state: &mut StatePoint<S, M, K, D>,
        rule: &Tableau,
        (view, trial): (&StepView<'_, S>, &Trial<S, D>),
        arms: &StageArms<K, S, D>,
    ) -> Result<(), StateError> {
        for stage in 0..rule.stages() {
            // The measures of a known stage are those of the old state.
            if let Some(set) = rule.set_of(stage) {
                let r = arms.of_set(set);
                self.move_to(in_state.element, stage, &r)?;
            }
            let heat = match in_state.slots().thermal {
                Some(slot) => heat::received(rule, stage, slot, view, trial),
                None => S::zero(),
            };
            self.evaluate_stage(in_state, view, stage, heat)?;
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
        in_state: &mut StatePoint<S, M, K, D>,
        view: &StepView<'_, S>,
        stage: usize,
        heat: S,
    ) -> Result<(), StateError> {
        let (x, point) = (&self.own.x[stage], &mut self.own.points[stage]);
        let theta = x[M::Variables::LEN - 1];
        if M::THERMAL {
            check_temperature(in_state.element, theta)?;
        }
        (point.gradient, point.hessian) = in_state.model.hessian(x);
        let mut values = point.gradient.as_ref().iter();
        if let Some(value) = values.find(|value| !value.is_finite()) {
            return Err(StateError::NotFinite {
                element: in_state.element,
                quantity: "force or entropy",
                value: value.to_f64(),
            });
        }
        in_state.find_viscosities(theta)?;
        let dissipation_by = point.creep(&in_state.viscosities);
        let Some(slot) = in_state.slots().thermal else {
            return Ok(());
        };
        let slope = point.entropy_by()[M::Variables::LEN - 1];
        Infeasible::unless_stable(theta * slope, theta)
            .map_err(|infeasible| infeasible.of(in_state.element))?;
        let mut flow = view.conduction.reservoir_flow(slot, theta);
        flow.heat += heat;
        point.warm(theta, &flow, &dissipation_by);
        Ok(())
    }
}
