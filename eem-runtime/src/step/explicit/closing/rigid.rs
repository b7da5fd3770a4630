//! Fallback of the closing: a component that moves nearly like a rigid body is rotated rigidly.

use super::super::accounts::Accounts;
use super::super::demand::{Demand, Scales};
use super::super::{Explicit, View};
use super::momenta::Rigid;
use crate::algebra::bivector::Bivector;
use crate::algebra::{add, difference, hypot};
use crate::element::group::Place;
use crate::element::state::State;
use crate::step::error::StepFailure;
use eem_material::number::compensated::Total;
use eem_material::number::scalar::Scalar;

/// The magnitude of a difference over its scale; zero without a difference.
fn part(difference: f64, scale: f64) -> f64 {
    let is_none = difference == 0.0;
    if is_none {
        difference
    } else {
        difference.abs() / scale
    }
}

impl Accounts {
    /// Takes back what the step has done to the internal variables of a component, and to its entropies.
    fn restore_start(&mut self, index: usize, old: &State, next: &mut State) {
        for dashpot in self.components.dashpots_of(index) {
            self.stage.inner[dashpot] = self.stage.inner_start(dashpot);
        }
        for at in self.slots_of(index) {
            let slot = self.components.slots[at];
            let at = self.stage.temperatures + slot;
            self.stage.inner[at] = self.stage.inner_start(at);
            next.entropies.advance(slot, &old.entropies, 0.0);
        }
        for share in self.components.all[index].shares.clone() {
            let reservoir = self.components.shares[share].reservoir;
            // One by one: their difference would be rounded to ε of what is taken back.
            let (new, old) = (self.books.shares[share], self.old_books.shares[share]);
            for change in [-new.value, old.value, -new.carry, old.carry] {
                next.reservoir_entropies.add(reservoir, change);
            }
            self.books.shares[share] = old;
        }
        if self.is_driven {
            let old = self.old_books.targets[index].lost;
            let lost = &mut self.books.targets[index].lost;
            next.dissipated.add(-lost.change(old));
            *lost = old;
        }
        let progress = &mut self.scratch.progress[index];
        progress.is_rigid = true;
        progress.present = None;
        progress.production = Total::default();
        progress.factor = 0.0;
    }

    /// Whether loads act, or a thermostat in a component.
    fn is_pushed(&self, index: usize) -> bool {
        let slots = &self.components.slots[self.slots_of(index)];
        !self.load_sums.is_empty() || slots.iter().any(|&slot| self.stage.is_held(slot))
    }

    /// The largest relative difference of an internal variable of a component from its start.
    fn difference_from_start(&self, index: usize, position: f64) -> f64 {
        let mut largest = 0.0;
        let mut see = |at: usize, scale: f64| {
            let difference = self.stage.inner[at] - self.stage.inner_start(at);
            largest = Scalar::maximum(largest, part(difference, scale));
        };
        for dashpot in self.components.dashpots_of(index) {
            see(dashpot, position);
        }
        for at in self.slots_of(index) {
            let at = self.stage.temperatures + self.components.slots[at];
            see(at, self.stage.inner_start(at));
        }
        largest
    }
}

