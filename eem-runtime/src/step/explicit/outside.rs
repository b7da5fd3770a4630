//! Loads, moved anchors and thermostats at the stages of a step, and their integrals.

use super::Explicit;
use super::components::Support;
use super::memory::LoadSums;
use super::origin::Origin;
use super::tableau::{MOTION_SLOPES, WEIGHTS};
use crate::algebra::bivector::Bivector;
use crate::algebra::{add, difference, dot, size};
use crate::element::loads::StepLoads;

impl<const D: usize> Explicit<D> {
    /// Sets moved anchors and thermostats to their values at a stage.
    pub(super) fn move_to(&mut self, stage: usize) {
        for held in &self.accounts.held {
            *self.accounts.stage.theta_mut(held.slot) = held.temperatures[stage];
        }
        for moved in &self.prescribed.moved {
            for &place in &moved.places {
                let place = &mut self.places[place];
                place.now[0] = moved.positions[stage];
                place.rates = [moved.velocities[stage], [0.0; D]];
            }
        }
    }

    /// Begins the integrals of a step at its start, and keeps the rates of anchors.
    pub(super) fn begin_outside(&mut self) {
        copy_loads(&mut self.start_loads, &self.loads);
        self.load_sums.fill(LoadSums::none());
        self.stage.weight = WEIGHTS[0];
        self.begin_thermostats();
        for place in &mut self.places[self.accounts.components.masses..self.kept_places] {
            place.past.start[0] = place.now[0];
            place.past.rates[0] = place.rates;
        }
        self.integrate_outside(0);
    }

    /// Adds power, force and torque of loads and moved anchors at the present stage, one of those that have weights.
    ///
    /// The force f⁰ on an anchor at the start of the step does the work `f⁰·(x¹ − x⁰)`, see [`book`](Self::book): only the power
    /// of its change is integrated, so that what rounds the velocities is no part of a large force. Constant forces on masses have a
    /// potential instead of a power, and an impulse that is known.
    pub(super) fn integrate_outside(&mut self, at: usize) {
        let weight = self.stage.weight;
        for index in 0..self.load_sums.len() {
            let components = &self.accounts.components;
            let component = &components.all[index];
            let sums = &mut self.load_sums[index];
            let origin = Origin::of(&self.places, component);
            let mut momentum = [0.0; D];
            for at in component.masses.clone() {
                let place = &self.places[at];
                let arm = origin.arm(place.q());
                let node = components.nodes[at];
                let load = self.loads.total_force(node);
                let varying = difference(&load, &place.force);
                sums.work += weight * dot(&varying, place.velocity());
                add(&mut sums.impulse, weight, &varying);
                // Weights have no torque about the centre of mass.
                let is_free = component.support == Support::Free;
                let turning = if is_free {
                    self.loads.force(node)
                } else {
                    load
                };
                sums.torque.add(weight, &Bivector::wedge(&arm, &turning));
                if D > 2 {
                    sums.moment += weight.abs() * size(&arm) * size(&turning);
                }
                add(&mut momentum, 1.0, place.p());
            }
            if let Support::Anchor(anchor) = component.support {
                // The angular momentum is about the anchor, wherever it goes.
                let velocity = self.places[anchor].velocity();
                let change = Bivector::wedge(velocity, &momentum);
                sums.torque.add(-weight, &change);
                if D > 2 {
                    sums.moment += weight.abs() * size(velocity) * size(&momentum);
                }
            }
        }
        for anchor in self.components.masses..self.kept_places {
            let sums = &mut self.load_sums[self.accounts.components.of_place[anchor]];
            let place = &self.places[anchor];
            let [velocity, reaction] = &place.rates;
            let change = difference(reaction, &place.past.rates[0][1]);
            sums.work -= weight * dot(&change, velocity);
            sums.effort += (weight * dot(reaction, velocity)).abs();
            sums.noise += weight.abs() * MOTION_SLOPES[at] * size(&change) * size(place.q());
        }
    }
}

/// Copies the forces of other loads.
pub(super) fn copy_loads(own: &mut StepLoads, other: &StepLoads) {
    own.total_force.copy_from_slice(&other.total_force);
    own.force.copy_from_slice(&other.force);
}
