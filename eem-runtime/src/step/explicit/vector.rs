//! Vectors of angular momentum, whatever the dimension of the scene.
//!
//! They have three components; in the plane only the third is not zero, on a line none.

use crate::number::scalar::{Mask, Real};

/// `r × p`.
#[inline]
pub(super) fn moment<S: Real, const D: usize>(r: &[S; D], p: &[S; D]) -> [S; 3] {
    let zero = S::zero();
    match D {
        2 => [zero, zero, r[0] * p[1] - r[1] * p[0]],
        3 => [
            r[1] * p[2] - r[2] * p[1],
            r[2] * p[0] - r[0] * p[2],
            r[0] * p[1] - r[1] * p[0],
        ],
        _ => [zero; 3],
    }
}

/// `ω × r`.
#[inline]
pub(super) fn spin<S: Real, const D: usize>(omega: &[S; 3], r: &[S; D]) -> [S; D] {
    let mut speed = [S::zero(); D];
    match D {
        2 => {
            speed[0] = -omega[2] * r[1];
            speed[1] = omega[2] * r[0];
        }
        3 => {
            speed[0] = omega[1] * r[2] - omega[2] * r[1];
            speed[1] = omega[2] * r[0] - omega[0] * r[2];
            speed[2] = omega[0] * r[1] - omega[1] * r[0];
        }
        _ => {}
    }
    speed
}

#[inline]
pub(super) fn dot<S: Real, const D: usize>(a: &[S; D], b: &[S; D]) -> S {
    a.iter().zip(b).fold(S::zero(), |sum, (&a, &b)| sum + a * b)
}