impl<const D: usize> Explicit<D> {
    /// Replaces the step of a component by a rigid motion of its old state, with the old internal variables: a relative
    /// equilibrium, at the largest entropy that its energy and momenta allow.
    pub(super) fn turn_rigidly(
        &mut self,
        index: usize,
        (view, demand, scales): (&View<'_>, Demand, Scales),
        next: &mut State,
    ) -> Result<(), StepFailure> {
        let largest = demand.largest_turn();
        if self.is_pushed(index) || !self.takes_turn(index, view.step, largest, scales) {
            return Err(StepFailure::NotClosed {
                defect: self.scratch.progress[index].defect,
                time: view.state.time.value + view.step,
            });
        }
        self.accounts.restore_start(index, view.state, next);
        self.restore_momenta(index);
        self.scratch.open[index] = true;
        Ok(())
    }

    /// Whether the old state, rotated in one plane, agrees with the stages to this relative difference; positions and
    /// momenta are then set to it.
    fn takes_turn(&mut self, index: usize, h: f64, largest: f64, scales: Scales) -> bool {
        if D > 3 {
            // The component may turn in several planes at once.
            return false;
        }
        self.swap_start(index);
        self.look_at_motion(index);
        let rigid = self.rigid(index);
        self.swap_start(index);
        let difference = self.difference_from_turn(index, &rigid, h, scales);
        if !(difference <= largest) {
            return false;
        }
        for place in &mut self.places[self.accounts.components.all[index].masses.clone()] {
            place.now = turned(place, &rigid, h);
        }
        true
    }

    /// Swaps positions and momenta with those at the start of the step.
    pub(super) fn swap_start(&mut self, index: usize) {
        for place in &mut self.places[self.accounts.components.all[index].masses.clone()] {
            core::mem::swap(&mut place.now, &mut place.past.start);
        }
    }

    /// The largest relative difference between the present stage vector and the rotated old state.
    fn difference_from_turn(&self, index: usize, rigid: &Rigid<D>, h: f64, scales: Scales) -> f64 {
        let mut largest = 0.0;
        let mut see = |difference: f64, scale: f64| {
            largest = Scalar::maximum(largest, part(difference, scale));
        };
        for place in &self.places[self.components.all[index].masses.clone()] {
            let [position, momentum] = turned(place, rigid, h);
            see(hypot(&difference(&position, place.q())), scales.position);
            see(hypot(&difference(&momentum, place.p())), scales.momentum);
        }
        Scalar::maximum(largest, self.difference_from_start(index, scales.position))
    }
}

/// Position and momentum of a mass, from those at the start of the step by the rigid motion of its component.
fn turned<const D: usize>(place: &Place<D>, rigid: &Rigid<D>, h: f64) -> [[f64; D]; 2] {
    let [position, momentum] = &place.past.start;
    let speed = rigid.omega.square().sqrt();
    let per = if speed > 0.0 { speed } else { 1.0 };
    let about = rigid.omega.over(per);
    let mut along = [0.0; D];
    add(&mut along, place.mass, &rigid.velocity);
    let mut way = rotated(&rigid.origin.arm(position), &about, speed * h);
    add(&mut way, h, &rigid.velocity);
    let mut turned = rotated(&difference(momentum, &along), &about, speed * h);
    add(&mut turned, 1.0, &along);
    [rigid.origin.moved(&way), turned]
}

/// A vector turned in a plane, that of a bivector of length one (Rodrigues).
fn rotated<const D: usize>(r: &[f64; D], about: &Bivector<f64, D>, angle: f64) -> [f64; D] {
    let (sine, half) = (Scalar::sin(angle), Scalar::sin(0.5 * angle));
    // 1 − cos, without cancellation.
    let versine = (half + half) * half;
    let turned = about.turn(r);
    let again = about.turn(&turned);
    let mut result = *r;
    add(&mut result, sine, &turned);
    add(&mut result, versine, &again);
    result
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quarter_turn() {
        let mut about = Bivector::<f64, 3>::zero();
        *about.at_mut([0, 1]) = 1.0;
        let turned = rotated(&[1.0, 0.0, 2.0], &about, core::f64::consts::FRAC_PI_2);
        let expected = [0.0, 1.0, 2.0];
        assert!(hypot(&difference(&turned, &expected)) < 1e-15, "{turned:?}");
        let mut about = Bivector::<f64, 2>::zero();
        *about.at_mut([0, 1]) = -1.0;
        let flat = rotated(&[1.0, 2.0], &about, core::f64::consts::PI);
        assert!(hypot(&difference(&flat, &[-1.0, -2.0])) < 1e-15, "{flat:?}");
    }
}
