//! The strain at a point of a cell of a solid.

use crate::algebra::vector;
use crate::element::kinematics::between::Between;
use crate::element::kinematics::strain::Measure;
use eem_material::free_energy::Array;
use eem_material::number::scalar::{Scalar, is_positive};
use eem_mesh::integrals::{functions, gauss, jacobian};
use eem_mesh::tensor::{Symmetric, Tensor, add, dot, pushed};
use eem_mesh::{Points, Shape};

/// N measures of the strain at one of the points of a cell of shape `H`, in plane strain or in space.
///
/// ```text
/// F = Σ r_i ⊗ B_i,   B_i = ∂N_i/∂X,   E = ½(FᵀF − 1)
/// D*π = F_m P B_i,   P:ΔE = Δπ
/// ```
///
/// with the edge vectors `r_i` from node 0 and shape functions `N_i`. A rotation of the body stores no energy, and the
/// forces have no torque because P is symmetric (Simó & Tarnow 1992; García Orden & Romero 2012).
///
/// ```
/// use eem::kinematics::{Kinematics, Measure, Quad4, SolidPoint};
///
/// let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
/// let measures = [Measure::Trace, Measure::Dilatation];
/// let points = SolidPoint::<Quad4, 2, 2>::points(&square, 1.0, measures);
/// let [first, ..] = points.unwrap();
///
/// // Twice as long: E₁₁ = (2² − 1)/2, J = 2.
/// let arms = [[2.0, 0.0], [2.0, 1.0], [0.0, 1.0]];
/// let [trace, dilatation] = first.measure(&arms);
/// assert!((trace - 1.5_f64).abs() < 1e-15 && (dilatation - 1.0).abs() < 1e-15);
/// assert!((first.volume() - 0.25_f64).abs() < 1e-15);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct SolidPoint<H: Shape<D>, const N: usize, const D: usize> {
    pub(super) measures: [Measure<D>; N],
    /// `B_i` of the arms, 1/m.
    pub(super) gradients: H::PerArm<[f64; D]>,
    /// w, m³.
    pub(super) volume: f64,
    /// The reciprocal of the largest `|B_i|`, m.
    pub(super) length: f64,
}

/// Vectors per arm.
pub(super) type PerArm<H, const D: usize> = <H as Shape<D>>::PerArm<[f64; D]>;

/// A block per pair of arms.
pub(super) type PerPair<H, const D: usize> =
    <H as Shape<D>>::PerArm<<H as Shape<D>>::PerArm<[[f64; D]; D]>>;

impl<H: Shape<D>, const N: usize, const D: usize> SolidPoint<H, N, D> {
    /// The points, in the order of the shape, of a cell with these reference positions of its nodes (m) and this thickness
    /// (m), which is one in three dimensions.
    ///
    /// # Errors
    ///
    /// The index of the first point at which the cell is inverted, with `det ∂X/∂ξ` there, m² or m³.
    pub fn points(
        reference: &H::PerNode<[f64; D]>,
        thickness: f64,
        measures: [Measure<D>; N],
    ) -> Result<H::PerPoint<Self>, (usize, f64)> {
        let mut inverted = None;
        let rule = gauss(H::PER_AXIS);
        let points = H::PerPoint::from_fn(|at| {
            let (place, weight) = rule[at];
            let functions = functions::<H, D>(place);
            let jacobian = jacobian(reference.as_ref(), &functions);
            let size = H::Tensor::determinant(&jacobian);
            if inverted.is_none() && !is_positive(size) {
                inverted = Some((at, size));
            }
            let mut point = Self {
                measures,
                gradients: H::PerArm::filled([0.0; D]),
                volume: weight * size * thickness,
                length: 0.0,
            };
            let cofactor = H::Tensor::cofactor(&jacobian);
            let slopes = functions[1..].iter();
            for (gradient, (_, slope)) in point.gradients.as_mut().iter_mut().zip(slopes) {
                *gradient = cofactor.map(|row| dot(&row, slope) / size);
            }
            point.length = point.steepest().recip();
            point
        });
        inverted.map_or(Ok(points), Err)
    }

