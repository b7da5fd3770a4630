//! The distance of two nodes.

use core::array;

use super::{Ends, Kinematics};
use crate::free_energy::Entry;
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
/// let stretch = Stretch::<2>.measure(&[[1.0, 1.0], [4.0, 5.0]]);
/// assert_eq!(stretch, [5.0]);
/// ```
#[derive(Clone, Copy, Debug, Default)]
pub struct Stretch<const D: usize>;

/// `r = q_j − q_i`.
#[inline]
fn difference<S: Scalar, const D: usize>(q: &[[S; D]; 2]) -> [S; D] {
    array::from_fn(|axis| q[1][axis] - q[0][axis])
}

/// `[−v, v]`, the derivative along `r` as a derivative along `[q_i, q_j]`.
#[inline]
fn spread<S: Scalar, const D: usize>(v: [S; D]) -> [[S; D]; 2] {
    [v.map(|component| -component), v]
}

/// `[K, −K; −K, K]` with `K = t (1 − a bᵀ)`.
#[inline]
fn blocks<S: Scalar, const D: usize>(t: S, a: [S; D], b: [S; D]) -> [[[[S; D]; D]; 2]; 2] {
    let (mut k, mut minus) = ([[S::zero(); D]; D], [[S::zero(); D]; D]);
    for row in 0..D {
        for column in 0..D {
            let identity = if row == column { S::one() } else { S::zero() };
            let entry = t * (identity - a[row] * b[column]);
            (k[row][column], minus[row][column]) = (entry, -entry);
        }
    }
    [[k, minus], [minus, k]]
}

impl<S: Real, const D: usize> Kinematics<S, D> for Stretch<D> {
    type PerNode<T: Entry> = [T; 2];
    type PerMeasure<T: Entry> = [T; 1];

    #[inline]
    fn is_admissible(&self, measure: S) -> bool {
        measure.is_finite() && measure > S::zero()
    }

    #[inline]
    fn measure(&self, q: &[[S; D]; 2]) -> [S; 1] {
        let r = difference(q);
        let square = r
            .iter()
            .fold(S::zero(), |sum, &component| sum + component * component);
        [square.sqrt()]
    }

    #[inline]
    fn gradient(&self, q: &[[S; D]; 2], &[lambda]: &[S; 1]) -> [[[S; D]; 2]; 1] {
        let shrink = lambda.recip();
        [spread(difference(q).map(|component| component * shrink))]
    }

    #[inline]
    fn curvature(
        &self,
        q: &[[S; D]; 2],
        &[lambda]: &[S; 1],
        &[force]: &[S; 1],
    ) -> [[[[S; D]; D]; 2]; 2] {
        let n = difference(q).map(|component| component / lambda);
        blocks(force / lambda, n, n)
    }

    #[inline]
    fn discrete_gradient(&self, ends: &Ends<Self, S, D>) -> [[[S; D]; 2]; 1] {
        [spread(mean_direction(ends))]
    }

    // ∂(f 2r_m/(λ⁰ + λ¹))/∂r¹ = f/(λ⁰ + λ¹) (1 − 2r_m/(λ⁰ + λ¹) n¹ᵀ)
    #[inline]
    fn discrete_curvature(
        &self,
        ends: &Ends<Self, S, D>,
        &[force]: &[S; 1],
    ) -> [[[[S; D]; D]; 2]; 2] {
        let ([lambda0], [lambda1]) = (ends.measures0, ends.measures1);
        let shrink = lambda1.recip();
        let n1 = difference(&ends.q1).map(|component| component * shrink);
        blocks(force / (lambda0 + lambda1), mean_direction(ends), n1)
    }

    #[inline]
    fn secant(&self, &[lambda0]: &[S; 1], &[lambda1]: &[S; 1], &[force]: &[S; 1]) -> [[S; 2]; 2] {
        let tension = (force + force) / (lambda0 + lambda1);
        [[tension, -tension], [-tension, tension]]
    }
}

/// `2 r_m/(λ⁰ + λ¹)`.
#[inline]
fn mean_direction<S: Real, const D: usize>(ends: &Ends<Stretch<D>, S, D>) -> [S; D] {
    let (r0, r1) = (difference(&ends.q0), difference(&ends.q1));
    let shrink = (ends.measures0[0] + ends.measures1[0]).recip();
    array::from_fn(|axis| (r0[axis] + r1[axis]) * shrink)
}
