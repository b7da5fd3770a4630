//! A component that nothing can close turns like a rigid body, if it nearly does so anyway.

use super::super::demand::{Demand, Scales};
use super::super::vector::{add, difference, length};
use super::super::{Explicit, ExplicitView};
use super::momenta::Rigid;
use crate::algebra::bivector::Bivector;
use crate::element::group::points;
use crate::element::state::State;
use crate::step::error::StepFailure;
use eem_material::number::compensated::Total;
use eem_material::number::scalar::{Discord, Mask, Real};

impl<S: Real, const D: usize> Explicit<S, D> {
    /// Replaces the step of a component by a rigid motion of its old state, with all internal variables as
    /// they were: a relative equilibrium, at the largest entropy that its energy and momenta allow.
    pub(super) fn turn_rigidly(
        &mut self,
        index: usize,
        (view, demand, scales): (&ExplicitView<'_, S, D>, Demand<S>, Scales<S>),
        next: &mut State<S>,
    ) -> Result<(), StepFailure> {
        if S::LANES > 1 {
            // Each has to be close to a turn of its own.
            return Err(Discord.into());
        }
        let largest = demand.largest_turn();
        let is_loaded = !self.quadrature.loads.is_empty() || self.gravity.is_some();
        let has_thermostat = self
            .slots_of(index)
            .any(|at| self.held.get(self.components.slots[at] as usize) == Some(&true));
        if is_loaded || has_thermostat || !self.takes_turn(index, view.step, largest, scales) {
            return Err(StepFailure::NotClosed {
                defect: self.scratch.progress[index].defect.to_f64(),
                time: (view.state.time.value + view.step).to_f64(),
            });
        }
        let offsets = self.offsets;
        for (dashpot, &owner) in self.components.of_dashpot.iter().enumerate() {
            if owner as usize == index {
                self.y[offsets.viscous + dashpot] = self.y0[offsets.viscous + dashpot];
            }
        }
        let old = view.state;
        for at in self.slots_of(index) {
            let slot = self.components.slots[at] as usize;
            self.y[offsets.temperatures + slot] = self.y0[offsets.temperatures + slot];
            next.entropies.advance(slot, &old.entropies, S::zero());
        }
        for share in self.components.all[index].shares.clone() {
            let reservoir = self.components.shares[share].reservoir as usize;
            // One by one: their difference would be rounded to ε of what is taken back.
            let [new, old] = [&self.new_books, &self.books].map(|books| books.shares.sum(share));
            for change in [-new.value, old.value, -new.carry, old.carry] {
                next.reservoir_entropies.add(reservoir, change);
            }
            self.new_books
                .shares
                .advance(share, &self.books.shares, S::zero());
        }
        let lost = &mut self.new_books.targets[index].lost;
        next.dissipated
            .add(-lost.change(self.books.targets[index].lost));
        *lost = self.books.targets[index].lost;
        let progress = &mut self.scratch.progress[index];
        progress.is_rigid = true;
        progress.seen = None;
        progress.production = Total::default();
        progress.factor = S::zero();
        self.scratch.waits[index] = S::Mask::none();
        self.restore_momenta(index);
        self.scratch.open[index] = true;
        Ok(())
    }

    /// Whether the old state, turned about one plane, is within a part of what the stages say; if so, positions and momenta
    /// are there then.
    fn takes_turn(&mut self, index: usize, h: S, largest: S, scales: Scales<S>) -> bool {
        if D > 3 {
            // It may turn in several planes at once.
            return false;
        }
        core::mem::swap(&mut self.y, &mut self.y0);
        let component = &self.components.all[index];
        let rigid = self.rigid(component);
        core::mem::swap(&mut self.y, &mut self.y0);
        let difference = self.difference_from_turn(index, &rigid, h, scales);
        if !difference.at_most(largest).all() {
            return false;
        }
        for place in self.components.all[index].masses.clone() {
            let [position, momentum] = self.turned(place, &rigid, h);
            let (positions, momenta) =
                self.y[..self.offsets.viscous].split_at_mut(self.offsets.momenta);
            positions.as_chunks_mut::<D>().0[place] = position;
            momenta.as_chunks_mut::<D>().0[place] = momentum;
        }
        true
    }

    /// Position and momentum of a mass that has turned with its component since the start of the step.
    fn turned(&self, place: usize, rigid: &Rigid<S, D>, h: S) -> [[S; D]; 2] {
        let positions = points::<S, D>(&self.y0[..self.offsets.momenta]);
        let momenta = points::<S, D>(&self.y0[self.offsets.momenta..self.offsets.viscous]);
        let speed = rigid.omega.square().sqrt();
        let is_turning = S::zero().less(speed).all();
        let zero = S::zero();
        let about = rigid
            .omega
            .map(zero, |w| if is_turning { w / speed } else { w });
        let mut along = [S::zero(); D];
        add(&mut along, self.masses[place], &rigid.velocity);
        let arm = rigid.origin.arm(&positions[place]);
        let mut way = rotated(&arm, &about, speed * h);
        add(&mut way, h, &rigid.velocity);
        let position = rigid.origin.moved(&way);
        let own = difference(&momenta[place], &along);
        let mut momentum = rotated(&own, &about, speed * h);
        add(&mut momentum, S::one(), &along);
        [position, momentum]
    }

    /// The largest relative difference of the present stage vector from the turned old state.
    fn difference_from_turn(
        &self,
        index: usize,
        rigid: &Rigid<S, D>,
        h: S,
        scales: Scales<S>,
    ) -> S {
        let offsets = self.offsets;
        let positions = points::<S, D>(&self.y[..offsets.momenta]);
        let momenta = points::<S, D>(&self.y[offsets.momenta..offsets.viscous]);
        let mut largest = S::zero();
        let mut see = |difference: S, scale: S| {
            let is_none = difference.equal(S::zero()).all();
            let part = if is_none {
                difference
            } else {
                difference.abs() / scale
            };
            largest = largest.maximum(part);
        };
        for place in self.components.all[index].masses.clone() {
            let [position, momentum] = self.turned(place, rigid, h);
            see(
                length(&difference(&position, &positions[place])),
                scales.position,
            );
            see(
                length(&difference(&momentum, &momenta[place])),
                scales.momentum,
            );
        }
        for (dashpot, &owner) in self.components.of_dashpot.iter().enumerate() {
            let at = offsets.viscous + dashpot;
            if owner as usize == index {
                see(self.y[at] - self.y0[at], scales.position);
            }
        }
        for at in self.slots_of(index) {
            let at = offsets.temperatures + self.components.slots[at] as usize;
            see(self.y[at] - self.y0[at], self.y0[at]);
        }
        largest
    }
}

/// A vector turned in a plane, that of a bivector of length one (Rodrigues).
fn rotated<S: Real, const D: usize>(r: &[S; D], about: &Bivector<S, D>, angle: S) -> [S; D] {
    let (sine, half) = (angle.sin(), (S::from_f64(0.5) * angle).sin());
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
        assert!(
            length(&difference(&turned, &expected)) < 1e-15,
            "{turned:?}"
        );
        let mut about = Bivector::<f64, 2>::zero();
        *about.at_mut([0, 1]) = -1.0;
        let flat = rotated(&[1.0, 2.0], &about, core::f64::consts::PI);
        assert!(
            length(&difference(&flat, &[-1.0, -2.0])) < 1e-15,
            "{flat:?}"
        );
    }
}
