//! The momentum balance of a node that moves.

use core::array;

use super::places::MovingNode;
use crate::group::StepView;
use crate::scalar::Real;

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

    /// What does not change during a step, given the share c of the step up to the stage, p⁰ and F⁰.
    #[inline]
    pub(super) fn weigh(
        &mut self,
        view: &StepView<'_, S>,
        time: S,
        momentum: &[S; D],
        force: [S; D],
    ) {
        if view.phase.moves() {
            let mobility = time * view.step * self.place.per_mass;
            self.flight = momentum.map(|momentum| mobility * momentum);
            self.push = force.map(|force| -view.step * force);
        } else {
            (self.flight, self.push) = ([S::zero(); D], [S::zero(); D]);
        }
    }

    /// `Δp = (2m/h)(Δq − (h/m) p⁰)`, N s, of a displacement; `inertia_per_mass` is 2/h, or 1/(ch) for a stage.
    ///
    /// It has the digits of Δp also where that is small beside p, and those of Δq where `Δp ≈ −2p⁰`.
    #[inline]
    pub(super) fn impulse(
        &self,
        [displacement, rest]: [&[S; D]; 2],
        inertia_per_mass: S,
    ) -> [S; D] {
        let inertia = self.place.mass * inertia_per_mass;
        array::from_fn(|axis| inertia * ((displacement[axis] - self.flight[axis]) + rest[axis]))
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
