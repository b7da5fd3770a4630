//! Bivectors: angular momenta, torques and angular velocities in any dimension.
//!
//! A bivector has one component per pair of axes `i < j`, `(r ∧ p)_ij = r_i p_j − r_j p_i`: none on a line, one in
//! the plane, three in space (the components x, y and z of `r × p` are those of (1, 2), (2, 0) and (0, 1)), six in
//! four dimensions.

use eem_material::number::scalar::Scalar;

/// A bivector. Only the entries above the diagonal are used.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Bivector<T, const D: usize>([[T; D]; D]);

impl<T: Copy, const D: usize> Bivector<T, D> {
    /// The bivector with the same value in every plane.
    pub(crate) const fn filled(value: T) -> Self {
        Self([[value; D]; D])
    }

    /// The component of the plane of two axes `i < j`.
    #[inline]
    pub(crate) const fn at(&self, [i, j]: [usize; 2]) -> T {
        self.0[i][j]
    }

    #[inline]
    pub(crate) const fn at_mut(&mut self, [i, j]: [usize; 2]) -> &mut T {
        &mut self.0[i][j]
    }
}

/// All pairs of axes `i < j`.
#[inline]
pub(crate) fn planes<const D: usize>() -> impl Iterator<Item = [usize; 2]> {
    (0..D).flat_map(|i| (i + 1..D).map(move |j| [i, j]))
}

impl<const D: usize> Bivector<f64, D> {
    #[inline]
    pub(crate) fn zero() -> Self {
        Self::filled(0.0)
    }

    /// `r ∧ p`.
    #[inline]
    pub(crate) fn wedge(r: &[f64; D], p: &[f64; D]) -> Self {
        let mut result = Self::zero();
        for i in 0..D {
            for j in i + 1..D {
                result.0[i][j] = r[i] * p[j] - r[j] * p[i];
            }
        }
        result
    }

    /// `self / by`.
    #[inline]
    pub(crate) fn over(mut self, by: f64) -> Self {
        for i in 0..D {
            for j in i + 1..D {
                self.0[i][j] /= by;
            }
        }
        self
    }

    /// `self += factor · other`.
    #[inline]
    pub(crate) fn add(&mut self, factor: f64, other: &Self) {
        for i in 0..D {
            for j in i + 1..D {
                self.0[i][j] += factor * other.0[i][j];
            }
        }
    }

    /// The velocity of a point `r` that turns with this angular velocity, `v_j = Σ_i Ω_ij r_i` with `Ω_ji = −Ω_ij`;
    /// in space `ω × r`.
    #[inline]
    pub(crate) fn turn(&self, r: &[f64; D]) -> [f64; D] {
        let mut velocity = [0.0; D];
        for i in 0..D {
            for j in i + 1..D {
                velocity[j] += self.0[i][j] * r[i];
                velocity[i] -= self.0[i][j] * r[j];
            }
        }
        velocity
    }

    /// `Σ J_ij²` over all planes.
    #[inline]
    pub(crate) fn square(&self) -> f64 {
        let mut sum = 0.0;
        for i in 0..D {
            for j in i + 1..D {
                sum += self.0[i][j] * self.0[i][j];
            }
        }
        sum
    }

    /// The largest `|J_ij|`.
    #[inline]
    pub(crate) fn largest(&self) -> f64 {
        let mut most = 0.0;
        for i in 0..D {
            for j in i + 1..D {
                most = Scalar::maximum(most, self.0[i][j].abs());
            }
        }
        most
    }

    /// `Σ_ij a_i J_ij b_j` over all i and j: the component of the plane of two unit vectors.
    pub(crate) fn between(&self, a: &[f64; D], b: &[f64; D]) -> f64 {
        let turned = self.turn(a);
        let mut sum = 0.0;
        for axis in 0..D {
            sum += turned[axis] * b[axis];
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn in_space_it_is_the_cross_product() {
        let (r, p) = ([1.0, 2.0, 3.0], [-0.5, 0.25, 4.0]);
        let wedge = Bivector::<f64, 3>::wedge(&r, &p);
        let cross = [2.0 * 4.0 - 3.0 * 0.25, -1.5 - 4.0, 0.25 + 1.0];
        let found = [wedge.at([1, 2]), -wedge.at([0, 2]), wedge.at([0, 1])];
        assert_eq!(found.map(f64::to_bits), cross.map(f64::to_bits));
        // ω × r for ω = e_z.
        let mut spin = Bivector::<f64, 3>::zero();
        *spin.at_mut([0, 1]) = 1.0;
        assert_eq!(
            spin.turn(&r).map(f64::to_bits),
            [-2.0_f64, 1.0, 0.0].map(f64::to_bits)
        );
    }

    #[test]
    fn four_dimensions_have_six_planes() {
        assert_eq!(planes::<4>().count(), 6);
        let (r, p) = ([1.0, 0.0, 2.0, -1.0], [0.0, 3.0, 1.0, 2.0]);
        let wedge = Bivector::<f64, 4>::wedge(&r, &p);
        for [i, j] in planes::<4>() {
            let unit = |axis: usize| core::array::from_fn(|k| f64::from(u8::from(k == axis)));
            let expected = r[i] * p[j] - r[j] * p[i];
            assert_eq!(
                wedge.between(&unit(i), &unit(j)).to_bits(),
                expected.to_bits()
            );
        }
    }
}