    /// The largest `|B_i|` of all nodes, 1/m.
    fn steepest(&self) -> f64 {
        let size = |b: &[f64; D]| (1..D).fold(b[0], |size, axis| Scalar::hypot(size, b[axis]));
        let mut first = [0.0; D];
        let mut largest = 0.0;
        for gradient in self.gradients.as_ref() {
            largest = Scalar::maximum(largest, size(gradient));
            first = vector(|axis| first[axis] - gradient[axis]);
        }
        Scalar::maximum(largest, size(&first))
    }

    /// The volume that the point stands for, m³.
    #[must_use]
    pub fn volume(&self) -> f64 {
        self.volume
    }

    /// F.
    #[inline]
    pub(super) fn deformation(&self, r: &PerArm<H, D>) -> Tensor<D> {
        self.combined(r, |entry| entry)
    }

    /// The magnitude of the terms of F, `Σ |r_i| ⊗ |B_i|`.
    pub(super) fn terms_of_deformation(&self, r: &PerArm<H, D>) -> Tensor<D> {
        self.combined(r, f64::abs)
    }

    /// `Σ r_i ⊗ B_i` of functions of the entries of both.
    #[inline]
    fn combined(&self, r: &PerArm<H, D>, of: impl Fn(f64) -> f64) -> Tensor<D> {
        let mut sum = [[0.0; D]; D];
        for (arm, gradient) in r.as_ref().iter().zip(self.gradients.as_ref()) {
            for (row, &component) in sum.iter_mut().zip(arm) {
                for (entry, &slope) in row.iter_mut().zip(gradient) {
                    *entry += of(component) * of(slope);
                }
            }
        }
        sum
    }

    /// `F A B_i` of all arms.
    #[inline]
    pub(super) fn pulled(&self, tensor: &Tensor<D>, by: &H::Tensor) -> PerArm<H, D> {
        let mut pulled = self.gradients;
        for b in pulled.as_mut() {
            *b = pushed(tensor, &by.applied(b));
        }
        pulled
    }

    /// The magnitude of `F A B_i`, given that of the terms of F and of A.
    pub(super) fn size_of_pull(&self, terms: &Tensor<D>, by: &H::Tensor) -> f64 {
        let mut steepness = [0.0; D];
        for (sum, b) in (0..D).cycle().zip(self.gradients.as_ref().as_flattened()) {
            steepness[sum] += b.abs();
        }
        let sizes = pushed(terms, &by.applied(&steepness));
        sizes.iter().fold(0.0, |sum, &size| sum + size)
    }

    /// `F P B_i` of each measure.
    #[inline]
    pub(super) fn along(&self, tensor: &Tensor<D>, between: &Strains<H, D>) -> [PerArm<H, D>; N] {
        let slope = |measure| between.slope(measure);
        self.measures
            .each_ref()
            .map(|measure| self.pulled(tensor, &slope(measure)))
    }

    /// `Σ_a f_a P_a`.
    #[inline]
    pub(super) fn stress(&self, between: &Strains<H, D>, force: &[f64; N]) -> H::Tensor {
        let mut stress = H::Tensor::filled(0.0);
        for (measure, &force) in self.measures.iter().zip(force) {
            add(&mut stress, force, &between.slope(measure));
        }
        stress
    }

    /// `B_i·S B_j` of all pairs of arms.
    #[inline]
    pub(super) fn stiffness_of(&self, stress: &H::Tensor) -> H::PerArm<H::PerArm<f64>> {
        let mut weights = H::PerArm::filled(H::PerArm::filled(0.0));
        for (row, b) in weights.as_mut().iter_mut().zip(self.gradients.as_ref()) {
            let pulled = stress.applied(b);
            for (weight, by) in row.as_mut().iter_mut().zip(self.gradients.as_ref()) {
                *weight = dot(by, &pulled);
            }
        }
        weights
    }
}

/// Deformations and strains of a cell between two states.
#[derive(Clone, Copy, Debug)]
pub struct Deformations<H: Shape<D>, const D: usize> {
    /// In the middle.
    pub(super) mean: Tensor<D>,
    pub(super) new: Tensor<D>,
    pub(super) strains: Strains<H, D>,
}

/// Two strains of a cell.
pub(super) type Strains<H, const D: usize> = Between<<H as Shape<D>>::Tensor, D>;
