//! Strain: its measures and their mean-value gradients.
//!
//! ```text
//! E = ½(FᵀF − 1),   j = i3/(1 + √(1 + i3)),   i3 = det C − 1
//! P:ΔE = Δπ exactly:   tr E: 1     E:E: E⁰ + E¹     j: 2 D/(J⁰ + J¹)     a·E a: a ⊗ a
//! ```
//!
//! with `D:ΔC = det C¹ − det C⁰`, `C = 1 + 2E`.

use core::marker::PhantomData;

use crate::element::kinematics::strain::Measure;
use eem_mesh::tensor::{Symmetric, Tensor, plus, scaled};

/// A deformation gradient with its strain.
#[derive(Clone, Copy, Debug)]
pub(super) struct Deformed<A, const D: usize> {
    tensor: Tensor<D>,
    strain: A,
}

/// Where E:E is below this limit, j is computed from E: then j and the other measures have the rounding of the same E, and
/// differences like `e1 − ln(1 + j)` keep their digits. Above it, j is computed from F: squares of E would lose digits of a
/// J that is small or comes with a large shear. At the limit both are accurate to ε.
const LARGE_SQUARE: f64 = 0.25;

impl<A: Symmetric<D>, const D: usize> Deformed<A, D> {
    #[inline]
    pub(super) fn new(tensor: Tensor<D>) -> Self {
        let strain = A::green_lagrange(&tensor);
        Self { tensor, strain }
    }

    /// E.
    pub(super) fn strain(&self) -> &A {
        &self.strain
    }

    /// A measure of its strain.
    #[inline]
    pub(super) fn measure(&self, of: &Measure<D>) -> f64 {
        match of {
            Measure::Dilatation => self.dilatation(),
            _ => of.of_strain(&self.strain),
        }
    }

    /// `J − 1`.
    #[inline]
    fn dilatation(&self) -> f64 {
        let of_strain = Measure::<D>::Dilatation.of_strain(&self.strain);
        let of_tensor = A::determinant(&self.tensor) - 1.0;
        let square = self.strain.contracted(&self.strain);
        let is_small = square < LARGE_SQUARE;
        if is_small { of_strain } else { of_tensor }
    }
}

impl<const D: usize> Measure<D> {
    /// The measure of a strain; j has the rounding of E.
    #[inline]
    pub(super) fn of_strain<A: Symmetric<D>>(&self, strain: &A) -> f64 {
        match self {
            Self::Trace => strain.trace(),
            Self::Square => strain.contracted(strain),
            Self::Dilatation => {
                let i3 = strain.growth();
                i3 / (1.0 + (1.0 + i3).sqrt())
            }
            Self::Fibre(along) => A::symmetrised(along, along).contracted(strain),
            Self::Component(k) => A::basis(*k).contracted(strain),
        }
    }
}

/// Two strains, and the sum of their `J = 1 + j`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Between<A, const D: usize> {
    /// `E⁰ + E¹`.
    sum: A,
    /// `E¹ − E⁰`.
    difference: A,
    /// `J⁰ + J¹`.
    volumes: f64,
    new: A,
    new_volume: f64,
    dimension: PhantomData<[(); D]>,
}

impl<A: Symmetric<D>, const D: usize> Between<A, D> {
    /// Two deformations.
    #[inline]
    pub(super) fn new(ends: [&Tensor<D>; 2]) -> Self {
        let [old, new] = ends.map(|tensor| Deformed::<A, D>::new(*tensor));
        let volumes = [&old, &new].map(|end| 1.0 + end.dilatation());
        Self::with_volumes([old.strain, new.strain], volumes)
    }

    /// Two strains, without deformation gradients.
    pub(super) fn of_strains(ends: [&A; 2]) -> Self {
        let volumes = ends.map(|strain| 1.0 + Measure::<D>::Dilatation.of_strain(strain));
        Self::with_volumes(ends.map(|strain| *strain), volumes)
    }

    /// The new strain at both ends.
    #[inline]
    pub(super) fn at_the_end(&self) -> Self {
        Self::with_volumes([self.new; 2], [self.new_volume; 2])
    }

    #[inline]
    fn with_volumes([old, new]: [A; 2], [old_volume, new_volume]: [f64; 2]) -> Self {
        Self {
            sum: plus(&old, 1.0, &new),
            difference: plus(&new, -1.0, &old),
            volumes: old_volume + new_volume,
            new,
            new_volume,
            dimension: PhantomData,
        }
    }

    /// P with `P:ΔE = Δπ`.
    #[inline]
    pub(super) fn slope(&self, measure: &Measure<D>) -> A {
        match measure {
            Measure::Trace => A::unit(),
            Measure::Square => self.sum,
            Measure::Dilatation => {
                let slope = A::slope_of_determinant(&self.sum, &self.difference);
                scaled(2.0 / self.volumes, &slope)
            }
            Measure::Fibre(along) => A::symmetrised(along, along),
            Measure::Component(k) => A::basis(*k),
        }
    }

    /// The change of a slope P with the new strain.
    #[inline]
    pub(super) fn change_of_slope(&self, measure: &Measure<D>, slope: &A, change: &A) -> A {
        match measure {
            Measure::Trace | Measure::Fibre(_) | Measure::Component(_) => A::filled(0.0),
            Measure::Square => *change,
            Measure::Dilatation => {
                let volume = self.new_slope_of_volume().contracted(change);
                let per_volume = self.volumes.recip();
                let mut total = A::change_of_slope(&self.sum, &self.difference, change);
                for (entry, &slope) in total.as_mut().iter_mut().zip(slope.as_ref()) {
                    *entry = per_volume * (2.0 * *entry - slope * volume);
                }
                total
            }
        }
    }

    /// `∂J/∂E = cof C/J` at the new strain.
    #[inline]
    fn new_slope_of_volume(&self) -> A {
        let twice = scaled(2.0, &self.new);
        scaled(self.new_volume.recip(), &twice.cofactor_of_one_plus())
    }
}
