//! The inertia of the masses about the pivot, as if the springs were rigid, in factors.

use super::model::{Pendulum, vector};

/// Pivots below this share of the trace belong to an axis on which all masses lie: nothing turns about it.
const SINGULAR: f64 = 1e-12;

/// I = L D Lᵀ of a symmetric 3 × 3 matrix.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Inertia {
    lower_10: f64,
    lower_20: f64,
    lower_21: f64,
    /// Of D; zero where I is singular.
    inverse: [f64; 3],
}

impl Inertia {
    /// I = Σ m (|q|² 1 − q qᵀ).
    #[inline(always)]
    pub(super) fn of<C: Pendulum<N, X>, const N: usize, const X: usize>(y: &[f64; N]) -> Self {
        if C::DIMENSION == 2 {
            return Self::in_the_plane::<C, N, X>(y);
        }
        let [mut xx, mut xy, mut xz, mut yy, mut yz, mut zz] = [0.0; 6];
        for (i, m) in C::MASSES.into_iter().enumerate().take(C::COUNT) {
            let q = vector::<C, N, X>(y, 0, i);
            xx += m * (q[1] * q[1] + q[2] * q[2]);
            yy += m * (q[0] * q[0] + q[2] * q[2]);
            zz += m * (q[0] * q[0] + q[1] * q[1]);
            xy -= m * q[0] * q[1];
            xz -= m * q[0] * q[2];
            yz -= m * q[1] * q[2];
        }
        let smallest = SINGULAR * (xx + yy + zz);
        let inverse = |pivot: f64| if pivot > smallest { 1.0 / pivot } else { 0.0 };
        let first = inverse(xx);
        let (lower_10, lower_20) = (xy * first, xz * first);
        let second = inverse(yy - lower_10 * xy);
        let rest = yz - lower_10 * xz;
        let lower_21 = rest * second;
        let third = inverse(zz - lower_20 * xz - lower_21 * rest);
        Self {
            lower_10,
            lower_20,
            lower_21,
            inverse: [first, second, third],
        }
    }

    #[inline(always)]
    fn in_the_plane<C: Pendulum<N, X>, const N: usize, const X: usize>(y: &[f64; N]) -> Self {
        let mut about_z = 0.0;
        for (i, m) in C::MASSES.into_iter().enumerate().take(C::COUNT) {
            let q = vector::<C, N, X>(y, 0, i);
            about_z += m * (q[0] * q[0] + q[1] * q[1]);
        }
        let inverse = if about_z > 0.0 { 1.0 / about_z } else { 0.0 };
        Self {
            inverse: [0.0, 0.0, inverse],
            ..Self::default()
        }
    }

    /// ω with I ω = J.
    #[inline(always)]
    pub(super) fn solve(&self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        let y = y - self.lower_10 * x;
        let z = (z - self.lower_20 * x - self.lower_21 * y) * self.inverse[2];
        let y = y * self.inverse[1] - self.lower_21 * z;
        [
            x * self.inverse[0] - self.lower_10 * y - self.lower_20 * z,
            y,
            z,
        ]
    }
}
