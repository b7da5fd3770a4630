//! The strain E at a point of a solid as components, and its measures as functions of them.
//!
//! Conjugates of components are `n_q = w_q S_q`, where w counts each pair of shears once more, so that
//! `Σ n_q E_q = S:E`.

use crate::element::error::StateError;
use crate::element::handle::Element;
use crate::element::kinematics::quadratic_strain::QuadraticStrain;
use crate::element::kinematics::shape::Shape;
use crate::element::kinematics::solid::{PerArm, SolidPoint, Strains};
use crate::element::kinematics::tensor::{Symmetric, add, pushed};
use eem_material::free_energy::{Array, Entry};
use eem_material::number::scalar::{Real, is_positive};

type Components<H, S, const D: usize> = <H as Shape<D>>::PerComponent<S>;

/// As a tensor.
#[inline]
fn tensor<H: Shape<D>, S: Real, const D: usize>(components: &Components<H, S, D>) -> H::Tensor<S> {
    let mut tensor = H::Tensor::<S>::filled(S::zero());
    tensor.as_mut().copy_from_slice(components.as_ref());
    tensor
}

/// As components.
#[inline]
fn components<H: Shape<D>, S: Real, const D: usize>(tensor: &H::Tensor<S>) -> Components<H, S, D> {
    let mut components = Components::<H, S, D>::filled(S::zero());
    components.as_mut().copy_from_slice(tensor.as_ref());
    components
}

/// How often each component counts in `A:B`.
#[inline]
fn counts<H: Shape<D>, S: Real, const D: usize>() -> H::Tensor<S> {
    let mut counts = H::Tensor::<S>::filled(S::from_f64(2.0));
    counts.as_mut()[..D].fill(S::one());
    counts
}

/// The conjugates of components that go with a tensor.
#[inline]
fn conjugates<H: Shape<D>, S: Real, const D: usize>(by: &H::Tensor<S>) -> Components<H, S, D> {
    let mut conjugates = components::<H, S, D>(by);
    for (entry, &count) in conjugates
        .as_mut()
        .iter_mut()
        .zip(counts::<H, S, D>().as_ref())
    {
        *entry *= count;
    }
    conjugates
}

/// The tensor that goes with conjugates of components.
#[inline]
fn stress<H: Shape<D>, S: Real, const D: usize>(n: &Components<H, S, D>) -> H::Tensor<S> {
    let mut stress = tensor::<H, S, D>(n);
    for (entry, &count) in stress.as_mut().iter_mut().zip(counts::<H, S, D>().as_ref()) {
        *entry /= count;
    }
    stress
}

impl<H: Shape<D>, S: Real, const N: usize, const D: usize> QuadraticStrain<S, D>
    for SolidPoint<H, S, N, D>
{
    type PerStrain<T: Entry> = H::PerComponent<T>;

    #[inline]
    fn strain(&self, r: &PerArm<H, S, D>) -> Components<H, S, D> {
        components::<H, S, D>(&H::Tensor::green_lagrange(&self.deformation(r)))
    }

    // Ė = sym(FᵀḞ)
    #[inline]
    fn strain_rate(&self, r: &PerArm<H, S, D>, w: &PerArm<H, S, D>) -> Components<H, S, D> {
        let [rows, moved] = [r, w].map(|arms| self.deformation(arms));
        let mut rate = H::Tensor::<S>::filled(S::zero());
        for (row, moved) in rows.iter().zip(&moved) {
            add(&mut rate, S::one(), &H::Tensor::symmetrised(row, moved));
        }
        components::<H, S, D>(&rate)
    }

    #[inline]
    fn strain_force(&self, r: &PerArm<H, S, D>, n: &Components<H, S, D>) -> PerArm<H, S, D> {
        self.pulled(&self.deformation(r), &stress::<H, S, D>(n))
    }

    fn strain_force_size(&self, r: &PerArm<H, S, D>, n: &Components<H, S, D>) -> S {
        let terms = self.terms_of_deformation(r);
        let mut steepness = [S::zero(); D];
        for (sum, b) in (0..D).cycle().zip(self.gradients.as_ref().as_flattened()) {
            steepness[sum] += b.abs();
        }
        let sizes = pushed(&terms, &stress::<H, S, D>(n).applied(&steepness));
        sizes.iter().fold(S::zero(), |sum, &size| sum + size)
    }

    #[inline]
    fn strain_stiffness(&self, n: &Components<H, S, D>) -> H::PerArm<H::PerArm<S>> {
        self.stiffness_of(&stress::<H, S, D>(n))
    }

    // ½(FᵀF + 1), of which tr E + ½(D + 1) is the trace but for the unit tensor.
    #[inline]
    fn strain_sizes(&self, strain: &Components<H, S, D>) -> Components<H, S, D> {
        let ones = (0..D).fold(S::one(), |sum, _| sum + S::one());
        let trace = tensor::<H, S, D>(strain).trace();
        Components::<H, S, D>::filled(trace + S::from_f64(0.5) * ones)
    }

    #[inline]
    fn strain_metric(&self, _: &Components<H, S, D>) -> (Components<H, S, D>, S) {
        (components::<H, S, D>(&counts::<H, S, D>()), S::one())
    }

    #[inline]
    fn measures_of(&self, strain: &Components<H, S, D>) -> Option<[S; N]> {
        let strain = tensor::<H, S, D>(strain);
        let square = S::one() + strain.growth();
        if !is_positive(square) {
            return None;
        }
        Some(self.measures.each_ref().map(|of| of.of_strain(&strain)))
    }

    #[cold]
    fn refuse(&self, element: Element, strain: &Components<H, S, D>) -> StateError {
        let square = S::one() + tensor::<H, S, D>(strain).growth();
        StateError::Path {
            element,
            quantity: "squared volume ratio",
            value: square.to_f64(),
            unit: "",
        }
    }

    fn strain_slopes(&self, [old, new]: [&Components<H, S, D>; 2]) -> [Components<H, S, D>; N] {
        let [old, new] = [old, new].map(tensor::<H, S, D>);
        let between = Strains::<H, S, D>::of_strains([&old, &new]);
        let slopes = self.measures.each_ref();
        slopes.map(|measure| conjugates::<H, S, D>(&between.slope(measure)))
    }

    // The change of P with both ends is twice that with the new one.
    fn strain_curvature(
        &self,
        strain: &Components<H, S, D>,
        force: &[S; N],
    ) -> H::PerComponent<Components<H, S, D>> {
        let strain = tensor::<H, S, D>(strain);
        let between = Strains::<H, S, D>::of_strains([&strain, &strain]);
        let mut rows = H::PerComponent::filled(Components::<H, S, D>::filled(S::zero()));
        for (q, row) in rows.as_mut().iter_mut().enumerate() {
            let mut change = H::Tensor::<S>::filled(S::zero());
            change[q] = S::from_f64(2.0);
            let mut sum = H::Tensor::<S>::filled(S::zero());
            for (measure, &force) in self.measures.iter().zip(force) {
                let slope = between.slope(measure);
                let own = between.change_of_slope(measure, &slope, &change);
                add(&mut sum, force, &own);
            }
            *row = conjugates::<H, S, D>(&sum);
        }
        rows
    }
}
