//! The line along which a rocket pushes.

use core::array;

use eem_material::number::scalar::Real;

/// A line between two nodes at a time of a step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line<S, const D: usize> {
    /// n.
    pub(super) direction: [S; D],
    /// `|r|`, m; not positive if r has no direction.
    pub(super) length: S,
}

impl<S: Real, const D: usize> Line<S, D> {
    /// Along an arm r.
    pub(super) fn along(arm: &[S; D]) -> Self {
        let square = arm.iter().fold(S::zero(), |sum, &r| sum + r * r);
        let length = square.sqrt();
        Self {
            direction: arm.map(|r| r / length),
            length,
        }
    }

    /// `(1 − n nᵀ)/|r|`, times a number.
    pub(super) fn turning(&self, factor: S) -> [[S; D]; D] {
        let size = factor / self.length;
        let n = &self.direction;
        array::from_fn(|row| {
            array::from_fn(|column| {
                let own = if row == column { S::one() } else { S::zero() };
                size * (own - n[row] * n[column])
            })
        })
    }
}
