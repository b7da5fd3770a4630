//! The measures at a point of a solid as functions of its arms, and its stress.

use nalgebra::SMatrix;

use crate::algebra::vector;
use crate::element::error::StateError;
use crate::element::handle::Element;
use crate::element::kinematics::between::{Between, Deformed};
use crate::element::kinematics::measures::{Ends, Kinematics, StrainSet};
use crate::element::kinematics::solid::{Deformations, PerArm, PerPair, SolidPoint, Strains};
use crate::element::kinematics::solid_state::SolidState;
#[cfg(feature = "gradients")]
use crate::element::kinematics::stiffness::strain_along;
use crate::element::kinematics::strain::Measure;
use eem_material::free_energy::{Array, Entry};
use eem_material::joint::basis;
use eem_mesh::Shape;
use eem_mesh::tensor::{Symmetric, plus, pushed, scaled};

impl<H: Shape<D>, const N: usize, const D: usize> Kinematics<D> for SolidPoint<H, N, D> {
    type PerNode<T: Entry> = H::PerNode<T>;
    type PerArm<T: Entry> = H::PerArm<T>;
    type Measures = StrainSet<N>;
    type PerPoint<T: Send + Sync> = H::PerPoint<T>;

    type Between = Deformations<H, D>;

    #[inline]
    fn is_admissible(&self, r: &PerArm<H, D>, measures: &[f64; N]) -> bool {
        let volume = H::Tensor::determinant(&self.deformation(r));
        volume > 0.0 && measures.iter().all(|measure| measure.is_finite())
    }

    #[cold]
    fn refusal(&self, element: Element, r: &PerArm<H, D>) -> StateError {
        StateError::InsideOut {
            element,
            value: H::Tensor::determinant(&self.deformation(r)),
        }
    }

    #[inline]
    fn length(&self, _: &[f64; N]) -> f64 {
        self.length
    }

    // E has the rounding of ½(FᵀF − 1), and π that of P:E.
    fn sizes(&self, r: &PerArm<H, D>, _: &[f64; N]) -> [f64; N] {
        let tensor = self.deformation(r);
        let between = Strains::<H, D>::new([&tensor, &tensor]);
        let squares = tensor.iter().flatten();
        let square = squares.fold(1.0, |sum, &entry| sum + entry * entry);
        let size = 0.5 * square;
        self.measures
            .each_ref()
            .map(|measure| sizes_of(between.slope(measure)).contracted(&H::Tensor::filled(size)))
    }

    fn slopes(&self, r: &PerArm<H, D>, measures: &[f64; N]) -> [f64; N] {
        let gradient = self.gradient(r, measures);
        gradient.map(|arms| {
            let entries = arms.as_ref().iter().flatten();
            entries.fold(0.0, |sum, entry| sum + entry.abs())
        })
    }

    // The slope of E:E, E⁰ + E¹, vanishes without strain, but the rounding of its terms ½(FᵀF + 1) remains. It acts in all
    // directions, also in those without force.
    fn slope_sizes(&self, r: &PerArm<H, D>, _: &[f64; N]) -> [f64; N] {
        let tensor = self.deformation(r);
        let between = Strains::<H, D>::new([&tensor, &tensor]);
        let terms = self.terms_of_deformation(r);
        let unit = H::Tensor::unit();
        let strain = plus(&H::Tensor::green_lagrange(&terms), 1.0, &unit);
        self.measures.each_ref().map(|measure| {
            let slope = match measure {
                Measure::Square => plus(&strain, 1.0, &strain),
                _ => between.slope(measure),
            };
            self.size_of_pull(&terms, &sizes_of(slope))
        })
    }

    fn solid_state(&self, r: &PerArm<H, D>, force: &[f64; N]) -> Option<SolidState> {
        let tensor = self.deformation(r);
        let between = Strains::<H, D>::new([&tensor, &tensor]);
        let deformed = Deformed::<H::Tensor, D>::new(tensor);
        let dilatation = deformed.measure(&Measure::Dilatation);
        let volume = 1.0 + dilatation;
        let second = scaled(self.volume.recip(), &self.stress(&between, force));
        let mut stress = SMatrix::from_element(0.0);
        let mut strain = stress;
        for (column, row) in tensor.iter().enumerate() {
            let pushed = pushed(&tensor, &second.applied(row));
            let mut axis = [0.0; D];
            axis[column] = 1.0;
            let stretched = deformed.strain().applied(&axis);
            for row in 0..D {
                stress[(row, column)] = pushed[row] / volume;
                strain[(row, column)] = stretched[row];
            }
        }
        if D == 2 {
            // The stress that keeps the thickness: P₃₃ of each measure.
            let slopes = self.measures.each_ref().map(|measure| match measure {
                Measure::Trace => 1.0,
                Measure::Dilatation => volume,
                Measure::Square | Measure::Fibre(_) => 0.0,
                Measure::Component(k) => basis(*k)[2],
            });
            let across = slopes.iter().zip(force);
            let across = across.fold(0.0, |sum, (&slope, &force)| sum + slope * force);
            stress[(2, 2)] = across / (self.volume * volume);
        }
        Some(SolidState {
            stress,
            strain,
            dilatation,
        })
    }

