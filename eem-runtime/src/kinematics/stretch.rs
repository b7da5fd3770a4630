//! The distance of two nodes.

use super::{Ends, Kinematics};
use crate::scalar::{Real, Scalar};

/// The stretch `λ = |r|`, `r = q_j − q_i`, of two nodes in `D` dimensions, m.
///
/// ```text
/// ∂λ/∂r = r/λ,   ∂²λ/∂r² = (1 − n nᵀ)/λ,   n = r/λ
/// D*λ = 2 r_m/(λ⁰ + λ¹),   r_m = ½(r⁰ + r¹)
/// ```
///
/// `λ⁰ + λ¹` is the sum of the end lengths, not `2|r_m|`: only then is
/// `D*λ·(r¹ − r⁰) = (λ¹² − λ⁰²)/(λ⁰ + λ¹) = λ¹ − λ⁰`.
///
/// ```
/// use eem_runtime::kinematics::{Kinematics, Stretch};
///
/// let mut stretch = [0.0];
/// Kinematics::<f64>::measure(&Stretch::<2>, &[1.0, 1.0, 4.0, 5.0], &mut stretch);
/// assert_eq!(stretch, [5.0]);
/// ```
#[derive(Clone, Copy, Debug, Default)]
pub struct Stretch<const D: usize>;

/// `q_j − q_i` of coordinates `[q_i, q_j]`.
#[inline]
fn difference<S: Scalar, const D: usize>(q: &[S]) -> [S; D] {
    core::array::from_fn(|axis| q[D + axis] - q[axis])
}

/// Writes `[−v, v]`, the derivative along `r` as a derivative along `[q_i, q_j]`.
#[inline]
fn spread<S: Scalar, const D: usize>(v: [S; D], gradient: &mut [S]) {
    for (axis, &component) in v.iter().enumerate() {
        gradient[axis] = -component;
        gradient[D + axis] = component;
    }
}

/// Adds `[K, −K; −K, K]`.
#[inline]
fn add_blocks<S: Scalar, const D: usize>(k: impl Fn(usize, usize) -> S, matrix: &mut [S]) {
    let width = 2 * D;
    for row in 0..D {
        for column in 0..D {
            let entry = k(row, column);
            matrix[row * width + column] += entry;
            matrix[row * width + D + column] -= entry;
            matrix[(D + row) * width + column] -= entry;
            matrix[(D + row) * width + D + column] += entry;
        }
    }
}

#[inline]
fn identity<S: Scalar>(row: usize, column: usize) -> S {
    if row == column { S::one() } else { S::zero() }
}

impl<S: Real, const D: usize> Kinematics<S> for Stretch<D> {
    const NODES: usize = 2;
    const MEASURES: usize = 1;

    fn is_admissible(&self, measure: S) -> bool {
        measure.is_finite() && measure > S::zero()
    }

    #[inline]
    fn measure(&self, q: &[S], measures: &mut [S]) {
        let r: [S; D] = difference(q);
        let square = r
            .iter()
            .fold(S::zero(), |sum, &component| sum + component * component);
        measures[0] = square.sqrt();
    }

    #[inline]
    fn gradient(&self, q: &[S], measures: &[S], gradient: &mut [S]) {
        let r: [S; D] = difference(q);
        spread(r.map(|component| component / measures[0]), gradient);
    }

    #[inline]
    fn add_curvature(&self, q: &[S], measures: &[S], force: &[S], matrix: &mut [S]) {
        let n = difference::<S, D>(q).map(|component| component / measures[0]);
        let tension = force[0] / measures[0];
        add_blocks::<S, D>(
            |row, column| tension * (identity::<S>(row, column) - n[row] * n[column]),
            matrix,
        );
    }

    #[inline]
    fn discrete_gradient(&self, ends: Ends<'_, S>, gradient: &mut [S]) {
        let (r0, r1): ([S; D], [S; D]) = (difference(ends.q0), difference(ends.q1));
        let sum = ends.measures0[0] + ends.measures1[0];
        spread::<S, D>(
            core::array::from_fn(|axis| (r0[axis] + r1[axis]) / sum),
            gradient,
        );
    }

    // ∂(f 2r_m/(λ⁰ + λ¹))/∂r¹ = f/(λ⁰ + λ¹) (1 − 2r_m/(λ⁰ + λ¹) n¹ᵀ)
    #[inline]
    fn add_discrete_curvature(&self, ends: Ends<'_, S>, force: &[S], matrix: &mut [S]) {
        let (r0, r1): ([S; D], [S; D]) = (difference(ends.q0), difference(ends.q1));
        let sum = ends.measures0[0] + ends.measures1[0];
        let n1 = r1.map(|component| component / ends.measures1[0]);
        let mean: [S; D] = core::array::from_fn(|axis| (r0[axis] + r1[axis]) / sum);
        let tension = force[0] / sum;
        add_blocks::<S, D>(
            |row, column| tension * (identity::<S>(row, column) - mean[row] * n1[column]),
            matrix,
        );
    }

    #[inline]
    fn add_secant(&self, measures0: &[S], measures1: &[S], force: &[S], matrix: &mut [S]) {
        let sum = measures0[0] + measures1[0];
        let tension = (force[0] + force[0]) / sum;
        add_blocks::<S, D>(|row, column| tension * identity::<S>(row, column), matrix);
    }
}
