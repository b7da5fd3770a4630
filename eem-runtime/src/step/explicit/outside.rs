//! Loads, moved anchors and thermostats at the stages of a step, and their integrals.

use super::Explicit;
use super::components::Support;
use super::memory::{LoadSums, Momenta};
use super::origin::Origin;
use super::tableau::{MOTION_SLOPES, WEIGHTS};
use crate::algebra::bivector::Bivector;
use crate::algebra::{add, difference, dot, size};
use crate::element::group::points;
use crate::element::loads::StepLoads;

impl<const D: usize> Explicit<D> {
    /// Sets moved anchors and thermostats to their values at a stage.
    pub(super) fn move_to(&mut self, stage: usize) {
        for held in &self.accounts.prescribed.held {
            *self.accounts.stage.theta_mut(held.slot) = held.temperatures[stage];
        }
        for moved in &self.accounts.prescribed.moved {
            let position = points::<D>(&moved.positions)[stage];
            let velocity = points::<D>(&moved.velocities)[stage];
            for &place in &moved.places {
                let place = &mut self.places[place];
                place.now[0] = position;
                place.rates = [velocity, [0.0; D]];
            }
        }
    }

    /// Begins the integrals of a step at its start, and keeps the rates of anchors.
    pub(super) fn begin_outside(&mut self) {
        let accounts = &mut self.accounts;
        copy_loads(&mut accounts.start_loads, &accounts.loads);
        accounts.load_sums.fill(LoadSums::default());
        accounts.stage.weight = WEIGHTS[0];
        for place in &mut self.places[accounts.components.masses..accounts.kept_places] {
            place.past.start[0] = place.now[0];
            place.past.rates[0] = place.rates;
        }
        for impulses in &mut self.impulses {
            *impulses = Momenta::none();
        }
        self.begin_thermostats();
        self.integrate_outside(0);
    }

    /// Adds power, force and torque of loads and moved anchors at the present stage, one of those that have weights.
    ///
    /// The force f⁰ on an anchor at the start of the step does the work `f⁰·(x¹ − x⁰)`, see [`book`](Self::book): only the power
    /// of its change is integrated, so that what rounds the velocities is no part of a large force. Constant forces on masses have a
    /// potential instead of a power, and an impulse that is known.
    pub(super) fn integrate_outside(&mut self, at: usize) {
        let accounts = &mut self.accounts;
        let (components, loads) = (&accounts.components, &accounts.loads);
        let weight = accounts.stage.weight;
        for index in 0..self.impulses.len() {
            let component = &components.all[index];
            let (sums, impulses) = (&mut accounts.load_sums[index], &mut self.impulses[index]);
            let origin = Origin::of(&self.places, component);
            let mut turn = |arm: &[f64; D], force: &[f64; D], weight: f64| {
                impulses.angular.add(weight, &Bivector::wedge(arm, force));
                if D > 2 {
                    sums.moment += weight.abs() * size(arm) * size(force);
                }
            };
            let mut momentum = [0.0; D];
            for at in component.masses.clone() {
                let place = &self.places[at];
                let node = components.nodes[at];
                let load = loads.total_force(node);
                let varying = difference(&load, &place.force);
                sums.work += weight * dot(&varying, place.velocity());
                add(&mut impulses.linear, weight, &varying);
                // Weights have no torque about the centre of mass.
                let is_free = component.support == Support::Free;
                let turning = if is_free { loads.force(node) } else { load };
                turn(&origin.arm(place.q()), &turning, weight);
                add(&mut momentum, 1.0, place.p());
            }
            if let Support::Anchor(anchor) = component.support {
                // The angular momentum is about the anchor, wherever it goes.
                turn(self.places[anchor].velocity(), &momentum, -weight);
            }
        }
        for anchor in components.masses..accounts.kept_places {
            let sums = &mut accounts.load_sums[components.of_place[anchor]];
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
