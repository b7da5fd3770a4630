//! The momentum balance of a node that moves.

use super::places::MovingNode;
use crate::algebra::{scaled, vector};
use crate::element::group::{StepView, Trial, points};
use crate::element::tableau::UnknownSet;
use crate::step::certificate::Speeds;

/// A moving node in Newton's method, during one step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Balance<const D: usize> {
    pub(super) place: MovingNode<D>,
    /// `c (h/m) p⁰`, the displacement of free flight up to the stage, m; zero while nothing moves.
    pub(super) flight: [f64; D],
    /// 2m/h, or m/(ch) for a stage, kg/s.
    inertia: f64,
    /// The reciprocal of the length of its shortest element in the old state, 1/m; 1 without elements.
    pub(super) per_length: f64,
    /// `−h F⁰` with the part F⁰ of the force that depends on the old state and the loads only, N s; zero while nothing
    /// moves.
    pub(super) push: [f64; D],
}

impl<const D: usize> Balance<D> {
    pub(super) fn new(place: MovingNode<D>) -> Self {
        Self {
            place,
            flight: [0.0; D],
            inertia: 0.0,
            per_length: 1.0,
            push: [0.0; D],
        }
    }

    /// `c h v⁰`, m.
    #[inline]
    fn flight_in(&self, view: &StepView<'_>, time: f64) -> [f64; D] {
        let at = self.place.node();
        let velocities = points::<D>(view.state.velocities.values());
        if let Some(velocity) = velocities.get(at) {
            return scaled(time * view.step, velocity);
        }
        let mobility = time * view.step * self.place.per_mass;
        scaled(mobility, &points(view.state.momenta.values())[at])
    }

    /// Sets inertia, flight and push for a step, its set of unknowns and F⁰.
    #[inline]
    pub(super) fn weigh(&mut self, view: &StepView<'_>, set: &UnknownSet, force: [f64; D]) {
        let time = set.time;
        self.inertia = self.place.mass * (set.inertia * view.per_step);
        if view.phase.moves() {
            self.flight = self.flight_in(view, time);
            self.push = scaled(-view.step, &force);
        } else {
            (self.flight, self.push) = ([0.0; D], [0.0; D]);
        }
    }

    /// `Δq` at a trial, m.
    pub(super) fn displacement(&self, trial: &Trial<D>) -> [f64; D] {
        trial.displacements[self.place.in_trial()]
    }

    /// `Δq − h v⁰` at a trial, m.
    pub(super) fn change(&self, trial: &Trial<D>) -> [f64; D] {
        let at = self.place.in_trial();
        self.beyond_flight([&trial.displacements[at], &trial.carries[at]])
    }

    #[inline]
    fn beyond_flight(&self, [displacement, rest]: [&[f64; D]; 2]) -> [f64; D] {
        vector(|axis| (displacement[axis] - self.flight[axis]) + rest[axis])
    }

    /// Its velocities in a step.
    #[inline]
    pub(super) fn speeds(
        &self,
        view: &StepView<'_>,
        trial: &Trial<D>,
        twice_per_step: f64,
    ) -> Speeds<D> {
        match points::<D>(view.state.velocities.values()).get(self.place.node()) {
            None => Speeds::OfMass(self.place.per_mass),
            Some(&old) => {
                let change = scaled(twice_per_step, &self.change(trial));
                Speeds::Given { old, change }
            }
        }
    }

    /// `Δp = (2m/h)(Δq − (h/m) p⁰)`, N s, of a displacement, and the magnitude of its terms.
    ///
    /// It is accurate relative to Δp even where Δp is small compared with p, and relative to Δq where `Δp ≈ −2p⁰`.
    #[inline]
    pub(super) fn impulse(&self, displacement: [&[f64; D]; 2]) -> [[f64; D]; 2] {
        let [moved, _] = displacement;
        [
            scaled(self.inertia, &self.beyond_flight(displacement)),
            vector(|axis| self.inertia * moved[axis].abs()),
        ]
    }

    /// Starts residual and tangent of its momentum balance at a displacement, with `p¹` eliminated,
    ///
    /// ```text
    /// R = (2m/h)(q¹ − q⁰) − 2p⁰ + h F
    /// ```
    ///
    /// to which the elements add their contributions.
    #[inline]
    pub(super) fn balance(
        &self,
        displacement: [&[f64; D]; 2],
        values: &mut [f64],
        right: &mut [[f64; 1]],
    ) {
        for place in self.place.diagonal() {
            values[place] = self.inertia;
        }
        let [impulse, _] = self.impulse(displacement);
        *self.place.rows_mut(right) = vector(|axis| self.push[axis] - impulse[axis]);
    }
}
