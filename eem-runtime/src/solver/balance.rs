//! The momentum balance of a node that moves.

use core::array;

use super::places::MovingNode;
use crate::group::StepView;
use crate::scalar::Real;

/// What Newton's method knows of a node that moves, during one step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Balance<S, const D: usize> {
    pub(super) place: MovingNode<S, D>,
    /// `2p⁰ − h F⁰` with the part F⁰ of the force that the old state decides, N s; zero while nothing
    /// moves.
    pub(super) rest: [S; D],
}

impl<S: Real, const D: usize> Balance<S, D> {
    pub(super) fn new(place: MovingNode<S, D>) -> Self {
        Self {
            place,
            rest: [S::zero(); D],
        }
    }

    /// The impulse that does not change during a step, given p⁰ and F⁰.
    #[inline]
    pub(super) fn weigh(&mut self, view: &StepView<'_, S>, momentum: &[S; D], force: [S; D]) {
        self.rest = [S::zero(); D];
        if view.phase.moves() {
            let twice = |value: S| value + value;
            self.rest = array::from_fn(|axis| twice(momentum[axis]) - view.step * force[axis]);
        }
    }

    /// Starts residual and tangent of its momentum balance at a displacement, with `p¹` eliminated,
    ///
    /// ```text
    /// R = (2m/h)(q¹ − q⁰) − 2p⁰ + h F
    /// ```
    ///
    /// to which the elements will add their share; `twice_per_step` is 2/h.
    #[inline]
    pub(super) fn balance(
        &self,
        displacement: &[S; D],
        twice_per_step: S,
        values: &mut [S],
        rows: &mut [S; D],
    ) {
        let inertia = self.place.mass * twice_per_step;
        for place in self.place.diagonal() {
            values[place] = inertia;
        }
        *rows = array::from_fn(|axis| self.rest[axis] - inertia * displacement[axis]);
    }
}
