//! Evaluation of a trial state: responses, condensed local systems, contributions.

use super::assemble::Target;
use crate::error::StateError;
use crate::free_energy::FreeEnergy;
use crate::group::element_group::ElementGroup;
use crate::group::view::{StepView, Trial};
use crate::kinematics::Kinematics;
use crate::scalar::Real;
use crate::scheme::ElementScheme;
use crate::system::LinearSystem;

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
                let found = member.found_by(trial.settled);
                member.respond_alone(self.kinematics, view, trial)?;
                member.return_to(found, trial.settled);
                Ok(())
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
        let kinematics = self.kinematics;
        let (values, right) = system.parts();
        for member in &mut self.members {
            let found = member.found_by(trial.settled);
            let seen = member.locate_trial(kinematics, trial)?;
            let pose = member.pose(kinematics, &seen);
            member.sensitivity = pose.sensitivity;
            // It stays where the model writes it: copies of it would be a good part of the work.
            let mut form = member.form(trial);
            if M::THERMAL && C::IN_TEMPERATURE {
                member.change_entropy_at_rates(kinematics, view, trial, &seen, &mut form);
            }
            member.accept(&form)?;
            let contact = member.contact_in(&self.contacts);
            member.condense(view, &trial.seen, &form, contact)?;
            let mut target = Target {
                values: &mut *values,
                right: &mut *right,
                contact,
            };
            if view.phase.moves() {
                member.assemble_momentum(kinematics, view, &pose, &form, &mut target);
            }
            member.assemble_temperature(trial, &form, &mut target);
            member.keep(&form);
            member.return_to(found, trial.settled);
        }
        Ok(())
    }
}
