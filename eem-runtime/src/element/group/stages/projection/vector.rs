//! Vectors and matrices over the variables `y = (C…, γ…, s)` of the path of a point, and the derivatives of the energies
//! `e(π, γ, s)` and `ê(C, γ, s)`.
//!
//! ```text
//! e_x = ψ_x,   e_s = θ,   e_xy = ψ_xy − ψ_xθ ψ_yθ/ψ_θθ,   e_xs = −ψ_xθ/ψ_θθ,   e_ss = −1/ψ_θθ
//! ê_C = P e_π,   ê_CC = P e_ππ Pᵀ + Σ e_π ∂²π/∂C²,   ê_Cx = P e_πx,   P = ∂π/∂C
//! ```

use core::ops::{Index, IndexMut, Range};

use crate::element::group::arms::measures_in;
use crate::element::kinematics::{PerStrain, StrainMatrix, StrainMeasures, StrainSlopes};
use eem_material::arrays::Arrays;
use eem_material::free_energy::Array;
use eem_material::number::scalar::Scalar;

/// A number per variable.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Vector<A: Arrays, G: StrainMeasures> {
    /// Of the components of the strain.
    pub(crate) strain: PerStrain<G>,
    /// Of γ and s, at their indices among the variables of the model, whose measures are ignored.
    pub(super) rest: A::Variables,
}

/// A number per two variables.
#[derive(Clone, Copy, Debug)]
pub(super) struct Matrix<A: Arrays, G: StrainMeasures> {
    strains: StrainMatrix<G>,
    /// Rows of the strain, columns of the rest; and rows of the rest, columns of the strain, stored transposed.
    right: G::PerStrain<A::Variables>,
    below: G::PerStrain<A::Variables>,
    rest: A::Hessian,
}

impl<A: Arrays, G: StrainMeasures> Vector<A, G> {
    /// Number of components of the strain.
    pub(super) const STRAINS: usize = <PerStrain<G> as Array<f64>>::LEN;
    /// Number of variables.
    pub(super) const LEN: usize = Self::STRAINS + A::DASHPOTS + A::THERMAL as usize;
    /// The index of the entropy.
    pub(super) const ENTROPY: usize = Self::STRAINS + A::DASHPOTS;

    pub(super) fn zero() -> Self {
        Self {
            strain: PerStrain::<G>::filled(0.0),
            rest: A::Variables::filled(0.0),
        }
    }

    pub(super) fn dot(&self, other: &Self) -> f64 {
        let mut sum = 0.0;
        for index in 0..Self::LEN {
            sum += self[index] * other[index];
        }
        sum
    }

    /// The sum of all entries.
    pub(super) fn sum(&self) -> f64 {
        let mut sum = 0.0;
        for index in 0..Self::LEN {
            sum += self[index];
        }
        sum
    }

    /// The variables of the model with these γ, and the given measures and temperature.
    pub(super) fn variables(&self, measures: &[f64], theta: f64) -> A::Variables {
        let mut x = self.rest;
        x.as_mut()[..A::MEASURES].copy_from_slice(measures);
        if A::THERMAL {
            x[A::MEASURES + A::DASHPOTS] = theta;
        }
        x
    }
}

/// The sum of some numbers.
pub(super) fn sum_of(numbers: &[f64]) -> f64 {
    numbers.iter().fold(0.0, |sum, number| sum + number)
}

impl<A: Arrays, G: StrainMeasures> Matrix<A, G> {
    pub(super) fn zero() -> Self {
        let zeros = A::Variables::filled(0.0);
        Self {
            strains: G::PerStrain::filled(PerStrain::<G>::filled(0.0)),
            right: G::PerStrain::filled(zeros),
            below: G::PerStrain::filled(zeros),
            rest: A::Hessian::filled(zeros),
        }
    }

    #[inline]
    pub(super) fn at(&self, [row, column]: [usize; 2]) -> f64 {
        let strains = Vector::<A, G>::STRAINS;
        match (row.checked_sub(strains), column.checked_sub(strains)) {
            (None, None) => self.strains[row][column],
            (None, Some(beyond)) => self.right[row][A::MEASURES + beyond],
            (Some(beyond), None) => self.below[column][A::MEASURES + beyond],
            (Some(row), Some(column)) => self.rest[A::MEASURES + row][A::MEASURES + column],
        }
    }

    #[inline]
    pub(super) fn at_mut(&mut self, [row, column]: [usize; 2]) -> &mut f64 {
        let strains = Vector::<A, G>::STRAINS;
        match (row.checked_sub(strains), column.checked_sub(strains)) {
            (None, None) => &mut self.strains[row][column],
            (None, Some(beyond)) => &mut self.right[row][A::MEASURES + beyond],
            (Some(beyond), None) => &mut self.below[column][A::MEASURES + beyond],
            (Some(row), Some(column)) => &mut self.rest[A::MEASURES + row][A::MEASURES + column],
        }
    }
}

impl<A: Arrays, G: StrainMeasures> Index<usize> for Vector<A, G> {
    type Output = f64;

    #[inline]
    fn index(&self, index: usize) -> &f64 {
        match index.checked_sub(Self::STRAINS) {
            None => &self.strain[index],
            Some(beyond) => &self.rest[A::MEASURES + beyond],
        }
    }
}

