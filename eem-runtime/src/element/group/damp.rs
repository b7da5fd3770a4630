//! The [damping](super::damping) of a point: found when a step begins, and what it changes.

use super::damping::Damping;
use super::point::{Point, temperature_in};
use crate::element::conduction::Partner;
use crate::element::conjugates::{ElementScheme, Form, Placement, end_weight};
use crate::element::error::StateError;
use crate::element::group::respond::check_temperature;
use crate::element::group::view::StepView;
use crate::element::kinematics::Kinematics;
use eem_material::free_energy::{Array, FreeEnergy};

impl<M: FreeEnergy<f64>, K: Kinematics<D>, C: ElementScheme<M>, const D: usize> Point<M, K, C, D> {
    /// Finds the damping of a step from its old state.
    #[inline]
    pub(super) fn begin_damping(&mut self, view: &StepView<'_>) {
        if C::Damping::<()>::LEN == 0 {
            return;
        }
        let mut damping = Damping::none();
        if let Some(slot) = self.conducting_slot(view) {
            let theta = self.start.x0[Self::TEMPERATURE];
            let x = view.step * relaxation_rate(view, slot);
            damping.weight = 2.0 * end_weight(x) * theta;
            damping.per_capacity = per_capacity(view, slot);
        }
        for own in self.damping.as_mut() {
            *own = damping;
        }
    }

    /// Its thermal slot, if it conducts heat at a free temperature.
    fn conducting_slot(&self, view: &StepView<'_>) -> Option<usize> {
        let conducts = |slot: &usize| !view.conduction.links(*slot).is_empty();
        let slot = self.slots().thermal.filter(conducts);
        slot.filter(|_| !self.is_prescribed)
    }

    /// Θ at a response, K; zero without temperature.
    #[inline]
    pub(super) fn conducting_temperature(&self, response: &M::Response) -> f64 {
        let theta = temperature_in::<M>(response);
        if !M::THERMAL {
            return theta;
        }
        let change = response[Self::ENTROPY];
        let damping = self.damping.as_ref().iter();
        damping.fold(theta, |theta, damping| {
            theta + damping.shift(change)[0] * change
        })
    }

    /// `∂(Θ − θ*)/∂Δs`, K²/J.
    #[inline]
    pub(super) fn shift_by_entropy(&self, response: &M::Response) -> f64 {
        let damping = self.damping.as_ref().iter();
        damping.fold(0.0, |sum, damping| {
            sum + damping.shift(response[Self::ENTROPY])[1]
        })
    }

    /// A form with Θ instead of θ*.
    #[inline]
    pub(super) fn conducting(&self, (response, tangent): &Form<f64, M>) -> Form<f64, M> {
        let (mut response, mut tangent) = (*response, *tangent);
        let by_entropy = self.shift_by_entropy(&response);
        response[Self::TEMPERATURE] = self.conducting_temperature(&response);
        let entropy_by = tangent[Self::ENTROPY];
        for column in 0..Self::VARIABLES {
            tangent[Self::TEMPERATURE][column] += by_entropy * entropy_by[column];
        }
        (response, tangent)
    }

    /// An error unless Θ is positive.
    #[inline]
    pub(super) fn check_conducting(&self, response: &M::Response) -> Result<(), StateError> {
        if !M::THERMAL || C::Damping::<()>::LEN == 0 {
            return Ok(());
        }
        check_temperature(self.element, self.conducting_temperature(response))
    }

    /// The entropy that the damping of heat produces in the step, `(Θ − θ*) Δs/Θ`, J/K; `None` without such damping.
    #[inline]
    pub(super) fn damping_production(&self, view: &StepView<'_>, per_theta: f64) -> Option<f64> {
        let damping = self.damping.as_ref().first()?;
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
