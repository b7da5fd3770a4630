//! Principal axes of a body, by Jacobi's method of rotations.

use super::moments::{Moments, NO_INERTIA};
use crate::algebra::bivector::{Bivector, planes};
use crate::algebra::vector;

/// Sweeps over all pairs of axes; convergence is quadratic, so that a handful suffice.
const MOST_SWEEPS: usize = 40;

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
        for _ in 0..MOST_SWEEPS {
            let mut has_rotated = false;
            for [i, j] in planes::<D>() {
                has_rotated |= rotate(&mut matrix, &mut axes, [i, j]);
            }
            if !has_rotated {
                break;
            }
        }
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

/// Makes the entry of two axes zero by a rotation in their plane; false where it is rounding already.
fn rotate<const D: usize>(
    matrix: &mut [[f64; D]; D],
    axes: &mut [[f64; D]; D],
    [i, j]: [usize; 2],
) -> bool {
    let entry = matrix[i][j];
    let [a, b] = [matrix[i][i], matrix[j][j]];
    if entry.abs() <= f64::EPSILON * f64::EPSILON * (a.abs() + b.abs()) {
        return false;
    }
    let ratio = (b - a) / (2.0 * entry);
    let tangent = ratio.signum() / (ratio.abs() + (ratio * ratio + 1.0).sqrt());
    let cosine = (tangent * tangent + 1.0).sqrt().recip();
    let sine = tangent * cosine;
    for row in matrix.iter_mut() {
        let [x, y] = [row[i], row[j]];
        (row[i], row[j]) = (cosine * x - sine * y, sine * x + cosine * y);
    }
    for rows in [&mut *matrix, axes] {
        let [x, y] = [rows[i], rows[j]];
        rows[i] = vector(|k| cosine * x[k] - sine * y[k]);
        rows[j] = vector(|k| sine * x[k] + cosine * y[k]);
    }
    (matrix[i][j], matrix[j][i]) = (0.0, 0.0);
    true
}
