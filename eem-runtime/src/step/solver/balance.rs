//! The momentum balance of a node that moves.

use core::array;

use super::places::MovingNode;
use crate::element::group::{StepView, Trial, points};
use crate::step::certificate::Speeds;
use eem_material::number::scalar::Real;

/// What Newton's method knows of a node that moves, during one step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Balance<S, const D: usize> {
    pub(super) place: MovingNode<S, D>,
    /// `c (h/m) p⁰`, the displacement of free flight up to the stage, m; zero while nothing moves.
    pub(super) flight: [S; D],
    /// `−h F⁰` with the part F⁰ of the force that the old state and the loads decide, N s; zero while
    /// nothing moves.
    pub(super) push: [S; D],
}

impl<S: Real, const D: usize> Balance<S, D> {
    pub(super) fn new(place: MovingNode<S, D>) -> Self {
        Self {
            place,
            flight: [S::zero(); D],
            push: [S::zero(); D],
        }
    }

    /// `c h v⁰`, m.
    #[inline]
    fn flight_in(&self, view: &StepView<'_, S>, time: S) -> [S; D] {
        let at = self.place.node();
        let velocities = points::<S, D>(view.state.velocities.values());
        if let Some(velocity) = velocities.get(at) {
            return velocity.map(|velocity| time * view.step * velocity);
        }
        let mobility = time * view.step * self.place.per_mass;
        points::<S, D>(view.state.momenta.values())[at].map(|momentum| mobility * momentum)
    }

    /// What does not change during a step, given the share c of the step up to the stage and F⁰.
    #[inline]
    pub(super) fn weigh(&mut self, view: &StepView<'_, S>, time: S, force: [S; D]) {
        if view.phase.moves() {
            self.flight = self.flight_in(view, time);
            self.push = force.map(|force| -view.step * force);
        } else {
            (self.flight, self.push) = ([S::zero(); D], [S::zero(); D]);
        }
    }

    /// `Δq` at a trial, m.
    pub(super) fn displacement(&self, trial: &Trial<S, D>) -> [S; D] {
        trial.displacements[self.place.in_trial()]
    }

    /// `Δq − h v⁰` at a trial, m.
    pub(super) fn change(&self, trial: &Trial<S, D>) -> [S; D] {
        let at = self.place.in_trial();
        self.beyond_flight([&trial.displacements[at], &trial.rests[at]])
    }

    #[inline]
    fn beyond_flight(&self, [displacement, rest]: [&[S; D]; 2]) -> [S; D] {
        array::from_fn(|axis| (displacement[axis] - self.flight[axis]) + rest[axis])
    }

    /// How fast it moves in a step.
    #[inline]
    pub(super) fn speeds(
        &self,
        view: &StepView<'_, S>,
        trial: &Trial<S, D>,
        twice_per_step: S,
    ) -> Speeds<S, D> {
        match points::<S, D>(view.state.velocities.values()).get(self.place.node()) {
            None => Speeds::OfMass(self.place.per_mass),
            Some(&old) => Speeds::Given {
                old,
                change: self.change(trial).map(|change| twice_per_step * change),
            },
        }
    }

    /// `Δp = (2m/h)(Δq − (h/m) p⁰)`, N s, of a displacement; `inertia_per_mass` is 2/h, or 1/(ch) for a stage.
    ///
    /// It has the digits of Δp also where that is small beside p, and those of Δq where `Δp ≈ −2p⁰`.
    #[inline]
    pub(super) fn impulse(&self, displacement: [&[S; D]; 2], inertia_per_mass: S) -> [S; D] {
        let inertia = self.place.mass * inertia_per_mass;
        self.beyond_flight(displacement)
            .map(|change| inertia * change)
    }

    /// Starts residual and tangent of its momentum balance at a displacement, with `p¹` eliminated,
    ///
    /// ```text
    /// R = (2m/h)(q¹ − q⁰) − 2p⁰ + h F
    /// ```
    ///
    /// to which the elements will add their share; `inertia_per_mass` is 2/h, or 1/(ch) for a stage.
    #[inline]
    pub(super) fn balance(
        &self,
        displacement: [&[S; D]; 2],
        inertia_per_mass: S,
        values: &mut [S],
        rows: &mut [S; D],
    ) {
        let inertia = self.place.mass * inertia_per_mass;
        for place in self.place.diagonal() {
            values[place] = inertia;
        }
        let impulse = self.impulse(displacement, inertia_per_mass);
        *rows = array::from_fn(|axis| self.push[axis] - impulse[axis]);
    }
}
