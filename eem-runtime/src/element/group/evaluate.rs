//! Evaluation of a trial state: responses, condensed local systems, contributions.

use super::assemble::Target;
use crate::algebra::system::LinearSystem;
use crate::element::conjugates::ElementScheme;
use crate::element::error::StateError;
use crate::element::group::element_group::ElementGroup;
use crate::element::group::view::{StepView, Trial};
use crate::element::kinematics::Kinematics;
use crate::material::free_energy::FreeEnergy;
use crate::number::scalar::Real;

impl<S, M, K, C, const D: usize> ElementGroup<S, M, K, C, D>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S, D>,
    C: ElementScheme<S, M>,
{
    /// See [`Group::evaluate`](super::Group::evaluate).
    pub(super) fn evaluate_all(
        &mut self,
        view: &StepView<'_, S>,
        trial: &Trial<S, D>,
        system: Option<&mut LinearSystem<S, 1>>,
    ) -> Result<(), StateError> {
        match system {
            Some(system) => self.linearize_all(view, trial, system),
            None => self.members.iter_mut().try_for_each(|member| {
                let arms = member.trial_arms(view, trial);
                member.points.as_mut().iter_mut().try_for_each(|point| {
                    let found = point.found_by(trial.settled);
                    point.respond_alone(view, trial, &arms)?;
                    point.return_to(found, trial.settled);
                    Ok(())
                })
            }),
        }
    }

    /// Responses with their tangents, and what they contribute to the system of the next iteration.
    fn linearize_all(
        &mut self,
        view: &StepView<'_, S>,
        trial: &Trial<S, D>,
        system: &mut LinearSystem<S, 1>,
    ) -> Result<(), StateError> {
        let (values, right) = system.parts();
        for member in &mut self.members {
            let arms = member.trial_arms(view, trial);
            let mut share = None;
            for point in member.points.as_mut() {
                let found = point.found_by(trial.settled);
                let seen = point.locate_trial(arms.ends(), trial)?;
                let pose = point.pose(&arms.old, &seen);
                point.sensitivity = pose.sensitivity;
                let by_rate = point.extend(&pose, &arms.motion);
                // It stays where the model writes it: copies of it would be a good part of the work.
                let mut form = point.form(trial);
                if M::THERMAL && C::IN_TEMPERATURE {
                    point.change_entropy_at_rates(view.step, &pose, &arms.motion, &mut form);
                }
                point.accept(view.per_step, &form)?;
                let elastic = point.add_drag(view.per_step, &mut form);
                let contact = point.contact_in(&self.contacts);
                point.condense(view, &trial.seen, &form, contact)?;
                if let Some(by_rate) = &by_rate {
                    point.warm_by_rates(view, by_rate);
                }
                let mut target = Target {
                    values: &mut *values,
                    right: &mut *right,
                    site: &member.site,
                    contact,
                };
                if view.phase.moves() {
                    let form = (&form, by_rate.as_ref());
                    point.add_momentum(view.step, &pose, form, &mut target, &mut share);
                }
                point.assemble_temperature(trial, &form, &mut target);
                point.keep(&form);
                point.drop_drag(&elastic);
                point.return_to(found, trial.settled);
            }
            if let Some(share) = share {
                member
                    .site
                    .add_momentum(&share, right.as_flattened_mut(), values);
            }
        }
        Ok(())
    }
}
