//! The new state of each element: its temperature, and all that must be true of a state.

use super::arms::{arms, points};
use super::member::Member;
use super::respond::{check_measures, check_temperature};
use super::{ElementGroup, StepView, Trial, variables};
use crate::error::StateError;
use crate::free_energy::{Array, Caloric, FreeEnergy};
use crate::kinematics::Kinematics;
use crate::scalar::Real;
use crate::scheme::{ElementScheme, Infeasible, Placement, temperature_and_energy_at};
use crate::state::State;

impl<S, M, K, C, const D: usize> ElementGroup<S, M, K, C, D>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S, D>,
    C: ElementScheme<S, M>,
{
    /// See [`Group::close`](super::Group::close).
    pub(super) fn close_all(
        &mut self,
        view: &StepView<'_, S>,
        trial: &Trial<S, D>,
        next: &mut State<S>,
    ) -> Result<(), StateError> {
        for member in &mut self.members {
            let contact = member.contact_in(&self.contacts);
            let received = member.close(view, contact, &trial.seen_temperatures, next);
            let near = member.x[M::Variables::LEN - 1];
            if let Some(entropy) = member.settle(self.kinematics, view, near, next)? {
                member.book_thermostat(view, [entropy, received], next);
            }
        }
        Ok(())
    }
}

impl<S, M, K, C, const D: usize> Member<S, M, K, C, D>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S, D>,
    C: ElementScheme<S, M>,
{
    /// The variables in a state, if the element can have its deformation.
    #[inline]
    pub(super) fn locate(
        &self,
        kinematics: K,
        state: &State<S>,
    ) -> Result<M::Variables, StateError> {
        let r = arms::<K, S, D>(&self.site.nodes, points(state.positions.values()));
        let measures = kinematics.measure(&r);
        check_measures::<K, S, D>(kinematics, self.element, &measures, &r)?;
        Ok(variables::<S, M>(measures.as_ref(), self.slots(), state))
    }

    /// The new temperature, which is near a given one, from the new entropy, or the other way round
    /// where the scheme integrates the temperature or it is prescribed.
    ///
    /// Returns the new entropy where a thermostat decides it.
    #[inline]
    pub(super) fn settle(
        &mut self,
        kinematics: K,
        view: &StepView<'_, S>,
        near: S,
        state: &mut State<S>,
    ) -> Result<Option<S>, StateError> {
        let mut x = self.locate(kinematics, state)?;
        self.check_viscous(&x)?;
        let Some(slot) = self.slots().thermal else {
            self.check_energy(&x)?;
            return Ok(None);
        };
        let prescribed = view.prescribed(slot, Placement::End);
        if let (false, None) = (C::IN_TEMPERATURE, prescribed) {
            // The trial is nearly right: one evaluation is enough, as a rule.
            let entropy = state.entropies.values()[slot];
            let (theta, psi) = temperature_and_energy_at(&self.model, x, entropy, near)
                .map_err(|infeasible| infeasible.of(self.element))?;
            check_temperature(self.element, theta)?;
            state.temperatures[slot] = theta;
            self.unless_infinite(psi)?;
            return Ok(None);
        }
        let old = view.state.temperatures[slot];
        let theta = prescribed.unwrap_or_else(|| self.new_temperature(old));
        state.temperatures[slot] = theta;
        x[Self::TEMPERATURE] = theta;
        check_temperature(self.element, theta)?;
        self.check_energy(&x)?;
        let caloric = self.model.caloric(&x);
        self.check_stable(&caloric, theta)?;
        state.entropies.set(slot, caloric.entropy);
        Ok(prescribed.map(|_| caloric.entropy))
    }

    /// The heat of the thermostat that brought the entropy to a new one, of an element that has
    /// received so much entropy otherwise.
    fn book_thermostat(
        &self,
        view: &StepView<'_, S>,
        [entropy, received]: [S; 2],
        state: &mut State<S>,
    ) {
        let Some(slot) = self.slots().thermal else {
            return;
        };
        let change = entropy - view.state.entropies.values()[slot];
        let given = change - received;
        state.heat.add(self.temperature() * given);
        state.thermostat_entropy.add(-given);
    }

    fn check_stable(&self, caloric: &Caloric<S>, theta: S) -> Result<(), StateError> {
        Infeasible::unless_stable(caloric.heat_capacity, theta)
            .map_err(|infeasible| infeasible.of(self.element))
    }

    #[inline]
    fn check_viscous(&self, x: &M::Variables) -> Result<(), StateError> {
        for dashpot in 0..M::DASHPOTS {
            let stretch = x[M::MEASURES + dashpot];
            if !stretch.is_finite() {
                return Err(StateError::ViscousStretch {
                    element: self.element,
                    dashpot,
                    value: stretch.to_f64(),
                });
            }
        }
        Ok(())
    }
}
