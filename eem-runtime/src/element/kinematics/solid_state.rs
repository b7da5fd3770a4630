//! Stress and strain at a point of a solid.

use nalgebra::SMatrix;

use crate::element::kinematics::between::Deformed;
use crate::element::kinematics::shape::Shape;
use crate::element::kinematics::solid::{PerArm, SolidPoint, Strains};
use crate::element::kinematics::strain::Measure;
use crate::element::kinematics::tensor::{Symmetric, pushed, scaled};
use crate::number::scalar::Real;

/// Stress and strain at a point of a solid, in three dimensions also in plane strain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SolidState<S: Real> {
    /// Cauchy's stress `σ = F S Fᵀ/J` without that of dashpots beside the solid, Pa.
    pub stress: SMatrix<S, 3, 3>,
    /// Green and Lagrange's strain `E = ½(FᵀF − 1)`.
    pub strain: SMatrix<S, 3, 3>,
    /// `J − 1`.
    pub dilatation: S,
}

impl<S: Real> SolidState<S> {
    /// Von Mises's equivalent stress `√(³⁄₂ dev σ:dev σ)`, Pa.
    #[must_use]
    pub fn von_mises(&self) -> S {
        let s = |i, j| self.stress[(i, j)];
        let differences = [s(0, 0) - s(1, 1), s(1, 1) - s(2, 2), s(2, 2) - s(0, 0)];
        let shears = [s(0, 1), s(1, 2), s(2, 0)];
        let square = |sum, &entry: &S| sum + entry * entry;
        let normal = differences.iter().fold(S::zero(), square);
        let shear = shears.iter().fold(S::zero(), square);
        (S::from_f64(0.5) * normal + S::from_f64(3.0) * shear).sqrt()
    }
}

impl<H: Shape<D>, S: Real, const N: usize, const D: usize> SolidPoint<H, S, N, D> {
    /// Stress and strain with these arms, under the conjugates of its measures for its volume, J.
    pub(super) fn state(&self, r: &PerArm<H, S, D>, force: &[S; N]) -> SolidState<S> {
        let tensor = self.deformation(r);
        let between = Strains::<H, S, D>::new([&tensor, &tensor]);
        let deformed = Deformed::<H::Tensor<S>, S, D>::new(tensor);
        let dilatation = deformed.measure(&Measure::Dilatation);
        let volume = S::one() + dilatation;
        let second = scaled(self.volume.recip(), &self.stress(&between, force));
        let mut stress = SMatrix::from_element(S::zero());
        let mut strain = stress;
        for (column, row) in tensor.iter().enumerate() {
            let pushed = pushed(&tensor, &second.applied(row));
            let mut axis = [S::zero(); D];
            axis[column] = S::one();
            let stretched = deformed.strain().applied(&axis);
            for row in 0..D {
                stress[(row, column)] = pushed[row] / volume;
                strain[(row, column)] = stretched[row];
            }
        }
        if D == 2 {
            // What keeps the thickness: P₃₃ of each measure.
            let slopes = self.measures.each_ref().map(|measure| match measure {
                Measure::Trace => S::one(),
                Measure::Dilatation => volume,
                Measure::Square | Measure::Fibre(_) => S::zero(),
            });
            let across = slopes.iter().zip(force);
            let across = across.fold(S::zero(), |sum, (&slope, &force)| sum + slope * force);
            stress[(2, 2)] = across / (self.volume * volume);
        }
        SolidState {
            stress,
            strain,
            dilatation,
        }
    }
}
