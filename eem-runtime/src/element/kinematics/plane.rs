//! Symmetric tensors of the plane: xx, yy, xy.
//!
//! There the determinant is quadratic in C and its mean-value gradient the cofactor of the mean.

use crate::element::kinematics::tensor::Symmetric;
use eem_material::joint::basis;
use eem_material::number::scalar::Real;

impl<S: Real> Symmetric<S, 2> for [S; 3] {
    #[inline]
    fn unit() -> Self {
        [S::one(), S::one(), S::zero()]
    }

    #[inline]
    fn basis(k: usize) -> Self {
        let [xx, yy, _, xy, ..] = basis(k);
        [xx, yy, xy]
    }

    #[inline]
    fn green_lagrange([[xx, xy], [yx, yy]]: &[[S; 2]; 2]) -> Self {
        let half = S::from_f64(0.5);
        [
            half * ((*xx * *xx + *yx * *yx) - S::one()),
            half * ((*xy * *xy + *yy * *yy) - S::one()),
            half * (*xx * *xy + *yx * *yy),
        ]
    }

    #[inline]
    fn trace(&self) -> S {
        self[0] + self[1]
    }

    #[inline]
    fn contracted(&self, other: &Self) -> S {
        (self[0] * other[0] + self[1] * other[1]) + S::from_f64(2.0) * (self[2] * other[2])
    }

    #[inline]
    fn applied(&self, v: &[S; 2]) -> [S; 2] {
        let [xx, yy, xy] = *self;
        [xx * v[0] + xy * v[1], xy * v[0] + yy * v[1]]
    }

    #[inline]
    fn symmetrised(u: &[S; 2], v: &[S; 2]) -> Self {
        let shear = S::from_f64(0.5) * (u[0] * v[1] + u[1] * v[0]);
        [u[0] * v[0], u[1] * v[1], shear]
    }

    // det C − 1 = 2 tr E + 4 det E
    #[inline]
    fn growth(&self) -> S {
        let [xx, yy, xy] = *self;
        S::from_f64(2.0) * (xx + yy) + S::from_f64(4.0) * (xx * yy - xy * xy)
    }

    #[inline]
    fn cofactor_of_one_plus(&self) -> Self {
        let [xx, yy, xy] = *self;
        [S::one() + yy, S::one() + xx, -xy]
    }

    #[inline]
    fn slope_of_determinant(sum: &Self, _: &Self) -> Self {
        sum.cofactor_of_one_plus()
    }

    #[inline]
    fn change_of_slope(_: &Self, _: &Self, &[xx, yy, xy]: &Self) -> Self {
        [yy, xx, -xy]
    }

    #[inline]
    fn determinant([[xx, xy], [yx, yy]]: &[[S; 2]; 2]) -> S {
        *xx * *yy - *xy * *yx
    }

    #[inline]
    fn cofactor(&[[xx, xy], [yx, yy]]: &[[S; 2]; 2]) -> [[S; 2]; 2] {
        [[yy, -yx], [-xy, xx]]
    }
}