/// `|a|`, where squares may over- or underflow too.
pub(super) fn length<S: Real, const D: usize>(a: &[S; D]) -> S {
    a.iter().fold(S::zero(), |length, &x| length.hypot(x))
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

/// The moments of inertia of a body about a point, kg m²: a symmetric matrix of which the plane needs one
/// entry.
#[derive(Clone, Copy, Debug)]
pub(super) struct Inertia<S> {
    matrix: [[S; 3]; 3],
}

/// The share of the trace below which a pivot belongs to a direction without arm: ε^¾, 2·10⁻¹² in double
/// precision.
fn least_pivot<S: Real>() -> S {
    let root = S::EPSILON.sqrt();
    root * root.sqrt()
}

impl<S: Real> Inertia<S> {
    /// Of nothing.
    pub(super) fn none() -> Self {
        Self {
            matrix: [[S::zero(); 3]; 3],
        }
    }

    /// Adds a mass at the end of an arm.
    #[inline]
    pub(super) fn add<const D: usize>(&mut self, mass: S, r: &[S; D]) {
        let square = dot(r, r);
        if D == 2 {
            self.matrix[2][2] += mass * square;
            return;
        }
        for row in 0..D.min(3) {
            self.matrix[row][row] += mass * square;
            for column in 0..D.min(3) {
                self.matrix[row][column] -= mass * (r[row] * r[column]);
            }
        }
    }

    /// Adds the same moment about all axes.
    pub(super) fn add_sphere(&mut self, moment: S) {
        for axis in 0..3 {
            self.matrix[axis][axis] += moment;
        }
    }

    /// Eliminated with the largest diagonal entry that is left as pivot.
    pub(super) fn eliminate<const D: usize>(mut self) -> Eliminated<S> {
        let matrix = &mut self.matrix;
        let (mut order, mut rank) = ([0, 1, 2], 0);
        if D == 3 && S::LANES == 1 {
            let least = least_pivot::<S>() * (matrix[0][0] + matrix[1][1] + matrix[2][2]);
            for step in 0..3 {
                let mut best = step;
                for other in step + 1..3 {
                    let [own, found] = [order[other], order[best]].map(|axis| matrix[axis][axis]);
                    if found.less(own).all() {
                        best = other;
                    }
                }
                order.swap(step, best);
                let pivot = order[step];
                if matrix[pivot][pivot].at_most(least).all() {
                    break;
                }
                rank += 1;
                for &row in &order[rank..] {
                    let factor = matrix[row][pivot] / matrix[pivot][pivot];
                    for &column in &order[rank..] {
                        matrix[row][column] -= factor * matrix[pivot][column];
                    }
                    // Not needed any more, but the factor is.
                    matrix[row][pivot] = factor;
                }
            }
        }
        Eliminated {
            matrix: self.matrix,
            order,
            rank,
        }
    }
}

/// Moments of inertia after the elimination; as they were in the plane, and for several numbers, whose pivots
/// may differ.
#[derive(Clone, Copy, Debug)]
pub(super) struct Eliminated<S> {
    matrix: [[S; 3]; 3],
    order: [usize; 3],
    rank: usize,
}

impl<S: Real> Eliminated<S> {
    /// ω with `I ω = J`. There is no arm in directions whose pivot vanishes, and no momentum: ω is zero there.
    pub(super) fn solve<const D: usize>(&self, mut right: [S; 3]) -> [S; 3] {
        let zero = S::zero();
        if D == 2 {
            let inertia = self.matrix[2][2];
            let is_none = inertia.at_most(zero);
            return [zero, zero, S::select(is_none, zero, right[2] / inertia)];
        }
        if S::LANES > 1 {
            return self.solve_lanes(right);
        }
        let (matrix, order, rank) = (&self.matrix, &self.order, self.rank);
        for step in 0..rank {
            let pivot = order[step];
            for &row in &order[step + 1..] {
                right[row] -= matrix[row][pivot] * right[pivot];
            }
        }
        let mut omega = [zero; 3];
        for step in (0..rank).rev() {
            let pivot = order[step];
            let known = &order[step + 1..rank];
            let rest = known.iter().fold(right[pivot], |rest, &column| {
                rest - matrix[pivot][column] * omega[column]
            });
            omega[pivot] = rest / matrix[pivot][pivot];
        }
        omega
    }

    /// The same for each of several numbers alone.
    fn solve_lanes(&self, right: [S; 3]) -> [S; 3] {
        let mut omega = [S::zero(); 3];
        for (axis, omega) in omega.iter_mut().enumerate() {
            *omega = S::pack(|lane| {
                let matrix = self.matrix.map(|row| row.map(|entry| entry.lane(lane)));
                let right = right.map(|component| component.lane(lane));
                let eliminated = Inertia::<f64> { matrix }.eliminate::<3>();
                eliminated.solve::<3>(right)[axis]
            });
        }
        omega
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn inertia(arms: &[[f64; 3]]) -> Inertia<f64> {
        let mut inertia = Inertia::none();
        for (mass, arm) in (1..).zip(arms) {
            inertia.add(f64::from(mass), arm);
        }
        inertia
    }

    #[test]
    fn the_rotation_of_a_body_follows_from_its_angular_momentum() {
        let arms = [[1.0, 0.2, -0.3], [0.1, 2.0, 0.4], [0.3, -0.5, 1.1]];
        let omega = [0.3, -0.7, 1.9];
        let mut momentum = [0.0; 3];
        for (mass, arm) in [1.0, 2.0, 3.0].into_iter().zip(&arms) {
            add(&mut momentum, mass, &moment(arm, &spin(&omega, arm)));
        }
        let found = inertia(&arms).eliminate::<3>().solve::<3>(momentum);
        for (found, omega) in found.into_iter().zip(omega) {
            assert!((found - omega).abs() < 1e-15, "{found} {omega}");
        }
    }

    // All masses on a line with the pivot, also on a diagonal, where rounding leaves no pivot zero.
    #[test]
    fn there_is_no_rotation_about_a_line_of_masses() {
        for line in [[1.0, 0.0, 0.0], [0.0, 0.0, 2.0], [0.3, 1.7, -0.9]] {
            let far = line.map(|x: f64| 2.5 * x);
            let omega = [0.2, -0.4, 0.6];
            let momentum = [1.0, 2.0].into_iter().zip([&line, &far]);
            let momentum = momentum.fold([0.0; 3], |mut sum, (mass, arm)| {
                add(&mut sum, mass, &moment(arm, &spin(&omega, arm)));
                sum
            });
            let found = inertia(&[line, far]).eliminate::<3>().solve::<3>(momentum);
            assert!(found.iter().all(|x| x.abs() < 10.0), "{found:?}");
            let again = [1.0, 2.0].into_iter().zip([&line, &far]);
            let again = again.fold([0.0; 3], |mut sum, (mass, arm)| {
                add(&mut sum, mass, &moment(arm, &spin(&found, arm)));
                sum
            });
            assert!(length(&difference(&again, &momentum)) < 1e-14 * length(&momentum));
        }
    }
}
