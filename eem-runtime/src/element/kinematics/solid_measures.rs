//! The measures at a point of a solid, as the groups of elements ask for them.

use crate::element::error::StateError;
use crate::element::handle::Element;
use crate::element::kinematics::between::{Between, Deformed};
use crate::element::kinematics::measures::{Ends, Kinematics};
use crate::element::kinematics::shape::Shape;
use crate::element::kinematics::solid::{Deformations, PerArm, PerPair, SolidPoint, Strains};
use crate::element::kinematics::solid_state::SolidState;
use crate::element::kinematics::strain::Measure;
use crate::element::kinematics::tensor::{Symmetric, plus, pushed};
use eem_material::free_energy::{Array, Entry};
use eem_material::number::scalar::{Mask, Real};

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
        self.measures.each_ref().map(|measure| {
            let mut slope = between.slope(measure);
            slope
                .as_mut()
                .iter_mut()
                .for_each(|entry| *entry = entry.abs());
            slope.contracted(&H::Tensor::filled(size))
        })
    }

    fn slopes(&self, r: &PerArm<H, S, D>, measures: &[S; N]) -> [S; N] {
        let gradient = self.gradient(r, measures);
        gradient.map(|arms| {
            let entries = arms.as_ref().iter().flatten();
            entries.fold(S::zero(), |sum, entry| sum + entry.abs())
        })
    }

    // Of E⁰ + E¹, the slope of E:E, nothing is left where strains vanish, but the rounding of its terms
    // ½(FᵀF + 1) remains. It acts in all directions, also in those without force.
    fn slope_sizes(&self, r: &PerArm<H, S, D>, _: &[S; N]) -> [S; N] {
        let tensor = self.deformation(r);
        let between = Strains::<H, S, D>::new([&tensor, &tensor]);
        let terms = self.terms_of_deformation(r);
        let unit = H::Tensor::<S>::unit();
        let strain = plus(&H::Tensor::green_lagrange(&terms), S::one(), &unit);
        let mut steepness = [S::zero(); D];
        for (sum, b) in (0..D).cycle().zip(self.gradients.as_ref().as_flattened()) {
            steepness[sum] += b.abs();
        }
        self.measures.each_ref().map(|measure| {
            let mut slope = match measure {
                Measure::Square => plus(&strain, S::one(), &strain),
                _ => between.slope(measure),
            };
            for entry in slope.as_mut() {
                *entry = entry.abs();
            }
            let sizes = pushed(&terms, &slope.applied(&steepness));
            sizes.iter().fold(S::zero(), |sum, &size| sum + size)
        })
    }

    fn solid_state(&self, r: &PerArm<H, S, D>, force: &[S; N]) -> Option<SolidState<S>> {
        Some(self.state(r, force))
    }

    fn numbers(&self, see: &mut dyn FnMut(S)) {
        see(self.volume);
        let entries = self.gradients.as_ref().iter().flatten();
        entries.for_each(|&entry| see(entry));
        for measure in &self.measures {
            if let Measure::Fibre(along) = measure {
                for &entry in along {
                    see(entry);
                }
            }
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
        self.deformations(arms)
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
