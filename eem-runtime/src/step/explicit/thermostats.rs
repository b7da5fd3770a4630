//! Thermostats: the heat that they give follows from the entropy that they give, `δQ = θ dS`, never from what the energy
//! lacks. An energy defect of their elements is closed like any other.

use super::Explicit;
use super::accounts::Accounts;
use super::guard::{PerWeight, shifted};
use super::tableau::STAGES;
use crate::element::group::Thermostat;
use crate::element::state::State;

impl Accounts {
    /// The entropy that held elements have received from dashpots and paths, and the part of the heat of thermostats that
    /// follows from the course of their temperature.
    pub(super) fn book_course(&mut self, h: f64, old: &State, next: &State) {
        for held in &self.prescribed.held {
            let slot = held.slot;
            let thermostat = &self.stage.thermostats[slot];
            let change = thermostat.last - old.temperatures[slot];
            let warming = thermostat.warming + change * old.entropies.values()[slot];
            let balance = &mut self.scratch.held[slot];
            balance.received = next.entropies.change(slot, &old.entropies);
            balance.by_course = warming - h * thermostat.sum;
        }
    }

    /// Books the heat of thermostats in open components, given the entropies of their elements.
    pub(super) fn book_thermostats(&mut self, old: &State, next: &State) {
        for at in 0..self.prescribed.held.len() {
            let slot = self.prescribed.held[at].slot;
            if self.scratch.open[self.components.of_slot(slot)] {
                let balance = &mut self.scratch.held[slot];
                let change = next.entropies.change(slot, &old.entropies);
                balance.given = change - balance.received;
                self.book_heat(slot);
            }
        }
    }

    /// Lets the dashpots of a held element produce more entropy, which its thermostat takes.
    pub(super) fn warm_held(&mut self, slot: usize, entropy: f64) {
        let balance = &mut self.scratch.held[slot];
        balance.received += entropy;
        balance.given -= entropy;
        self.book_heat(slot);
    }

    /// Replaces the heat of a thermostat in the target of its component by that of the entropy that it gives.
    fn book_heat(&mut self, slot: usize) {
        let component = self.components.of_slot(slot);
        let balance = &mut self.scratch.held[slot];
        let heat = self.stage.thermostats[slot].last * balance.given + balance.by_course;
        // The same heat again leaves the bits of the target.
        #[expect(clippy::float_cmp, reason = "the same heat, not nearly the same")]
        if heat != balance.heat {
            let target = &mut self.books.targets[component].energy;
            for change in [-balance.heat, heat] {
                target.add(change);
            }
            balance.heat = heat;
        }
    }
}

impl<const D: usize> Explicit<D> {
    /// Begins the integrals of thermostats at the start of a step.
    pub(super) fn begin_thermostats(&mut self) {
        if !self.stage.has_thermostats {
            return;
        }
        for held in &self.accounts.prescribed.held {
            self.accounts.stage.thermostats[held.slot].begin(held.temperatures[STAGES - 1]);
        }
        self.integrate_thermostats(true);
    }

    /// Adds the present stage to the integrals of thermostats.
    #[cold]
    pub(super) fn integrate_thermostats(&mut self, is_start: bool) {
        for group in &self.groups {
            group.integrate_thermostats(&self.places, &mut self.accounts.stage, is_start);
        }
    }
}

/// Weighs the heat that a held element receives along a path like the flow of its entropy, after the guard has shifted
/// weights; the temperatures are its own and those of the other end.
#[cold]
pub(super) fn shift_weights(
    thermostat: &mut Thermostat,
    shift: f64,
    conductance: f64,
    [own, other]: [&PerWeight; 2],
) {
    let mut heat = [0.0; _];
    for (heat, (&own, &other)) in heat.iter_mut().zip(own.iter().zip(other)) {
        *heat = thermostat.excess(own) * conductance * (other - own);
    }
    thermostat.sum += shifted(shift, &heat);
}
