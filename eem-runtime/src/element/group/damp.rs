//! The [damping](super::damping) of a point: found when a step begins, and what it changes.

use super::local::Dissipation;
use super::modes::relaxation_modes;
use super::point::{DampingOf, Point, temperature_in};
use crate::element::conduction::Partner;
use crate::element::conjugates::{Family, Form, Placement, end_weight, end_weight_over};
use crate::element::error::StateError;
use crate::element::group::respond::check_temperature;
use crate::element::group::view::StepView;
use crate::element::kinematics::MeasureSet;
use eem_material::arrays::Arrays;
use eem_material::free_energy::Array;

impl<A: Arrays, Q: MeasureSet> Point<A, Q> {
    /// Finds the damping of a step from its old state.
    #[inline]
    pub(super) fn begin_damping<C: Family>(&mut self, view: &StepView<'_>) {
        if !C::is_damped(self.scheme) {
            return;
        }
        let mut damping = DampingOf::<A>::none();
        if let Some(slot) = self.conducting_slot(view) {
            let theta = self.start.x0[Self::TEMPERATURE];
            let x = view.step * relaxation_rate(view, slot);
            damping.weight = 2.0 * end_weight(x) * theta;
            damping.per_capacity = per_capacity(view, slot);
        }
        if self.dashpots() > 0 {
            let x0 = &self.start.x0;
            // Models without temperature ignore it.
            let (viscosities, _) = self.model.viscosity(x0[A::Variables::LEN - 1]);
            let (_, hessian) = self.model.hessian(x0);
            let (mut modes, rates) = relaxation_modes::<A>(&hessian, &viscosities, self.dashpots());
            for k in 0..self.dashpots() {
                let factor = (view.step * end_weight_over(view.step * rates[k])).sqrt();
                for entry in modes[k].as_mut() {
                    *entry *= -factor;
                }
            }
            damping.modes = modes;
        }
        if let Some(own) = self.damping_mut() {
            *own = damping;
        }
    }

    /// Δλ or Δγ.
    #[inline]
    pub(super) fn increment_of(&self, row: usize) -> f64 {
        if row < A::MEASURES {
            self.x[row] - self.start.x0[row]
        } else {
            self.creep[row - A::MEASURES]
        }
    }

    /// Finds the damping of the dashpots at a trial; an error unless it is finite.
    #[inline]
    pub(super) fn find_damping<C: Family>(&mut self) -> Result<(), StateError> {
        if self.dashpots() == 0 || !C::is_damped(self.scheme) {
            return Ok(());
        }
        let mut increments = A::Variables::filled(0.0);
        for row in 0..Self::TEMPERATURE {
            increments[row] = self.increment_of(row);
        }
        let (dashpots, mut heat) = (self.dashpots(), 0.0);
        if let Some(damping) = self.damping_mut() {
            damping.force = A::Variables::filled(0.0);
            for k in 0..dashpots {
                let mode = &damping.modes[k];
                let terms = (0..Self::TEMPERATURE).map(|row| mode[row] * increments[row]);
                let part = terms.fold(0.0, |sum, term| sum + term);
                damping.parts[k] = part;
                heat += part * part;
                for row in 0..Self::TEMPERATURE {
                    damping.force[row] += Self::sign(row) * (part * mode[row]);
                }
            }
        }
        if heat.is_finite() {
            return Ok(());
        }
        Err(StateError::NotFinite {
            element: self.element,
            quantity: "damping of the dashpots",
            value: heat,
        })
    }

    /// The sign of a row of the response: f is a derivative of the energy, g of the negative energy.
    #[inline]
    pub(super) fn sign(row: usize) -> f64 {
        if row < A::MEASURES { 1.0 } else { -1.0 }
    }

    /// Adds the damping of the dashpots and its derivatives to a form; returns the response without it.
    #[inline]
    pub(super) fn add_damping<C: Family>(
        &self,
        (response, tangent): &mut Form<A>,
    ) -> Option<A::Response> {
        if self.dashpots() == 0 {
            return None;
        }
        self.damping::<C>().map(|damping| {
            let undamped = *response;
            for row in 0..Self::TEMPERATURE {
                response[row] += damping.force[row];
                for k in 0..self.dashpots() {
                    let mode = &damping.modes[k];
                    let slope = Self::sign(row) * mode[row];
                    for column in 0..Self::TEMPERATURE {
                        tangent[row][column] += slope * mode[column];
                    }
                }
            }
            undamped
        })
    }

    /// Restores the response of a form to that without damping.
    #[inline]
    pub(super) fn drop_damping(&mut self, undamped: Option<&A::Response>) {
        if let Some(undamped) = undamped {
            self.response = *undamped;
        }
    }

