//! Vectors of positions and momenta.

use crate::number::scalar::Real;

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
