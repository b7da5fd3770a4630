//! The strain at a point of a quadrilateral of four nodes, in the plane.

use core::array;

use crate::element::error::StateError;
use crate::element::handle::Element;
use crate::element::kinematics::bilinear::{gauss, jacobian, shapes};
use crate::element::kinematics::measures::{Ends, Kinematics};
use crate::element::kinematics::plane::{
    Between, Deformed, Symmetric, Tensor, applied, contracted, determinant, pushed, symmetrised,
};
use crate::element::kinematics::strain::Strain;
use crate::material::free_energy::Entry;
use crate::number::scalar::{Mask, Real};

/// N measures of the strain at one of the four points of a quadrilateral, in plane strain.
///
/// ```text
/// F = Σ r_i ⊗ B_i,   B_i = ∂N_i/∂X,   E = ½(FᵀF − 1)
/// D*π = F_m P B_i,   P:ΔE = Δπ
/// ```
///
/// with the arms `r_i`, bilinear shape functions `N_i` and two Gauss points per axis, of which the
/// first coordinate runs fastest. A turn of the body stores nothing, and the torque of the forces is
/// zero, as P is symmetric (Simó & Tarnow 1992; García Orden & Romero 2012).
///
/// ```
/// use eem::kinematics::{Kinematics, Quad4, Strain};
///
/// let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
/// let [first, ..] = Quad4::points(&square, 1.0, [Strain::Trace, Strain::Dilatation]).unwrap();
///
/// // Twice as long: E₁₁ = (2² − 1)/2, J = 2.
/// let arms = [[2.0, 0.0], [2.0, 1.0], [0.0, 1.0]];
/// let [trace, dilatation] = first.measure(&arms);
/// assert!((trace - 1.5_f64).abs() < 1e-15 && (dilatation - 1.0).abs() < 1e-15);
/// assert!((first.volume() - 0.25_f64).abs() < 1e-15);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Quad4<S, const N: usize> {
    strains: [Strain; N],
    /// `B_i` of the arms, 1/m.
    gradients: [[S; 2]; 3],
    /// w, m³.
    volume: S,
    /// The reciprocal of the largest `|B_i|`, m.
    length: S,
}

impl<S: Real, const N: usize> Quad4<S, N> {
    /// The points of a quadrilateral with these corners (m), against the clock, and thickness (m).
    ///
    /// # Errors
    ///
    /// The index of the first point at which it is inside out, with `det ∂X/∂ξ` there, m².
    pub fn points(
        reference: &[[S; 2]; 4],
        thickness: S,
        strains: [Strain; N],
    ) -> Result<[Self; 4], (usize, S)> {
        let third = S::one() / S::from_f64(3.0);
        let root = third.sqrt();
        let mut points = [Self {
            strains,
            gradients: [[S::zero(); 2]; 3],
            volume: S::zero(),
            length: S::zero(),
        }; 4];
        let rule = gauss([-root, root], [S::one(); 2]);
        for (at, (point, (place, weight))) in points.iter_mut().zip(rule).enumerate() {
            let shapes = shapes(place);
            let jacobian = jacobian(reference, &shapes);
            let area = determinant(&jacobian);
            if !S::zero().less(area).all() || !area.is_finite() {
                return Err((at, area));
            }
            let [[xx, xy], [yx, yy]] = jacobian;
            for (gradient, (_, [x, y])) in point.gradients.iter_mut().zip(&shapes[1..]) {
                *gradient = [(yy * *x - yx * *y) / area, (xx * *y - xy * *x) / area];
            }
            point.volume = weight * area * thickness;
            point.length = point.steepest().recip();
        }
        Ok(points)
    }

    /// The largest `|B_i|` of all nodes, 1/m.
    fn steepest(&self) -> S {
        let mut first = [S::zero(); 2];
        let mut largest = S::zero();
        for gradient in &self.gradients {
            largest = largest.maximum(gradient[0].hypot(gradient[1]));
            first = array::from_fn(|axis| first[axis] - gradient[axis]);
        }
        largest.maximum(first[0].hypot(first[1]))
    }

    /// The volume that the point stands for, m³.
    #[must_use]
    pub fn volume(&self) -> S {
        self.volume
    }

