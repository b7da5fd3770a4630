//! The new state of each element: its temperature, energy and checks.

use super::point::{Point, variables};
use super::respond::check_temperature;
use crate::element::conjugates::{Family, Infeasible, Placement, recovered_at};
use crate::element::error::StateError;
use crate::element::group::view::StepView;
use crate::element::kinematics::{MeasureSet, Numbers};
use crate::element::state::{Energy, State};
use eem_material::arrays::Arrays;
use eem_material::free_energy::Caloric;

impl<A: Arrays, Q: MeasureSet> Point<A, Q> {
    /// Finds the new temperature from the new entropy at new measures, starting at `near`, where the caloric quantities may be known. If the
    /// scheme integrates the temperature, or it is prescribed, finds the entropy from the temperature instead.
    ///
    /// Returns the new entropy if a thermostat prescribes the temperature.
    #[expect(
        clippy::inline_always,
        reason = "a call costs 1 % of a step of two springs"
    )]
    #[inline(always)]
    pub(super) fn recover_temperature<C: Family>(
        &mut self,
        measures: &Numbers<Q>,
        view: &StepView<'_>,
        (near, known): (f64, Option<&(Caloric<f64>, f64)>),
        state: &mut State,
    ) -> Result<Option<f64>, StateError> {
        let mut x = variables(&self.model, measures.as_ref(), self.slots(), state);
        self.check_viscous(&x)?;
        let at = self.element.index();
        let Some(slot) = self.slots().thermal else {
            let psi = self.model.free_energy(&x);
            self.unless_infinite(psi)?;
            state.energies[at] = Energy::without_temperature(psi);
            return Ok(None);
        };
        let prescribed = view.prescribed(slot, Placement::End);
        if let (false, None) = (C::is_in_temperature(self.scheme), prescribed) {
            // The guess from the trial is good: usually one evaluation is enough.
            let entropy = state.entropies.values()[slot];
            let energy_at = |theta: f64| self.model.caloric_at(&x, theta);
            let at_guess = known.map_or_else(|| energy_at(near), |known| *known);
            let found = recovered_at((near, at_guess), energy_at, entropy);
            let found = found.map_err(|infeasible| infeasible.of(self.element))?;
            check_temperature(self.element, found.temperature)?;
            state.temperatures[slot] = found.temperature;
            self.unless_infinite(found.free_energy)?;
            state.energies[at] = found.energy;
            return Ok(None);
        }
        let old = view.state.temperatures[slot];
        let theta = prescribed.unwrap_or_else(|| self.new_temperature(old));
        state.temperatures[slot] = theta;
        x[Self::TEMPERATURE] = theta;
        check_temperature(self.element, theta)?;
        let caloric = self.model.caloric(&x);
        self.check_stable(&caloric, theta)?;
        state.entropies.set(slot, caloric.entropy);
        state.energies[at] = self.energy_at(&x, caloric)?;
        Ok(prescribed.map(|_| caloric.entropy))
    }

    /// The internal energy at given variables, whose entropy and heat capacity are known.
    pub(super) fn energy_at(
        &self,
        x: &A::Variables,
        caloric: Caloric<f64>,
    ) -> Result<Energy, StateError> {
        let psi = self.model.free_energy(x);
        self.unless_infinite(psi)?;
        if !self.is_thermal() {
            return Ok(Energy::without_temperature(psi));
        }
        let theta = x[Self::TEMPERATURE];
        Ok(Energy::new(psi, [theta, caloric.entropy], &caloric))
    }

    /// Books the heat of the thermostat, given the new entropy and the entropy received otherwise.
    pub(super) fn book_thermostat(
        &self,
        view: &StepView<'_>,
        [entropy, received]: [f64; 2],
        state: &mut State,
    ) {
        let Some(slot) = self.slots().thermal else {
            return;
        };
        let change = entropy - view.state.entropies.values()[slot];
        let given = change - received;
        state.book_thermostat(self.temperature() * given, given);
    }

    fn check_stable(&self, caloric: &Caloric<f64>, theta: f64) -> Result<(), StateError> {
        Infeasible::unless_stable(caloric.heat_capacity, theta)
            .map_err(|infeasible| infeasible.of(self.element))
    }

    #[inline]
    fn check_viscous(&self, x: &A::Variables) -> Result<(), StateError> {
        for dashpot in 0..self.dashpots() {
            let stretch = x[A::MEASURES + dashpot];
            if !stretch.is_finite() {
                return Err(StateError::ViscousStretch {
                    element: self.element,
                    dashpot,
                    value: stretch,
                    unit: Q::VISCOUS_UNIT,
                });
            }
        }
        Ok(())
    }
}
