//! Strain in the plane: its measures and their mean-value gradients.
//!
//! ```text
//! E = ½(FᵀF − 1),   j = i3/(1 + √(1 + i3)),   i3 = det C − 1 = 2 tr E + 4 det E
//! P:ΔE = Δπ exactly:   tr E: 1     E:E: E⁰ + E¹     j: 2 cof(C_m)/(J⁰ + J¹),   C_m = 1 + E⁰ + E¹
//! ```
//!
//! Out of the plane nothing stretches: `F₃₃ = 1`. There the determinant is quadratic in C and its
//! mean-value gradient the cofactor of the mean.

use crate::element::kinematics::strain::Strain;
use crate::number::scalar::Real;

/// A symmetric tensor: xx, yy, xy.
pub(super) type Symmetric<S> = [S; 3];

/// A tensor, row by row.
pub(super) type Tensor<S> = [[S; 2]; 2];

/// `½(FᵀF − 1)`.
#[inline]
fn green_lagrange<S: Real>([[xx, xy], [yx, yy]]: &Tensor<S>) -> Symmetric<S> {
    let half = S::from_f64(0.5);
    [
        half * ((*xx * *xx + *yx * *yx) - S::one()),
        half * ((*xy * *xy + *yy * *yy) - S::one()),
        half * (*xx * *xy + *yx * *yy),
    ]
}

/// `det F`.
#[inline]
pub(super) fn determinant<S: Real>([[xx, xy], [yx, yy]]: &Tensor<S>) -> S {
    *xx * *yy - *xy * *yx
}

/// A deformation gradient with its strain.
#[derive(Clone, Copy, Debug)]
pub(super) struct Deformed<S> {
    pub(super) tensor: Tensor<S>,
    pub(super) strain: Symmetric<S>,
}

/// The square of a strain beyond which j is that of F. Below, j and the other measures have the rounding
/// of the same E, so that differences like `e1 − ln(1 + j)` keep their digits; above, squares of E would
/// take digits of a small J, or of one beside a large shear. At the limit both are right to ε.
const LARGE_SQUARE: f64 = 0.25;

impl<S: Real> Deformed<S> {
    #[inline]
    pub(super) fn new(tensor: Tensor<S>) -> Self {
        let strain = green_lagrange(&tensor);
        Self { tensor, strain }
    }

    /// A measure of its strain.
    #[inline]
    pub(super) fn measure(&self, of: Strain) -> S {
        let [xx, yy, xy] = self.strain;
        let two = S::from_f64(2.0);
        let square = (xx * xx + yy * yy) + two * (xy * xy);
        match of {
            Strain::Trace => xx + yy,
            Strain::Square => square,
            Strain::Dilatation => {
                let i3 = two * (xx + yy) + S::from_f64(4.0) * (xx * yy - xy * xy);
                let of_strain = i3 / (S::one() + (S::one() + i3).sqrt());
                let of_tensor = determinant(&self.tensor) - S::one();
                let is_small = square.less(S::from_f64(LARGE_SQUARE));
                S::select(is_small, of_strain, of_tensor)
            }
        }
    }
}

/// Two strains, and the sum of their `J = 1 + j`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Between<S> {
    /// `E⁰ + E¹`.
    sum: Symmetric<S>,
    /// `J⁰ + J¹`.
    volumes: S,
    new: Symmetric<S>,
    new_volume: S,
}

impl<S: Real> Between<S> {
    /// Two deformations.
    #[inline]
    pub(super) fn new(ends: [&Tensor<S>; 2]) -> Self {
        let [old, new] = ends.map(|tensor| Deformed::new(*tensor));
        let [old_volume, new_volume] =
            [old, new].map(|end| S::one() + end.measure(Strain::Dilatation));
        let (old, new) = (old.strain, new.strain);
        Self {
            sum: [old[0] + new[0], old[1] + new[1], old[2] + new[2]],
            volumes: old_volume + new_volume,
            new,
            new_volume,
        }
    }

    /// P with `P:ΔE = Δπ`.
    #[inline]
    pub(super) fn slope(&self, strain: Strain) -> Symmetric<S> {
        match strain {
            Strain::Trace => [S::one(), S::one(), S::zero()],
            Strain::Square => self.sum,
            Strain::Dilatation => {
                let [xx, yy, xy] = self.sum;
                let per_volume = S::from_f64(2.0) / self.volumes;
                let one = S::one();
                [(one + yy), (one + xx), -xy].map(|entry| per_volume * entry)
            }
        }
    }

    /// The change of a slope P with the new strain.
    #[inline]
    pub(super) fn change_of_slope(
        &self,
        strain: Strain,
        slope: &Symmetric<S>,
        change: &Symmetric<S>,
    ) -> Symmetric<S> {
        let [xx, yy, xy] = *change;
        match strain {
            Strain::Trace => [S::zero(); 3],
            Strain::Square => [xx, yy, xy],
            Strain::Dilatation => {
                let volume = contracted(&self.new_slope_of_volume(), change);
                let (two, per_volume) = (S::from_f64(2.0), self.volumes.recip());
                let cofactor = [yy, xx, -xy];
                core::array::from_fn(|k| per_volume * (two * cofactor[k] - slope[k] * volume))
            }
        }
    }

    /// `∂J/∂E = cof C/J` at the new strain.
    #[inline]
    fn new_slope_of_volume(&self) -> Symmetric<S> {
        let [xx, yy, xy] = self.new;
        let (one, two, per_volume) = (S::one(), S::from_f64(2.0), self.new_volume.recip());
        [one + two * yy, one + two * xx, -(two * xy)].map(|entry| per_volume * entry)
    }
}

/// `A:B`.
#[inline]
pub(super) fn contracted<S: Real>(a: &Symmetric<S>, b: &Symmetric<S>) -> S {
    (a[0] * b[0] + a[1] * b[1]) + S::from_f64(2.0) * (a[2] * b[2])
}

/// `A v` of a symmetric tensor.
#[inline]
pub(super) fn applied<S: Real>([xx, yy, xy]: &Symmetric<S>, v: &[S; 2]) -> [S; 2] {
    [*xx * v[0] + *xy * v[1], *xy * v[0] + *yy * v[1]]
}

/// `F v`.
#[inline]
pub(super) fn pushed<S: Real>(tensor: &Tensor<S>, v: &[S; 2]) -> [S; 2] {
    tensor.map(|row| row[0] * v[0] + row[1] * v[1])
}

/// `sym(u ⊗ v)`.
#[inline]
pub(super) fn symmetrised<S: Real>(u: &[S; 2], v: &[S; 2]) -> Symmetric<S> {
    let shear = S::from_f64(0.5) * (u[0] * v[1] + u[1] * v[0]);
    [u[0] * v[0], u[1] * v[1], shear]
}
