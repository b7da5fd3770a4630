//! The strain E at a point of a solid as components, and its measures as functions of them.
//!
//! Conjugates of components are `n_q = w_q S_q`, where w is 1 for normal components and 2 for shears, so that
//! `Σ n_q E_q = S:E`.

use crate::element::error::StateError;
use crate::element::handle::Element;
use crate::element::kinematics::measures::QuadraticStrain;
use crate::element::kinematics::solid::{PerArm, SolidPoint, Strains};
use eem_material::free_energy::{Array, Entry};
use eem_material::number::scalar::{Real, is_positive};
use eem_mesh::Shape;
use eem_mesh::tensor::{Symmetric, add};

type Components<H, S, const D: usize> = <H as Shape<D>>::PerComponent<S>;

/// Components as another type of the same length; those of shears are multiplied by a factor.
#[inline]
fn converted<A: Array<S>, B: Array<S>, S: Real, const D: usize>(from: &A, of_shears: f64) -> B {
    let mut to = B::filled(S::from_f64(of_shears));
    for (index, (to, &from)) in to.as_mut().iter_mut().zip(from.as_ref()).enumerate() {
        *to = if index < D { from } else { *to * from };
    }
    to
}

/// Components of a strain as a tensor.
#[inline]
fn tensor<H: Shape<D>, S: Real, const D: usize>(strain: &Components<H, S, D>) -> H::Tensor<S> {
    converted::<_, _, S, D>(strain, 1.0)
}

/// The conjugates of components that go with a tensor.
#[inline]
fn conjugates<H: Shape<D>, S: Real, const D: usize>(by: &H::Tensor<S>) -> Components<H, S, D> {
    converted::<_, _, S, D>(by, 2.0)
}

/// The tensor that goes with conjugates of components.
#[inline]
fn stress<H: Shape<D>, S: Real, const D: usize>(n: &Components<H, S, D>) -> H::Tensor<S> {
    converted::<_, _, S, D>(n, 0.5)
}

impl<H: Shape<D>, S: Real, const N: usize, const D: usize> QuadraticStrain<S, D>
    for SolidPoint<H, S, N, D>
{
    type PerStrain<T: Entry> = H::PerComponent<T>;

    #[inline]
    fn strain(&self, r: &PerArm<H, S, D>) -> Components<H, S, D> {
        let strain = H::Tensor::green_lagrange(&self.deformation(r));
        converted::<_, _, S, D>(&strain, 1.0)
    }

    // Ė = sym(FᵀḞ)
    #[inline]
    fn strain_rate(&self, r: &PerArm<H, S, D>, w: &PerArm<H, S, D>) -> Components<H, S, D> {
        let [rows, moved] = [r, w].map(|arms| self.deformation(arms));
        let mut rate = H::Tensor::<S>::filled(S::zero());
        for (row, moved) in rows.iter().zip(&moved) {
            add(&mut rate, S::one(), &H::Tensor::symmetrised(row, moved));
        }
        converted::<_, _, S, D>(&rate, 1.0)
    }

    #[inline]
    fn strain_force(&self, r: &PerArm<H, S, D>, n: &Components<H, S, D>) -> PerArm<H, S, D> {
        self.pulled(&self.deformation(r), &stress::<H, S, D>(n))
    }

    fn strain_force_size(&self, r: &PerArm<H, S, D>, n: &Components<H, S, D>) -> S {
        self.size_of_pull(&self.terms_of_deformation(r), &stress::<H, S, D>(n))
    }

    #[inline]
    fn strain_stiffness(&self, n: &Components<H, S, D>) -> H::PerArm<H::PerArm<S>> {
        self.stiffness_of(&stress::<H, S, D>(n))
    }

    // ½ tr FᵀF + ½ = tr E + ½(D + 1) bounds the terms ½FᵀF and ½ of every component.
    #[inline]
    fn strain_sizes(&self, strain: &Components<H, S, D>) -> Components<H, S, D> {
        let ones = (0..D).fold(S::one(), |sum, _| sum + S::one());
        let trace = tensor::<H, S, D>(strain).trace();
        Components::<H, S, D>::filled(trace + S::from_f64(0.5) * ones)
    }

    #[inline]
    fn strain_metric(&self, _: &Components<H, S, D>) -> (Components<H, S, D>, S) {
        let ones = H::Tensor::filled(S::one());
        (conjugates::<H, S, D>(&ones), S::one())
    }

    #[inline]
    fn measures_of(&self, strain: &Components<H, S, D>) -> Option<[S; N]> {
        let strain = tensor::<H, S, D>(strain);
        is_positive(S::one() + strain.growth())
            .then(|| self.measures.each_ref().map(|of| of.of_strain(&strain)))
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
