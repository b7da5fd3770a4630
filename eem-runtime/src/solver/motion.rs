//! What Newton's method knows of a node that moves and of a temperature that neighbours see, each in one
//! record.

use super::places::{MovingNode, Seen};
use crate::scalar::Real;

/// A node that moves, during one step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Motion<S, const D: usize> {
    pub(super) place: MovingNode<S, D>,
    /// `2p⁰ − h F⁰` with the part F⁰ of the force that the old state decides, N s; zero while nothing
    /// moves.
    pub(super) rest: [S; D],
    /// `q¹ − q⁰` before the last update, m.
    pub(super) previous: [S; D],
}

impl<S: Real, const D: usize> Motion<S, D> {
    pub(super) fn new(place: MovingNode<S, D>) -> Self {
        Self {
            place,
            rest: [S::zero(); D],
            previous: [S::zero(); D],
        }
    }
}

/// A temperature Θ that neighbours see, during one step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Glance<S> {
    pub(super) place: Seen,
    /// Θ before the last update, K.
    pub(super) previous: S,
}

impl<S: Real> Glance<S> {
    pub(super) fn new(place: Seen) -> Self {
        Self {
            place,
            previous: S::zero(),
        }
    }
}
