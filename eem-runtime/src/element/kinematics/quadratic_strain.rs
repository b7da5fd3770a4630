//! The strain C of an element: what is quadratic in its arms and decides its measures.
//!
//! ```text
//! spring    C = λ² = r·r             solid    C = E = ½(FᵀF − 1), component by component
//! Ċ = ∂C/∂r·ṙ                        bilinear in arms and velocities
//! ```
//!
//! A path of C through a step, with Ċ from the arms at Gauss points, ends at the strain of the new arms exactly.

use super::measures::{Arms, Kinematics, Measures, Weights};
use crate::element::error::StateError;
use crate::element::handle::Element;
use eem_material::free_energy::{Array, Entry};
use eem_material::number::scalar::Real;

/// A number per component of the strain C.
pub(crate) type PerStrain<K, S, const D: usize> = <K as QuadraticStrain<S, D>>::PerStrain<S>;

/// Derivatives of measures by the strain.
pub(crate) type StrainSlopes<K, S, const D: usize> =
    <K as Kinematics<S, D>>::PerMeasure<PerStrain<K, S, D>>;

/// A square matrix of the components of the strain.
pub(crate) type StrainMatrix<K, S, const D: usize> =
    <K as QuadraticStrain<S, D>>::PerStrain<PerStrain<K, S, D>>;

/// Measures as functions of a strain C that is quadratic in the arms.
pub(crate) trait QuadraticStrain<S: Real, const D: usize>: Kinematics<S, D> {
    /// `[T; number of components]`.
    type PerStrain<T: Entry>: Array<T>;

    /// C of these arms.
    fn strain(&self, r: &Arms<Self, S, D>) -> PerStrain<Self, S, D>;

    /// `∂C/∂r·w`, bilinear in r and w.
    fn strain_rate(&self, r: &Arms<Self, S, D>, w: &Arms<Self, S, D>) -> PerStrain<Self, S, D>;

    /// `Σ n_q ∂C_q/∂r`, linear in r.
    fn strain_force(&self, r: &Arms<Self, S, D>, n: &PerStrain<Self, S, D>) -> Arms<Self, S, D>;

    /// The magnitude of the terms of [`strain_force`](Self::strain_force), given that of n.
    fn strain_force_size(&self, r: &Arms<Self, S, D>, n: &PerStrain<Self, S, D>) -> S;

    /// `Σ n_q ∂²C_q/∂r²`.
    fn strain_stiffness(&self, n: &PerStrain<Self, S, D>) -> Weights<Self, S, D>;

    /// The magnitude of the terms of each component of a strain.
    fn strain_sizes(&self, strain: &PerStrain<Self, S, D>) -> PerStrain<Self, S, D>;

    /// How often each component counts in the square of a strain, and the unit of the strain.
    fn strain_metric(&self, strain: &PerStrain<Self, S, D>) -> (PerStrain<Self, S, D>, S);

    /// The measures of a strain; none if no deformation has it.
    fn measures_of(&self, strain: &PerStrain<Self, S, D>) -> Option<Measures<Self, S, D>>;

    /// Why an element cannot have this strain within a step.
    fn refuse(&self, element: Element, strain: &PerStrain<Self, S, D>) -> StateError;

    /// P with `P·(C¹ − C⁰) = π¹ − π⁰` exactly, symmetric in both.
    fn strain_slopes(&self, ends: [&PerStrain<Self, S, D>; 2]) -> StrainSlopes<Self, S, D>;

    /// `Σ_a f_a ∂²π_a/∂C²`.
    fn strain_curvature(
        &self,
        strain: &PerStrain<Self, S, D>,
        force: &Measures<Self, S, D>,
    ) -> StrainMatrix<Self, S, D>;
}