impl<A: Arrays, G: StrainMeasures> IndexMut<usize> for Vector<A, G> {
    #[inline]
    fn index_mut(&mut self, index: usize) -> &mut f64 {
        match index.checked_sub(Self::STRAINS) {
            None => &mut self.strain[index],
            Some(beyond) => &mut self.rest[A::MEASURES + beyond],
        }
    }
}

/// The last variable of the energy of a point.
#[derive(Clone, Copy, Debug)]
pub(super) enum Last {
    /// There is no temperature.
    Absent,
    Entropy,
    /// The temperature, which is given at all times.
    Temperature,
}

/// `∇ê` and `∇²ê` with respect to `(C, γ, s)` from the derivatives of ψ with respect to `x = (π, γ, θ)`. If the temperature
/// is given, `∇ψ` with respect to `(C, γ)` and θ, which depends on none of them.
pub(super) fn derivatives<A: Arrays, G: StrainMeasures>(
    measures: &G,
    strain: &PerStrain<G>,
    of_model: (&A::Variables, &A::Variables, &A::Hessian),
    last: Last,
) -> (Vector<A, G>, Matrix<A, G>) {
    let (first, second) = match last {
        Last::Absent => (*of_model.1, *of_model.2),
        Last::Entropy => by_entropy::<A>(of_model),
        Last::Temperature => at_given_temperature::<A>(of_model),
    };
    let along = measures.slopes([strain, strain]);
    let slopes = Vector {
        strain: chained::<G>(&along, first.as_ref()),
        rest: first,
    };
    let mut curvatures = Matrix::zero();
    let geometric = measures.curvature(strain, &measures_in::<G::Measures>(&first));
    let strains = Vector::<A, G>::STRAINS;
    for column in 0..A::Variables::LEN {
        let by_strain = chained::<G>(&along, second[column].as_ref());
        for (q, &by) in by_strain.as_ref().iter().enumerate() {
            match column.checked_sub(A::MEASURES) {
                None => {
                    for (p, &slope) in along[column].as_ref().iter().enumerate() {
                        *curvatures.at_mut([q, p]) += by * slope;
                    }
                }
                Some(beyond) => {
                    *curvatures.at_mut([q, strains + beyond]) = by;
                    *curvatures.at_mut([strains + beyond, q]) = by;
                }
            }
        }
    }
    for (q, row) in geometric.as_ref().iter().enumerate() {
        for (p, &entry) in row.as_ref().iter().enumerate() {
            *curvatures.at_mut([q, p]) += entry;
        }
    }
    for (q, row) in second.as_ref().iter().skip(A::MEASURES).enumerate() {
        for (p, &entry) in row.as_ref().iter().skip(A::MEASURES).enumerate() {
            *curvatures.at_mut([strains + q, strains + p]) = entry;
        }
    }
    (slopes, curvatures)
}

/// The derivatives of the energy with respect to `(π, γ, s)`.
fn by_entropy<A: Arrays>(
    (x, gradient, hessian): (&A::Variables, &A::Variables, &A::Hessian),
) -> (A::Variables, A::Hessian) {
    let (mut first, mut second) = (*gradient, *hessian);
    let last = A::Variables::LEN - 1;
    let by_theta = hessian[last];
    let per_capacity = -by_theta[last].recip();
    for row in 0..last {
        let response = per_capacity * by_theta[row];
        for column in 0..last {
            second[row][column] += response * by_theta[column];
        }
        (second[row][last], second[last][row]) = (response, response);
    }
    second[last][last] = per_capacity;
    first[last] = x[last];
    (first, second)
}

/// The derivatives of ψ with respect to `(π, γ)` at a given temperature, and that temperature.
fn at_given_temperature<A: Arrays>(
    (x, gradient, hessian): (&A::Variables, &A::Variables, &A::Hessian),
) -> (A::Variables, A::Hessian) {
    let (mut first, mut second) = (*gradient, *hessian);
    let last = A::Variables::LEN - 1;
    second[last] = A::Variables::filled(0.0);
    for row in &mut second.as_mut()[..last] {
        row[last] = 0.0;
    }
    first[last] = x[last];
    (first, second)
}

/// `Σ_a f_a P_a`.
pub(super) fn chained<G: StrainMeasures>(
    slopes: &StrainSlopes<G>,
    by_measure: &[f64],
) -> PerStrain<G> {
    let mut sum = PerStrain::<G>::filled(0.0);
    for (row, &by) in slopes.as_ref().iter().zip(by_measure) {
        for (sum, &slope) in sum.as_mut().iter_mut().zip(row.as_ref()) {
            *sum += by * slope;
        }
    }
    sum
}

/// The norm of the second derivatives by some variables, plus that of the first ones over `unit`; each derivative by a
/// variable is divided by the root of its count. The metric made of it vanishes only where all these derivatives do.
pub(super) fn steepness<A: Arrays, G: StrainMeasures>(
    (slopes, curvatures): (&Vector<A, G>, &Matrix<A, G>),
    variables: Range<usize>,
    counts: impl Fn(usize) -> f64,
    unit: f64,
) -> f64 {
    let (mut curvature, mut slope) = (0.0, 0.0);
    for row in variables.clone() {
        slope = Scalar::hypot(slope, slopes[row] / counts(row).sqrt());
        for column in variables.clone() {
            let counted = (counts(row) * counts(column)).sqrt();
            curvature = Scalar::hypot(curvature, curvatures.at([row, column]) / counted);
        }
    }
    curvature + slope / unit
}
