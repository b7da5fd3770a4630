//! The line along which a rocket pushes.

use crate::algebra::{dot, vector};

/// A line between two nodes at a time of a step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line<const D: usize> {
    /// n.
    pub(super) direction: [f64; D],
    /// `|r|`, m; not positive if r has no direction.
    pub(super) length: f64,
}

impl<const D: usize> Line<D> {
    /// Along an arm r.
    pub(super) fn along(arm: &[f64; D]) -> Self {
        let length = dot(arm, arm).sqrt();
        Self {
            direction: vector(|axis| arm[axis] / length),
            length,
        }
    }

    /// `(1 − n nᵀ)/|r|`, times a number.
    pub(super) fn turning(&self, factor: f64) -> [[f64; D]; D] {
        let size = factor / self.length;
        let n = &self.direction;
        let mut turning = [[0.0; D]; D];
        for (row, entries) in turning.iter_mut().enumerate() {
            *entries = vector(|column| {
                let own = if row == column { 1.0 } else { 0.0 };
                size * (own - n[row] * n[column])
            });
        }
        turning
    }
}