    /// Adds the power of the damping and its derivatives to what the dashpots turn into heat.
    #[inline]
    pub(super) fn dissipate_by_damping<C: Family>(
        &self,
        view: &StepView<'_>,
        dissipation: &mut Dissipation<A>,
    ) {
        if let Some(damping) = self.damping::<C>() {
            for k in 0..self.dashpots() {
                dissipation.power += self.damping_heat::<C>(k) * view.per_step;
            }
            for row in 0..Self::TEMPERATURE {
                let by = Self::sign(row) * damping.force[row];
                dissipation.by[row] += (by + by) * view.per_step;
            }
        }
    }

    /// The heat of the damping of a mode in the step, J.
    #[inline]
    pub(super) fn damping_heat<C: Family>(&self, mode: usize) -> f64 {
        let damping = self.damping::<C>();
        damping.map_or(0.0, |damping| damping.parts[mode] * damping.parts[mode])
    }

    /// Its thermal slot, if it conducts heat at a free temperature.
    fn conducting_slot(&self, view: &StepView<'_>) -> Option<usize> {
        let conducts = |slot: &usize| !view.conduction.links(*slot).is_empty();
        let slot = self.slots().thermal.filter(conducts);
        slot.filter(|_| !self.is_prescribed)
    }

    /// Θ at a response, K; zero without temperature.
    #[inline]
    pub(super) fn conducting_temperature<C: Family>(&self, response: &A::Response) -> f64 {
        let theta = temperature_in::<A>(response);
        if !self.is_thermal() {
            return theta;
        }
        let change = response[Self::ENTROPY];
        let damping = self.damping::<C>();
        damping.map_or(theta, |damping| theta + damping.shift(change)[0] * change)
    }

    /// `∂(Θ − θ*)/∂Δs`, K²/J.
    #[inline]
    pub(super) fn shift_by_entropy<C: Family>(&self, response: &A::Response) -> f64 {
        let damping = self.damping::<C>();
        damping.map_or(0.0, |damping| damping.shift(response[Self::ENTROPY])[1])
    }

    /// A form with Θ instead of θ*.
    #[inline]
    pub(super) fn conducting<C: Family>(&self, (response, tangent): &Form<A>) -> Form<A> {
        let (mut response, mut tangent) = (*response, *tangent);
        let by_entropy = self.shift_by_entropy::<C>(&response);
        response[Self::TEMPERATURE] = self.conducting_temperature::<C>(&response);
        let entropy_by = tangent[Self::ENTROPY];
        for column in 0..Self::VARIABLES {
            tangent[Self::TEMPERATURE][column] += by_entropy * entropy_by[column];
        }
        (response, tangent)
    }

    /// An error unless Θ is positive.
    #[inline]
    pub(super) fn check_conducting<C: Family>(
        &self,
        response: &A::Response,
    ) -> Result<(), StateError> {
        if !self.is_thermal() || !C::is_damped(self.scheme) {
            return Ok(());
        }
        check_temperature(self.element, self.conducting_temperature::<C>(response))
    }

    /// The entropy that the damping of heat produces in the step, `(Θ − θ*) Δs/Θ`, J/K; `None` without such damping.
    #[inline]
    pub(super) fn damping_production<C: Family>(
        &self,
        view: &StepView<'_>,
        per_theta: f64,
    ) -> Option<f64> {
        let damping = self.damping::<C>()?;
        self.conducting_slot(view)?;
        let change = self.response[Self::ENTROPY];
        Some(damping.shift(change)[0] * (change * change) * per_theta)
    }
}

/// The rate at which conduction equalizes the temperature of a slot with paths at most, `Σ κ (1/c + 1/c_partner)`, 1/s.
pub(super) fn relaxation_rate(view: &StepView<'_>, slot: usize) -> f64 {
    let own = per_capacity(view, slot);
    let links = view.conduction.links(slot).iter();
    links.fold(0.0, |sum, link| {
        let partner = match link.partner {
            Partner::Slot(partner) => per_capacity(view, partner),
            Partner::Reservoir(_) => 0.0,
        };
        sum + link.conductance * (own + partner)
    })
}

/// `1/c⁰` of a slot with paths, K/J; zero where a thermostat prescribes its temperature.
fn per_capacity(view: &StepView<'_>, slot: usize) -> f64 {
    if view.prescribed(slot, Placement::End).is_some() {
        return 0.0;
    }
    let element = view.conduction.owner(slot);
    view.state.energies[element].heat_capacity.recip()
}
