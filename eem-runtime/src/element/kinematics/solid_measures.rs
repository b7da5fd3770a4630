//! The measures at a point of a solid as functions of its arms, and its stress.

use core::array;

use nalgebra::SMatrix;

use crate::element::error::StateError;
use crate::element::handle::Element;
use crate::element::kinematics::between::{Between, Deformed};
use crate::element::kinematics::measures::{Ends, Kinematics};
use crate::element::kinematics::solid::{Deformations, PerArm, PerPair, SolidPoint, Strains};
use crate::element::kinematics::solid_state::SolidState;
#[cfg(feature = "gradients")]
use crate::element::kinematics::stiffness::strain_along;
use crate::element::kinematics::strain::Measure;
use eem_material::free_energy::{Array, Entry};
use eem_material::joint::basis;
use eem_material::number::scalar::{Mask, Real};
use eem_mesh::Shape;
use eem_mesh::tensor::{Symmetric, plus, pushed, scaled};

impl<H: Shape<D>, S: Real, const N: usize, const D: usize> Kinematics<S, D>
    for SolidPoint<H, S, N, D>
{
    type PerNode<T: Entry> = H::PerNode<T>;
    type PerArm<T: Entry> = H::PerArm<T>;
    type PerMeasure<T: Entry> = [T; N];
    type PerPoint<T: Send + Sync> = H::PerPoint<T>;

    type Between = Deformations<H, S, D>;

    const IS_SPRING: bool = false;
    const VISCOUS_UNIT: &'static str = "";
    const VISCOSITY_UNIT: &'static str = "J s";

    #[inline]
    fn is_admissible(&self, r: &PerArm<H, S, D>, measures: &[S; N]) -> bool {
        let volume = H::Tensor::<S>::determinant(&self.deformation(r));
        S::zero().less(volume).all() && measures.iter().all(|measure| measure.is_finite())
    }

    #[cold]
    fn refusal(&self, element: Element, r: &PerArm<H, S, D>) -> StateError {
        StateError::InsideOut {
            element,
            value: H::Tensor::<S>::determinant(&self.deformation(r)).to_f64(),
        }
    }

    #[inline]
    fn unit(&self, _: &[S; N]) -> S {
        S::one()
    }

    #[inline]
    fn length(&self, _: &[S; N]) -> S {
        self.length
    }

    // E has the rounding of ½(FᵀF − 1), and π that of P:E.
    fn sizes(&self, r: &PerArm<H, S, D>, _: &[S; N]) -> [S; N] {
        let tensor = self.deformation(r);
        let between = Strains::<H, S, D>::new([&tensor, &tensor]);
        let squares = tensor.iter().flatten();
        let square = squares.fold(S::one(), |sum, &entry| sum + entry * entry);
        let size = S::from_f64(0.5) * square;
        self.measures
            .each_ref()
            .map(|measure| sizes_of(between.slope(measure)).contracted(&H::Tensor::filled(size)))
    }

    fn slopes(&self, r: &PerArm<H, S, D>, measures: &[S; N]) -> [S; N] {
        let gradient = self.gradient(r, measures);
        gradient.map(|arms| {
            let entries = arms.as_ref().iter().flatten();
            entries.fold(S::zero(), |sum, entry| sum + entry.abs())
        })
    }

    // The slope of E:E, E⁰ + E¹, vanishes without strain, but the rounding of its terms ½(FᵀF + 1) remains. It acts in all
    // directions, also in those without force.
    fn slope_sizes(&self, r: &PerArm<H, S, D>, _: &[S; N]) -> [S; N] {
        let tensor = self.deformation(r);
        let between = Strains::<H, S, D>::new([&tensor, &tensor]);
        let terms = self.terms_of_deformation(r);
        let unit = H::Tensor::<S>::unit();
        let strain = plus(&H::Tensor::green_lagrange(&terms), S::one(), &unit);
        self.measures.each_ref().map(|measure| {
            let slope = match measure {
                Measure::Square => plus(&strain, S::one(), &strain),
                _ => between.slope(measure),
            };
            self.size_of_pull(&terms, &sizes_of(slope))
        })
    }

    fn solid_state(&self, r: &PerArm<H, S, D>, force: &[S; N]) -> Option<SolidState<S>> {
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
            // The stress that keeps the thickness: P₃₃ of each measure.
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
        Some(SolidState {
            stress,
            strain,
            dilatation,
        })
    }

    fn numbers(&self, see: &mut dyn FnMut(S)) {
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
    fn measure(&self, r: &PerArm<H, S, D>) -> [S; N] {
        let deformed = Deformed::<H::Tensor<S>, S, D>::new(self.deformation(r));
        self.measures.each_ref().map(|of| deformed.measure(of))
    }

    #[inline]
    fn gradient(&self, r: &PerArm<H, S, D>, _: &[S; N]) -> [PerArm<H, S, D>; N] {
        let tensor = self.deformation(r);
        self.along(&tensor, &Between::new([&tensor, &tensor]))
    }

    // The change of P with both ends is twice that with the new one.
    fn curvature(&self, r: &PerArm<H, S, D>, _: &[S; N], force: &[S; N]) -> PerPair<H, S, D> {
        let two = S::from_f64(2.0);
        let tensor = self.deformation(r);
        let between = Strains::<H, S, D>::new([&tensor, &tensor]);
        let doubled = tensor.map(|row| row.map(|entry| two * entry));
        let mut blocks = no_blocks::<H, S, D>();
        let ends = [&doubled, &tensor];
        self.add_stiffness(ends, &between, (force, &[]), S::one(), &mut blocks);
        blocks
    }

    #[inline]
    fn between(&self, arms: [&PerArm<H, S, D>; 2]) -> Deformations<H, S, D> {
        let [old, new] = arms.map(|r| self.deformation(r));
        let half = S::from_f64(0.5);
        let mean = array::from_fn(|i| array::from_fn(|j| half * (old[i][j] + new[i][j])));
        Deformations {
            mean,
            new,
            strains: Between::new([&old, &new]),
        }
    }

    #[inline]
    fn new_gradient(&self, ends: &Ends<Self, S, D>) -> [PerArm<H, S, D>; N] {
        let Deformations { new, strains, .. } = &ends.between;
        self.along(new, &strains.at_the_end())
    }

    #[inline]
    fn discrete_gradient(&self, ends: &Ends<Self, S, D>) -> [PerArm<H, S, D>; N] {
        self.along(&ends.between.mean, &ends.between.strains)
    }

    #[inline]
    fn pull(
        &self,
        ends: &Ends<Self, S, D>,
        _: &[PerArm<H, S, D>; N],
        force: &[S; N],
    ) -> PerArm<H, S, D> {
        let stress = self.stress(&ends.between.strains, force);
        self.pulled(&ends.between.mean, &stress)
    }

    fn discrete_tangent(
        &self,
        ends: &Ends<Self, S, D>,
        force: &[S; N],
        force_by_arm: &[PerArm<H, S, D>; N],
    ) -> PerPair<H, S, D> {
        let mut blocks = no_blocks::<H, S, D>();
        self.add_discrete_tangent(ends, force, force_by_arm, &mut blocks);
        blocks
    }

    fn add_discrete_tangent(
        &self,
        ends: &Ends<Self, S, D>,
        force: &[S; N],
        force_by_arm: &[PerArm<H, S, D>; N],
        sum: &mut PerPair<H, S, D>,
    ) {
        let Deformations { mean, new, strains } = &ends.between;
        let (forces, half) = ((force, &force_by_arm[..]), S::from_f64(0.5));
        self.add_stiffness([mean, new], strains, forces, half, sum);
    }

    #[cfg(feature = "gradients")]
    fn discrete_rates(&self, ends: &Ends<Self, S, D>, w: &PerArm<H, S, D>) -> [S; N] {
        let Deformations { mean, strains, .. } = &ends.between;
        let along = strain_along(mean, &self.deformation(w));
        let slope = |measure| strains.slope(measure).contracted(&along);
        self.measures.each_ref().map(slope)
    }

    #[cfg(feature = "gradients")]
    fn pull_back(
        &self,
        ends: &Ends<Self, S, D>,
        p: &[S; N],
        (force, w): (&[S; N], &PerArm<H, S, D>),
    ) -> PerArm<H, S, D> {
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
    fn secant(&self, ends: &Ends<Self, S, D>, force: &[S; N]) -> H::PerArm<H::PerArm<S>> {
        let stress = self.stress(&ends.between.strains, force);
        self.stiffness_of(&stress)
    }
}

#[inline]
fn no_blocks<H: Shape<D>, S: Real, const D: usize>() -> PerPair<H, S, D> {
    H::PerArm::filled(H::PerArm::filled([[S::zero(); D]; D]))
}

/// The absolute values of the components.
fn sizes_of<S: Real, A: Array<S>>(mut tensor: A) -> A {
    for entry in tensor.as_mut() {
        *entry = entry.abs();
    }
    tensor
}
