//! The modes in which the dashpots of a point relax at fixed measures.
//!
//! ```text
//! η γ̇ = −ψ_γγ γ + …,     with √η γ = V y:     ẏ_i = −ϱ_i y_i + …,     Vᵀ η^−½ ψ_γγ η^−½ V = diag ϱ
//! ```
//!
//! V is found by Jacobi's method, which keeps the small rates of dashpots beside large ones, and turns nothing if the dashpots are
//! not coupled. It does not depend on the axes in which the viscous strain of a solid is given.

use eem_material::arrays::Arrays;
use eem_material::free_energy::Array;

/// Jacobi's method converges quadratically; matrices of up to seven rows take six sweeps or fewer.
const MOST_SWEEPS: usize = 16;

/// Replaces the rows `∂²ψ/∂γ∂x` of a Hessian by those of the modes, `Vᵀ η^−½ ∂²ψ/∂γ∂x`, which come first; returns the
/// rates, 1/s.
pub(super) fn relaxation_modes<A: Arrays>(
    hessian: &A::Hessian,
    viscosities: &A::Viscosities,
    dashpots: usize,
) -> (A::Hessian, A::Viscosities) {
    let zeros = A::Variables::filled(0.0);
    let mut rows = A::Hessian::filled(zeros);
    let mut matrix = A::Hessian::filled(zeros);
    for k in 0..dashpots {
        let factor = viscosities[k].sqrt().recip();
        rows[k] = hessian[A::MEASURES + k];
        for entry in rows[k].as_mut() {
            *entry *= factor;
        }
        for l in 0..dashpots {
            matrix[k][l] = rows[k][A::MEASURES + l] / viscosities[l].sqrt();
        }
    }
    for _ in 0..MOST_SWEEPS {
        let mut has_turned = false;
        for p in 0..dashpots {
            for q in p + 1..dashpots {
                has_turned |= turn::<A>([p, q], &mut matrix, &mut rows, dashpots);
            }
        }
        if !has_turned {
            break;
        }
    }
    let mut rates = A::Viscosities::filled(0.0);
    for k in 0..dashpots {
        rates[k] = matrix[k][k];
    }
    (rows, rates)
}

/// Turns two rows so that their entry of the matrix vanishes; false if it is zero to rounding.
fn turn<A: Arrays>(
    [p, q]: [usize; 2],
    matrix: &mut A::Hessian,
    rows: &mut A::Hessian,
    dashpots: usize,
) -> bool {
    let (own, other, both) = (matrix[p][p], matrix[q][q], matrix[p][q]);
    let size = own.abs().sqrt() * other.abs().sqrt();
    if both.abs() <= f64::EPSILON * size {
        return false;
    }
    let half = (other - own) / (both + both);
    let tangent = (half.abs() + (half * half + 1.0).sqrt()).recip();
    let tangent = tangent.copysign(half);
    let cosine = (tangent * tangent + 1.0).sqrt().recip();
    let sine = tangent * cosine;
    for column in 0..dashpots {
        let (a, b) = (matrix[column][p], matrix[column][q]);
        matrix[column][p] = cosine * a - sine * b;
        matrix[column][q] = sine * a + cosine * b;
    }
    for pair in [&mut *matrix, rows] {
        let (a, b) = (pair[p], pair[q]);
        for column in 0..A::Variables::LEN {
            pair[p][column] = cosine * a[column] - sine * b[column];
            pair[q][column] = sine * a[column] + cosine * b[column];
        }
    }
    matrix[p][p] = own - tangent * both;
    matrix[q][q] = other + tangent * both;
    (matrix[p][q], matrix[q][p]) = (0.0, 0.0);
    true
}
