//! What Newton's method knows of a node that moves and of a temperature that neighbours see, each in one
//! record.

use core::array;

use super::places::{MovingNode, Seen};
use crate::group::StepView;
use crate::scalar::Real;

/// A node that moves, during one step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Motion<S, const D: usize> {
    pub(super) place: MovingNode<S, D>,
    /// 2m/h, kg/s; 1 while nothing moves.
    pub(super) inertia: S,
    /// `2p⁰ − h F⁰` with the part F⁰ of the force that the old state decides, N s; zero while nothing
    /// moves.
    pub(super) rest: [S; D],
    /// The reciprocal of its unit of length: its shortest element in the old state; 1 m without.
    pub(super) per_length: S,
    /// `q¹ − q⁰` before the last update, and the update, m.
    pub(super) previous: [S; D],
    pub(super) correction: [S; D],
}

impl<S: Real, const D: usize> Motion<S, D> {
    pub(super) fn new(place: MovingNode<S, D>) -> Self {
        Self {
            place,
            inertia: S::one(),
            rest: [S::zero(); D],
            per_length: S::one(),
            previous: [S::zero(); D],
            correction: [S::zero(); D],
        }
    }

    /// Inertia and impulse that do not change during a step, given p⁰ and F⁰.
    #[inline]
    pub(super) fn weigh(&mut self, view: &StepView<'_, S>, momentum: &[S; D], force: [S; D]) {
        if !view.phase.moves() {
            (self.inertia, self.rest) = (S::one(), [S::zero(); D]);
            return;
        }
        let twice = |value: S| value + value;
        self.inertia = twice(self.place.mass) * view.step.recip();
        self.rest = array::from_fn(|axis| twice(momentum[axis]) - view.step * force[axis]);
    }

    /// Starts residual and tangent of its momentum balance at a displacement, with `p¹` eliminated,
    ///
    /// ```text
    /// R = (2m/h)(q¹ − q⁰) − 2p⁰ + h F
    /// ```
    ///
    /// to which the elements will add their share.
    #[inline]
    pub(super) fn balance(&self, displacement: &[S; D], values: &mut [S], rows: &mut [S; D]) {
        for place in self.place.diagonal {
            values[place] = self.inertia;
        }
        *rows = array::from_fn(|axis| self.rest[axis] - self.inertia * displacement[axis]);
    }
}

/// A temperature Θ that neighbours see, during one step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Glance<S> {
    pub(super) place: Seen,
    /// Θ before the last update, and the update, K.
    pub(super) previous: S,
    pub(super) correction: S,
}

impl<S: Real> Glance<S> {
    pub(super) fn new(place: Seen) -> Self {
        Self {
            place,
            previous: S::zero(),
            correction: S::zero(),
        }
    }
}
