//! Loads, moved anchors and thermostats at the stages of a step, and what they do to it.

use super::Explicit;
use super::components::Support;
use super::memory::{LoadSums, Outside};
use super::tableau::WEIGHTS;
use super::vector::{add, dot};
use crate::algebra::bivector::Bivector;
use crate::element::group::points;
use eem_material::number::scalar::Real;

impl<S: Real, const D: usize> Explicit<S, D> {
    /// Moves anchors and sets thermostats to where they are at a stage.
    pub(super) fn move_to(&mut self, stage: usize) {
        for (slot, theta) in self.prescribed.temperatures(stage) {
            *self.stage.theta_mut(slot) = theta;
        }
        for (place, node) in self.components.anchors() {
            for (moved, position, velocity) in self.prescribed.motions(stage) {
                if moved == node {
                    self.stage.places[place].now[0] = *position;
                    self.stage.places[place].rates = [*velocity, [S::zero(); D]];
                }
            }
        }
    }

    /// Gives anchors the velocities with which they start.
    pub(super) fn set_anchors_going(&mut self) {
        for (place, node) in self.components.anchors() {
            for (moved, _, velocity) in self.prescribed.motions(0) {
                if moved == node {
                    self.stage.places[place].rates[0] = *velocity;
                }
            }
        }
    }

    /// Begins the integrals of a step at its start, and keeps the rates of anchors.
    pub(super) fn begin_outside(&mut self) {
        self.start_outside.copy_from(&self.outside);
        self.load_sums.fill(LoadSums::none());
        self.stage.weight = S::from_f64(WEIGHTS[0]);
        for supply in &mut self.stage.supply {
            supply.begin(self.stage.weight);
        }
        for place in &mut self.stage.places[self.components.masses..self.kept_places] {
            place.past.rates[0] = place.rates;
        }
        self.integrate_outside();
    }

    /// Adds power, force and torque of loads and moved anchors at the present stage.
    pub(super) fn integrate_outside(&mut self) {
        let weight = self.stage.weight;
        for index in 0..self.load_sums.len() {
            let component = &self.components.all[index];
            let sums = &mut self.load_sums[index];
            let origin = Self::origin(&self.stage.places, component);
            let mut momentum = [S::zero(); D];
            for at in component.masses.clone() {
                let place = &self.stage.places[at];
                let arm = origin.arm(place.q());
                let node = self.components.nodes[at] as usize;
                let load = self.outside.on(node, component.support);
                sums.add(weight, [&arm, place.velocity()], load);
                add(&mut momentum, S::one(), place.p());
            }
            if let Support::Anchor(anchor) = component.support {
                // The angular momentum is about the anchor, wherever it goes.
                let velocity = self.stage.places[anchor].velocity();
                let change = Bivector::wedge(velocity, &momentum);
                sums.torque.add(-weight, &change);
            }
        }
        for at in self.components.masses..self.kept_places {
            let component = self.components.of_place[at] as usize;
            let [velocity, reaction] = &self.stage.places[at].rates;
            self.load_sums[component].work -= weight * dot(reaction, velocity);
        }
    }
}

impl<S: Real> Outside<S> {
    /// On a node the force that does work, what changes the linear and what the angular momentum, N. Weights
    /// have no torque about the centre of mass.
    fn on<const D: usize>(&self, node: usize, support: Support) -> [[S; D]; 3] {
        let zero = [S::zero(); D];
        let of = |loads: &[S]| points::<S, D>(loads).get(node).copied().unwrap_or(zero);
        let (force, load) = (of(&self.forces), of(&self.loads));
        let turning = if support == Support::Free {
            force
        } else {
            load
        };
        [force, load, turning]
    }
}

impl<S: Real, const D: usize> LoadSums<S, D> {
    #[inline]
    fn add(
        &mut self,
        weight: S,
        [arm, velocity]: [&[S; D]; 2],
        [force, load, turning]: [[S; D]; 3],
    ) {
        self.work += weight * dot(&force, velocity);
        add(&mut self.impulse, weight, &load);
        self.torque.add(weight, &Bivector::wedge(arm, &turning));
    }
}
