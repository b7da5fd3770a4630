//! The strain E at a point of a solid as components, and its measures as functions of them.
//!
//! Conjugates of components are `n_q = w_q S_q`, where w is 1 for normal components and 2 for shears, so that
//! `Σ n_q E_q = S:E`.

use core::marker::PhantomData;

use crate::element::error::StateError;
use crate::element::handle::Element;
use crate::element::kinematics::measures::{QuadraticStrain, StrainMeasures, StrainSet};
use crate::element::kinematics::solid::{PerArm, SolidPoint, Strains};
use crate::element::kinematics::strain::Measure;
use eem_material::free_energy::{Array, Entry};
use eem_material::number::scalar::is_positive;
use eem_mesh::Shape;
use eem_mesh::tensor::{Symmetric, add};

type Components<H, const D: usize> = <H as Shape<D>>::PerComponent<f64>;

/// N measures as functions of the strain at a point of a cell of shape `H`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SolidStrain<H, const N: usize, const D: usize> {
    measures: [Measure<D>; N],
    shape: PhantomData<H>,
}

/// Components as another type of the same length; those of shears are multiplied by a factor.
#[inline]
fn converted<A: Array<f64>, B: Array<f64>, const D: usize>(from: &A, of_shears: f64) -> B {
    let mut to = B::filled(of_shears);
    for (index, (to, &from)) in to.as_mut().iter_mut().zip(from.as_ref()).enumerate() {
        *to = if index < D { from } else { *to * from };
    }
    to
}

/// Components of a strain as a tensor.
#[inline]
fn tensor<H: Shape<D>, const D: usize>(strain: &Components<H, D>) -> H::Tensor {
    converted::<_, _, D>(strain, 1.0)
}

/// The conjugates of components that go with a tensor.
#[inline]
fn conjugates<H: Shape<D>, const D: usize>(by: &H::Tensor) -> Components<H, D> {
    converted::<_, _, D>(by, 2.0)
}

/// The tensor that goes with conjugates of components.
#[inline]
fn stress<H: Shape<D>, const D: usize>(n: &Components<H, D>) -> H::Tensor {
    converted::<_, _, D>(n, 0.5)
}

impl<H: Shape<D>, const N: usize, const D: usize> QuadraticStrain<D> for SolidPoint<H, N, D> {
    type Strain = SolidStrain<H, N, D>;

    #[inline]
    fn strain_measures(&self) -> Self::Strain {
        SolidStrain {
            measures: self.measures,
            shape: PhantomData,
        }
    }

    #[inline]
    fn strain(&self, r: &PerArm<H, D>) -> Components<H, D> {
        let strain = H::Tensor::green_lagrange(&self.deformation(r));
        converted::<_, _, D>(&strain, 1.0)
    }

    // Ė = sym(FᵀḞ)
    #[inline]
    fn strain_rate(&self, r: &PerArm<H, D>, w: &PerArm<H, D>) -> Components<H, D> {
        let [rows, moved] = [r, w].map(|arms| self.deformation(arms));
        let mut rate = H::Tensor::filled(0.0);
        for (row, moved) in rows.iter().zip(&moved) {
            add(&mut rate, 1.0, &H::Tensor::symmetrised(row, moved));
        }
        converted::<_, _, D>(&rate, 1.0)
    }

    #[inline]
    fn strain_force(&self, r: &PerArm<H, D>, n: &Components<H, D>) -> PerArm<H, D> {
        self.pulled(&self.deformation(r), &stress::<H, D>(n))
    }

    fn strain_force_size(&self, r: &PerArm<H, D>, n: &Components<H, D>) -> f64 {
        self.size_of_pull(&self.terms_of_deformation(r), &stress::<H, D>(n))
    }

    #[inline]
    fn strain_stiffness(&self, n: &Components<H, D>) -> H::PerArm<H::PerArm<f64>> {
        self.stiffness_of(&stress::<H, D>(n))
    }
}

impl<H: Shape<D>, const N: usize, const D: usize> StrainMeasures for SolidStrain<H, N, D> {
    type Measures = StrainSet<N>;
    type PerStrain<T: Entry> = H::PerComponent<T>;

    // ½ tr FᵀF + ½ = tr E + ½(D + 1) bounds the terms ½FᵀF and ½ of every component.
    #[inline]
    fn sizes(&self, strain: &Components<H, D>) -> Components<H, D> {
        let ones = (0..D).fold(1.0, |sum, _| sum + 1.0);
        let trace = tensor::<H, D>(strain).trace();
        Components::<H, D>::filled(trace + 0.5 * ones)
    }

    #[inline]
    fn metric(&self, _: &Components<H, D>) -> (Components<H, D>, f64) {
        let ones = H::Tensor::filled(1.0);
        (conjugates::<H, D>(&ones), 1.0)
    }

    #[inline]
    fn measures_of(&self, strain: &Components<H, D>) -> Option<[f64; N]> {
        let strain = tensor::<H, D>(strain);
        is_positive(1.0 + strain.growth())
            .then(|| self.measures.each_ref().map(|of| of.of_strain(&strain)))
    }

    #[cold]
    fn refuse(&self, element: Element, strain: &Components<H, D>) -> StateError {
        let square = 1.0 + tensor::<H, D>(strain).growth();
        StateError::Path {
            element,
            quantity: "squared volume ratio",
            value: square,
            unit: "",
        }
    }

    fn slopes(&self, [old, new]: [&Components<H, D>; 2]) -> [Components<H, D>; N] {
        let [old, new] = [old, new].map(tensor::<H, D>);
        let between = Strains::<H, D>::of_strains([&old, &new]);
        let slopes = self.measures.each_ref();
        slopes.map(|measure| conjugates::<H, D>(&between.slope(measure)))
    }

    // The change of P with both ends is twice that with the new one.
    fn curvature(
        &self,
        strain: &Components<H, D>,
        force: &[f64; N],
    ) -> H::PerComponent<Components<H, D>> {
        let strain = tensor::<H, D>(strain);
        let between = Strains::<H, D>::of_strains([&strain, &strain]);
        let mut rows = H::PerComponent::filled(Components::<H, D>::filled(0.0));
        for (q, row) in rows.as_mut().iter_mut().enumerate() {
            let mut change = H::Tensor::filled(0.0);
            change[q] = 2.0;
            let mut sum = H::Tensor::filled(0.0);
            for (measure, &force) in self.measures.iter().zip(force) {
                let slope = between.slope(measure);
                let own = between.change_of_slope(measure, &slope, &change);
                add(&mut sum, force, &own);
            }
            *row = conjugates::<H, D>(&sum);
        }
        rows
    }
}