    /// F.
    #[inline]
    fn deformation(&self, r: &[[S; 2]; 3]) -> Tensor<S> {
        let mut tensor = [[S::zero(); 2]; 2];
        for (arm, gradient) in r.iter().zip(&self.gradients) {
            for (row, &component) in tensor.iter_mut().zip(arm) {
                for (entry, &slope) in row.iter_mut().zip(gradient) {
                    *entry += component * slope;
                }
            }
        }
        tensor
    }

    /// `F P B_i` of each measure.
    #[inline]
    fn along(&self, tensor: &Tensor<S>, between: &Between<S>) -> [[[S; 2]; 3]; N] {
        self.strains.map(|strain| {
            let slope = between.slope(strain);
            self.gradients.map(|b| pushed(tensor, &applied(&slope, &b)))
        })
    }

    /// `Σ_a f_a P_a`.
    #[inline]
    fn stress(&self, between: &Between<S>, force: &[S; N]) -> Symmetric<S> {
        let mut stress = [S::zero(); 3];
        for (&strain, &force) in self.strains.iter().zip(force) {
            add(&mut stress, force, &between.slope(strain));
        }
        stress
    }

    /// `Σ_a f_a (share (B_i·P_a B_j) 1 + F ∂P_a B_i)` with the change ∂P by a new deformation.
    #[inline]
    fn turned(
        &self,
        [tensor, new]: [&Tensor<S>; 2],
        between: &Between<S>,
        force: &[S; N],
        share: S,
    ) -> [[[[S; 2]; 2]; 3]; 3] {
        let slopes = self.strains.map(|strain| between.slope(strain));
        let stress = self.stress(between, force);
        let mut blocks = [[[[S::zero(); 2]; 2]; 3]; 3];
        for (j, by) in self.gradients.iter().enumerate() {
            for axis in 0..2 {
                let change = symmetrised(&new[axis], by);
                let mut turn = [S::zero(); 3];
                for ((&strain, slope), &force) in self.strains.iter().zip(&slopes).zip(force) {
                    let own = between.change_of_slope(strain, slope, &change);
                    add(&mut turn, force, &own);
                }
                for (i, b) in self.gradients.iter().enumerate() {
                    let pull = pushed(tensor, &applied(&turn, b));
                    for (row, &pull) in blocks[i][j].iter_mut().zip(&pull) {
                        row[axis] += pull;
                    }
                }
            }
            let pulled = applied(&stress, by);
            for (i, b) in self.gradients.iter().enumerate() {
                let along = share * (b[0] * pulled[0] + b[1] * pulled[1]);
                for (axis, row) in blocks[i][j].iter_mut().enumerate() {
                    row[axis] += along;
                }
            }
        }
        blocks
    }

    /// The deformations at the ends and in the middle, and the strains.
    #[inline]
    fn between(&self, ends: &Ends<Self, S, 2>) -> ([Tensor<S>; 2], Between<S>) {
        let [old, new] = [&ends.r0, &ends.r1].map(|r| self.deformation(r));
        let half = S::from_f64(0.5);
        let mean = array::from_fn(|i| array::from_fn(|j| half * (old[i][j] + new[i][j])));
        ([mean, new], Between::new([&old, &new]))
    }
}

/// `sum += factor tensor`.
#[inline]
fn add<S: Real>(sum: &mut Symmetric<S>, factor: S, tensor: &Symmetric<S>) {
    for (sum, &entry) in sum.iter_mut().zip(tensor) {
        *sum += factor * entry;
    }
}

impl<S: Real, const N: usize> Kinematics<S, 2> for Quad4<S, N> {
    type PerNode<T: Entry> = [T; 4];
    type PerArm<T: Entry> = [T; 3];
    type PerMeasure<T: Entry> = [T; N];
    type PerPoint<T: Send + Sync> = [T; 4];

    const IS_SPRING: bool = false;
    const VISCOUS_UNIT: &'static str = "";
    const VISCOSITY_UNIT: &'static str = "J s";

    #[inline]
    fn is_admissible(&self, r: &[[S; 2]; 3], measures: &[S; N]) -> bool {
        let volume = determinant(&self.deformation(r));
        S::zero().less(volume).all() && measures.iter().all(|measure| measure.is_finite())
    }

