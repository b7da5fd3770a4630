//! Vectors of positions and momenta, and points from which arms are counted.

use eem_material::number::scalar::Real;

#[inline]
pub(super) fn dot<S: Real, const D: usize>(a: &[S; D], b: &[S; D]) -> S {
    a.iter().zip(b).fold(S::zero(), |sum, (&a, &b)| sum + a * b)
}

/// `|a|`, where squares may over- or underflow too.
pub(super) fn length<S: Real, const D: usize>(a: &[S; D]) -> S {
    a.iter().fold(S::zero(), |length, &x| length.hypot(x))
}

/// `Σ |a_i|`, no less than `|a|`.
#[inline]
pub(super) fn size<S: Real, const D: usize>(a: &[S; D]) -> S {
    a.iter().fold(S::zero(), |size, &x| size + x.abs())
}

/// `sum += factor a`.
#[inline]
pub(super) fn add<S: Real, const D: usize>(sum: &mut [S; D], factor: S, a: &[S; D]) {
    for (sum, &a) in sum.iter_mut().zip(a) {
        *sum += factor * a;
    }
}

#[inline]
pub(super) fn difference<S: Real, const D: usize>(a: &[S; D], b: &[S; D]) -> [S; D] {
    core::array::from_fn(|axis| a[axis] - b[axis])
}

/// A point from which arms are counted: an anchor, or a centre of mass by its distance from one of the masses, so that
/// arms of a body far from the origin lose no digits.
#[derive(Clone, Copy, Debug)]
pub(super) struct Origin<S, const D: usize> {
    base: [S; D],
    offset: [S; D],
}

impl<S: Real, const D: usize> Origin<S, D> {
    pub(super) fn at(point: &[S; D]) -> Self {
        let (base, offset) = (*point, [S::zero(); D]);
        Self { base, offset }
    }

    /// The centre of some masses with this sum.
    pub(super) fn center<'a>(mut masses: impl Iterator<Item = (S, &'a [S; D])>, mass: S) -> Self {
        let mut sum = [S::zero(); D];
        let base = masses.next().map_or(sum, |(_, &first)| first);
        for (mass, position) in masses {
            add(&mut sum, mass, &difference(position, &base));
        }
        let offset = sum.map(|moment| moment / mass);
        Self { base, offset }
    }

    #[inline]
    pub(super) fn arm(&self, position: &[S; D]) -> [S; D] {
        core::array::from_fn(|axis| (position[axis] - self.base[axis]) - self.offset[axis])
    }

    /// `self + by`.
    pub(super) fn moved(&self, by: &[S; D]) -> [S; D] {
        core::array::from_fn(|axis| self.base[axis] + (self.offset[axis] + by[axis]))
    }
}

/// The largest `|a_i|`.
pub(super) fn largest<S: Real, const D: usize>(a: &[S; D]) -> S {
    a.iter().fold(S::zero(), |most, x| most.maximum(x.abs()))
}
