//! Stress and strain at a point of a cell from its arms.

use nalgebra::SMatrix;

use crate::element::kinematics::between::Deformed;
use crate::element::kinematics::shape::Shape;
use crate::element::kinematics::solid::{PerArm, SolidPoint, Strains};
use crate::element::kinematics::solid_state::SolidState;
use crate::element::kinematics::strain::Measure;
use crate::element::kinematics::tensor::{Symmetric, pushed, scaled};
use eem_material::joint::basis;
use eem_material::number::scalar::Real;

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
                Measure::Component(k) => basis(*k)[2],
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
