//! Vectors of positions and momenta, and points from which arms are counted.

use crate::algebra::vector;
use crate::element::group::Place;
use eem_material::number::scalar::Scalar;

#[inline]
pub(super) fn dot<const D: usize>(a: &[f64; D], b: &[f64; D]) -> f64 {
    let mut sum = 0.0;
    for axis in 0..D {
        sum += a[axis] * b[axis];
    }
    sum
}

/// `|a|`, where squares may over- or underflow too.
pub(super) fn length(a: &[f64]) -> f64 {
    a.iter().fold(0.0, |length, &x| Scalar::hypot(length, x))
}

/// `Σ |a_i|`, no less than `|a|`.
#[inline]
pub(super) fn size(a: &[f64]) -> f64 {
    a.iter().fold(0.0, |size, &x| size + x.abs())
}

/// `sum += factor a`.
#[inline]
pub(super) fn add<const D: usize>(sum: &mut [f64; D], factor: f64, a: &[f64; D]) {
    for (sum, &a) in sum.iter_mut().zip(a) {
        *sum += factor * a;
    }
}

#[inline]
pub(super) fn difference<const D: usize>(a: &[f64; D], b: &[f64; D]) -> [f64; D] {
    vector(|axis| a[axis] - b[axis])
}

/// A point from which arms are counted: an anchor, or a centre of mass by its distance from one of the masses, so that
/// arms of a body far from the origin lose no digits.
#[derive(Clone, Copy, Debug)]
pub(super) struct Origin<const D: usize> {
    base: [f64; D],
    offset: [f64; D],
}

impl<const D: usize> Origin<D> {
    pub(super) fn at(point: &[f64; D]) -> Self {
        let (base, offset) = (*point, [0.0; D]);
        Self { base, offset }
    }

    /// The centre of some masses with this sum.
    pub(super) fn center(masses: &[Place<D>], mass: f64) -> Self {
        let mut sum = [0.0; D];
        let base = masses.first().map_or(sum, |first| *first.q());
        for place in masses.iter().skip(1) {
            add(&mut sum, place.mass, &difference(place.q(), &base));
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

/// The largest `|a_i|`.
#[inline]
pub(super) fn largest(a: &[f64]) -> f64 {
    a.iter().fold(0.0, |most, x| Scalar::maximum(most, x.abs()))
}