    #[cold]
    fn refusal(&self, element: Element, r: &[[S; 2]; 3]) -> StateError {
        StateError::InsideOut {
            element,
            value: determinant(&self.deformation(r)).to_f64(),
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
    fn sizes(&self, r: &[[S; 2]; 3], _: &[S; N]) -> [S; N] {
        let tensor = self.deformation(r);
        let between = Between::new([&tensor, &tensor]);
        let squares = tensor.iter().flatten();
        let square = squares.fold(S::one(), |sum, &entry| sum + entry * entry);
        let size = S::from_f64(0.5) * square;
        self.strains.map(|strain| {
            let slope = between.slope(strain).map(S::abs);
            contracted(&slope, &[size; 3])
        })
    }

    fn slopes(&self, r: &[[S; 2]; 3], measures: &[S; N]) -> [S; N] {
        let gradient = self.gradient(r, measures);
        gradient.map(|arms| {
            let entries = arms.iter().flatten();
            entries.fold(S::zero(), |sum, entry| sum + entry.abs())
        })
    }

    fn numbers(&self, see: &mut dyn FnMut(S)) {
        see(self.volume);
        self.gradients
            .iter()
            .flatten()
            .for_each(|&entry| see(entry));
    }

    #[inline]
    fn measure(&self, r: &[[S; 2]; 3]) -> [S; N] {
        let deformed = Deformed::new(self.deformation(r));
        self.strains.map(|of| deformed.measure(of))
    }

    #[inline]
    fn gradient(&self, r: &[[S; 2]; 3], _: &[S; N]) -> [[[S; 2]; 3]; N] {
        let tensor = self.deformation(r);
        self.along(&tensor, &Between::new([&tensor, &tensor]))
    }

    // The change of P with both ends is twice that with the new one.
    fn curvature(&self, r: &[[S; 2]; 3], _: &[S; N], force: &[S; N]) -> [[[[S; 2]; 2]; 3]; 3] {
        let two = S::from_f64(2.0);
        let tensor = self.deformation(r);
        let between = Between::new([&tensor, &tensor]);
        let doubled = tensor.map(|row| row.map(|entry| two * entry));
        self.turned([&doubled, &tensor], &between, force, S::one())
    }

    #[inline]
    fn discrete_gradient(&self, ends: &Ends<Self, S, 2>) -> [[[S; 2]; 3]; N] {
        let ([mean, _], between) = self.between(ends);
        self.along(&mean, &between)
    }

    #[inline]
    fn pull(&self, ends: &Ends<Self, S, 2>, _: &[[[S; 2]; 3]; N], force: &[S; N]) -> [[S; 2]; 3] {
        let ([mean, _], between) = self.between(ends);
        let stress = self.stress(&between, force);
        self.gradients.map(|b| pushed(&mean, &applied(&stress, &b)))
    }

    fn discrete_tangent(
        &self,
        ends: &Ends<Self, S, 2>,
        force: &[S; N],
        force_by_arm: &[[[S; 2]; 3]; N],
    ) -> [[[[S; 2]; 2]; 3]; 3] {
        let ([mean, new], between) = self.between(ends);
        let mut blocks = self.turned([&mean, &new], &between, force, S::from_f64(0.5));
        for (direction, by_arm) in self.along(&mean, &between).iter().zip(force_by_arm) {
            for (blocks, along) in blocks.iter_mut().zip(direction) {
                for (block, by) in blocks.iter_mut().zip(by_arm) {
                    for (row, &along) in block.iter_mut().zip(along) {
                        for (entry, &by) in row.iter_mut().zip(by) {
                            *entry += along * by;
                        }
                    }
                }
            }
        }
        blocks
    }

    // Σ f F_m P B_i = Σ_j (B_i·S* B_j) r_m,j
    fn secant(&self, ends: &Ends<Self, S, 2>, force: &[S; N]) -> [[S; 3]; 3] {
        let (_, between) = self.between(ends);
        let stress = self.stress(&between, force);
        self.gradients.map(|b| {
            let pulled = applied(&stress, &b);
            self.gradients
                .map(|by| by[0] * pulled[0] + by[1] * pulled[1])
        })
    }
}
