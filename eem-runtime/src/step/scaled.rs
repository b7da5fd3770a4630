//! Vectors times numbers.

use crate::algebra::vector;

/// `factor v`.
#[inline]
pub(super) fn scaled<const D: usize>(factor: f64, v: &[f64; D]) -> [f64; D] {
    vector(|axis| factor * v[axis])
}
