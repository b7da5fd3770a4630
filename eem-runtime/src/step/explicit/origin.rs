//! Points from which arms are counted.

use super::components::{Component, Support};
use crate::algebra::{add, difference, vector};
use crate::element::group::Place;

/// A point from which arms are counted: an anchor, or a centre of mass by its distance from one of the masses, so that
/// arms of a body far from the origin lose no digits.
#[derive(Clone, Copy, Debug)]
pub(super) struct Origin<const D: usize> {
    base: [f64; D],
    offset: [f64; D],
}

impl<const D: usize> Origin<D> {
    /// The point about which the angular momentum of a component is conserved: its anchor or its centre of mass; the
    /// origin with several anchors, where none is.
    #[inline]
    pub(super) fn of(places: &[Place<D>], component: &Component) -> Self {
        let base = match component.support {
            Support::Free => {
                return Self::center(&places[component.masses.clone()], component.mass);
            }
            Support::Anchor(place) => *places[place].q(),
            Support::Several => [0.0; D],
        };
        let offset = [0.0; D];
        Self { base, offset }
    }

    /// The centre of some masses with this sum.
    fn center(masses: &[Place<D>], mass: f64) -> Self {
        let [mut base, mut sum] = [[0.0; D]; 2];
        if let [first, others @ ..] = masses {
            base = *first.q();
            for place in others {
                add(&mut sum, place.mass, &difference(place.q(), &base));
            }
        }
        let offset = vector(|axis| sum[axis] / mass);
        Self { base, offset }
    }

    #[inline]
    pub(super) fn arm(&self, position: &[f64; D]) -> [f64; D] {
        vector(|axis| (position[axis] - self.base[axis]) - self.offset[axis])
    }

    /// `self + by`.
    pub(super) fn moved(&self, by: &[f64; D]) -> [f64; D] {
        vector(|axis| self.base[axis] + (self.offset[axis] + by[axis]))
    }
}
