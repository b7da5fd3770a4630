//! The end of a step: forces and increments of the internal variables from the found stages.
//!
//! Newton's method leaves an error in the trial stages. Taking `f`, `g`, `θ` of the stages as given
//! and evaluating the remaining relations explicitly from them makes the balances of momentum and
//! entropy hold to rounding whatever that error is.

use super::source::Source;
use crate::algebra::system::LinearSystem;
use crate::element::error::StateError;
use crate::element::group::arms::arms_in;
use crate::element::group::stages::stage_group::StageGroup;
use crate::element::group::view::{StepView, Trial};
use crate::element::impulse::Impulses;
use crate::element::kinematics::Kinematics;
use crate::element::state::State;
use crate::element::tally::Tally;
use eem_material::free_energy::Material;
use eem_material::number::scalar::Real;

impl<S: Real, M: Material<S>, K: Kinematics<S, D>, C: Source<S, M, K, D>, const D: usize>
    StageGroup<S, M, K, C, D>
{
    /// See [`Group::add_secant`](crate::element::group::Group::add_secant).
    pub(super) fn add_secant_all(
        &mut self,
        set: usize,
        view: &StepView<'_, S>,
        trial: &Trial<S, D>,
        system: &mut LinearSystem<S, D>,
    ) {
        let rule = self.rule;
        let stage = rule.stage_of(set);
        let impulse = view.step * S::from_f64(rule.positions[set][stage]);
        let (values, right) = system.parts();
        for stages in &self.members {
            let (site, secant) = (stages.site.common(), &stages.site.secant);
            let mut known = arms_in::<K, S, D>(&site.nodes, &view.state.positions);
            site.add_anchors(&mut known, trial.displacements_of_set(set), S::one());
            for point in &stages.points {
                let weights = C::secant(point, stage);
                secant.add_matrix(&site.is_mass, &weights, impulse, values);
                site.subtract_known(&weights, (&known, impulse), right);
            }
        }
    }

    /// Subtracts the nodal impulses of a step of the forces of a stage, and adds the magnitude of what they are
    /// computed from to that of each node, if it is asked for, with those of the first stage.
    pub(super) fn add_impulse_of(
        &self,
        stage: usize,
        view: &StepView<'_, S>,
        trial: &Trial<S, D>,
        impulses: &mut Impulses<'_, S, D>,
        magnitudes: &mut [S],
    ) {
        for stages in &self.members {
            let arms = stages.arms(self.rule, trial);
            let nodes = &stages.site.common().nodes;
            for point in &stages.points {
                let force = C::pull(point, self.rule, stage, &arms);
                for (&node, force) in nodes.as_ref().iter().zip(force.as_ref()) {
                    for (sum, &force) in impulses.of(node as usize).iter_mut().zip(force) {
                        *sum -= view.step * force;
                    }
                }
                if stage == 0 && !magnitudes.is_empty() {
                    let magnitude = C::magnitude(point, self.rule, view.step);
                    for &node in nodes.as_ref() {
                        magnitudes[node as usize] += magnitude;
                    }
                }
            }
        }
    }

    /// Increments of the internal variables and of the reservoirs, and the temperatures of the new state.
    pub(super) fn close_all(
        &mut self,
        view: &StepView<'_, S>,
        trial: &Trial<S, D>,
        next: &mut State<S>,
        tally: &mut Tally<S>,
    ) -> Result<(), StateError> {
        let rule = self.rule;
        for (member, stages) in self.elements.members.iter_mut().zip(&mut self.members) {
            let r1 = member.arms_in(next);
            let points = stages.points.iter_mut();
            for (point, in_state) in points.zip(member.points.as_mut()) {
                C::close(point, in_state, rule, (view, trial, &r1), next, tally)?;
            }
        }
        Ok(())
    }
}
