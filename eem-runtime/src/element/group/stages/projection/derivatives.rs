//! The derivatives of the energy by strain, viscous stretches and entropy from those of ψ.
//!
//! ```text
//! e_x = ψ_x,   e_s = θ,   e_xy = ψ_xy − ψ_xθ ψ_yθ/ψ_θθ,   e_xs = −ψ_xθ/ψ_θθ,   e_ss = −1/ψ_θθ
//! ê_C = P e_π,   ê_CC = P e_ππ Pᵀ + Σ e_π ∂²π/∂C²,   ê_Cx = P e_πx,   P = ∂π/∂C
//! ```

use super::vector::{Matrix, Vector};
use crate::element::group::arms::measures_in;
use crate::element::kinematics::{PerStrain, QuadraticStrain};
use eem_material::free_energy::{Array, FreeEnergy};
use eem_material::number::scalar::Real;

/// `∇ê` and `∇²ê` by `(C, γ, s)` from the derivatives of ψ by `x = (π, γ, θ)`.
pub(super) fn derivatives<S: Real, M: FreeEnergy<S>, K: QuadraticStrain<S, D>, const D: usize>(
    kinematics: &K,
    strain: &PerStrain<K, S, D>,
    of_model: (&M::Variables, &M::Variables, &M::Hessian),
) -> (Vector<S, M, K, D>, Matrix<S, M, K, D>) {
    let (first, second) = by_entropy::<S, M>(of_model);
    let along = kinematics.strain_slopes([strain, strain]);
    let slopes = Vector {
        strain: chained::<S, K, D>(&along, first.as_ref()),
        rest: first,
    };
    let mut curvatures = Matrix::zero();
    let turning = kinematics.strain_curvature(strain, &measures_in::<K, S, D>(&first));
    let strains = Vector::<S, M, K, D>::STRAINS;
    for column in 0..M::Variables::LEN {
        let by_strain = chained::<S, K, D>(&along, second[column].as_ref());
        for (q, &by) in by_strain.as_ref().iter().enumerate() {
            match column.checked_sub(M::MEASURES) {
                None => {
                    for (p, &slope) in along[column].as_ref().iter().enumerate() {
                        curvatures[[q, p]] += by * slope;
                    }
                }
                Some(beyond) => {
                    curvatures[[q, strains + beyond]] = by;
                    curvatures[[strains + beyond, q]] = by;
                }
            }
        }
    }
    for (q, row) in turning.as_ref().iter().enumerate() {
        for (p, &entry) in row.as_ref().iter().enumerate() {
            curvatures[[q, p]] += entry;
        }
    }
    for (q, row) in second.as_ref().iter().skip(M::MEASURES).enumerate() {
        for (p, &entry) in row.as_ref().iter().skip(M::MEASURES).enumerate() {
            curvatures[[strains + q, strains + p]] = entry;
        }
    }
    (slopes, curvatures)
}

/// The derivatives of the energy by `(π, γ, s)`.
fn by_entropy<S: Real, M: FreeEnergy<S>>(
    (x, gradient, hessian): (&M::Variables, &M::Variables, &M::Hessian),
) -> (M::Variables, M::Hessian) {
    let (mut first, mut second) = (*gradient, *hessian);
    if !M::THERMAL {
        return (first, second);
    }
    let last = M::Variables::LEN - 1;
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

/// `Σ_a f_a P_a`.
pub(super) fn chained<S: Real, K: QuadraticStrain<S, D>, const D: usize>(
    slopes: &K::PerMeasure<PerStrain<K, S, D>>,
    by_measure: &[S],
) -> PerStrain<K, S, D> {
    let mut sum = PerStrain::<K, S, D>::filled(S::zero());
    for (row, &by) in slopes.as_ref().iter().zip(by_measure) {
        for (sum, &slope) in sum.as_mut().iter_mut().zip(row.as_ref()) {
            *sum += by * slope;
        }
    }
    sum
}