    fn numbers(&self, see: &mut dyn FnMut(f64)) {
        see(self.volume);
        let fibres = self.measures.iter().filter_map(|measure| match measure {
            Measure::Fibre(along) => Some(along),
            _ => None,
        });
        for &entry in self.gradients.as_ref().iter().chain(fibres).flatten() {
            see(entry);
        }
    }

    #[inline]
    fn measure(&self, r: &PerArm<H, D>) -> [f64; N] {
        let deformed = Deformed::<H::Tensor, D>::new(self.deformation(r));
        self.measures.each_ref().map(|of| deformed.measure(of))
    }

    #[inline]
    fn gradient(&self, r: &PerArm<H, D>, _: &[f64; N]) -> [PerArm<H, D>; N] {
        let tensor = self.deformation(r);
        self.along(&tensor, &Between::new([&tensor, &tensor]))
    }

    // The change of P with both ends is twice that with the new one.
    fn curvature(&self, r: &PerArm<H, D>, _: &[f64; N], force: &[f64; N]) -> PerPair<H, D> {
        let tensor = self.deformation(r);
        let between = Strains::<H, D>::new([&tensor, &tensor]);
        let doubled = tensor.map(|row| row.map(|entry| 2.0 * entry));
        let mut blocks = no_blocks::<H, D>();
        let ends = [&doubled, &tensor];
        self.add_stiffness(ends, &between, (force, &[]), 1.0, &mut blocks);
        blocks
    }

    #[inline]
    fn between(&self, arms: [&PerArm<H, D>; 2]) -> Deformations<H, D> {
        let [old, new] = arms.map(|r| self.deformation(r));
        let mean = core::array::from_fn(|i| vector(|j| 0.5 * (old[i][j] + new[i][j])));
        Deformations {
            mean,
            new,
            strains: Between::new([&old, &new]),
        }
    }

    #[inline]
    fn new_gradient(&self, ends: &Ends<Self, D>) -> [PerArm<H, D>; N] {
        let Deformations { new, strains, .. } = &ends.between;
        self.along(new, &strains.at_the_end())
    }

    #[inline]
    fn discrete_gradient(&self, ends: &Ends<Self, D>) -> [PerArm<H, D>; N] {
        self.along(&ends.between.mean, &ends.between.strains)
    }

    #[inline]
    fn pull(&self, ends: &Ends<Self, D>, _: &[PerArm<H, D>; N], force: &[f64; N]) -> PerArm<H, D> {
        let stress = self.stress(&ends.between.strains, force);
        self.pulled(&ends.between.mean, &stress)
    }

    fn discrete_tangent(
        &self,
        ends: &Ends<Self, D>,
        force: &[f64; N],
        force_by_arm: &[PerArm<H, D>; N],
    ) -> PerPair<H, D> {
        let mut blocks = no_blocks::<H, D>();
        self.add_discrete_tangent(ends, force, force_by_arm, &mut blocks);
        blocks
    }

    fn add_discrete_tangent(
        &self,
        ends: &Ends<Self, D>,
        force: &[f64; N],
        force_by_arm: &[PerArm<H, D>; N],
        sum: &mut PerPair<H, D>,
    ) {
        let Deformations { mean, new, strains } = &ends.between;
        let forces = (force, &force_by_arm[..]);
        self.add_stiffness([mean, new], strains, forces, 0.5, sum);
    }

    #[cfg(feature = "gradients")]
    fn discrete_rates(&self, ends: &Ends<Self, D>, w: &PerArm<H, D>) -> [f64; N] {
        let Deformations { mean, strains, .. } = &ends.between;
        let along = strain_along(mean, &self.deformation(w));
        let slope = |measure| strains.slope(measure).contracted(&along);
        self.measures.each_ref().map(slope)
    }

    #[cfg(feature = "gradients")]
    fn pull_back(
        &self,
        ends: &Ends<Self, D>,
        p: &[f64; N],
        (force, w): (&[f64; N], &PerArm<H, D>),
    ) -> PerArm<H, D> {
        let Deformations { mean, new, strains } = &ends.between;
        let mut by = self.pulled_stiffness([mean, new], strains, force, &self.deformation(w));
        let stress = self.stress(&strains.at_the_end(), p);
        for (by, row) in by.iter_mut().zip(new) {
            for (by, along) in by.iter_mut().zip(stress.applied(row)) {
                *by += along;
            }
        }
        let mut pulled = self.gradients;
        for b in pulled.as_mut() {
            *b = pushed(&by, b);
        }
        pulled
    }

    // Σ f F_m P B_i = Σ_j (B_i·S* B_j) r_m,j
    fn secant(&self, ends: &Ends<Self, D>, force: &[f64; N]) -> H::PerArm<H::PerArm<f64>> {
        let stress = self.stress(&ends.between.strains, force);
        self.stiffness_of(&stress)
    }
}

#[inline]
fn no_blocks<H: Shape<D>, const D: usize>() -> PerPair<H, D> {
    H::PerArm::filled(H::PerArm::filled([[0.0; D]; D]))
}

/// The absolute values of the components.
fn sizes_of<A: Array<f64>>(mut tensor: A) -> A {
    for entry in tensor.as_mut() {
        *entry = entry.abs();
    }
    tensor
}
