//! Principal axes of a body.

use super::moments::{Moments, NO_INERTIA};
use crate::algebra::bivector::{Bivector, planes};
use crate::algebra::jacobi::diagonalize;
use crate::algebra::vector;

/// Principal axes and moments.
#[derive(Clone, Copy, Debug)]
pub(in super::super) struct Principal<const D: usize> {
    /// Unit vectors.
    pub(super) axes: [[f64; D]; D],
    /// `Σ m r_a²`, not negative, kg m².
    pub(super) moments: [f64; D],
}

impl<const D: usize> Principal<D> {
    pub(in super::super) fn of(moments: &Moments<D>) -> Self {
        let mut matrix = moments.0;
        for [i, j] in planes::<D>() {
            matrix[j][i] = matrix[i][j];
        }
        let mut axes = [[0.0; D]; D];
        for (axis, row) in axes.iter_mut().enumerate() {
            row[axis] = 1.0;
        }
        diagonalize(D, matrix.as_flattened_mut(), axes.as_flattened_mut());
        // Sums of squares, but rounding may leave −0 or less.
        let moments = vector(|axis| matrix[axis][axis].max(0.0));
        Self { axes, moments }
    }

    pub(super) fn trace(&self) -> f64 {
        self.moments.iter().sum()
    }

    /// The slowest rotation with an angular momentum, in the planes that have inertia.
    pub(super) fn solve(&self, momentum: &Bivector<f64, D>) -> Bivector<f64, D> {
        let least = NO_INERTIA * self.trace();
        let mut omega = Bivector::zero();
        for [a, b] in planes::<D>() {
            let inertia = self.moments[a] + self.moments[b];
            if inertia > least {
                let speed = momentum.between(&self.axes[a], &self.axes[b]) / inertia;
                omega.add(speed, &Bivector::wedge(&self.axes[a], &self.axes[b]));
            }
        }
        omega
    }
}
