//! The bilinear shape functions of a quadrilateral, and what is integrated with them once.

use crate::element::kinematics::plane::{Tensor, determinant};
use crate::number::scalar::Real;

/// The corners of the parent square, in the order of the nodes.
const CORNERS: [[f64; 2]; 4] = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];

/// `N_a` and `∂N_a/∂ξ` at a point of the parent square.
pub(super) fn shapes<S: Real>([x, y]: [S; 2]) -> [(S, [S; 2]); 4] {
    let quarter = S::from_f64(0.25);
    CORNERS.map(|corner| {
        let [a, b] = corner.map(S::from_f64);
        let (along, across) = (S::one() + a * x, S::one() + b * y);
        let slope = [quarter * a * across, quarter * b * along];
        (quarter * along * across, slope)
    })
}

/// `∂X/∂ξ`, m, of the arms of the reference configuration.
pub(super) fn jacobian<S: Real>(reference: &[[S; 2]; 4], shapes: &[(S, [S; 2]); 4]) -> Tensor<S> {
    let mut jacobian = [[S::zero(); 2]; 2];
    for (corner, (_, slope)) in reference.iter().zip(shapes).skip(1) {
        for (axis, row) in jacobian.iter_mut().enumerate() {
            for (entry, &slope) in row.iter_mut().zip(slope) {
                *entry += (corner[axis] - reference[0][axis]) * slope;
            }
        }
    }
    jacobian
}

/// The points and weights of a Gauss rule with `N` points per axis, the first coordinate fastest.
pub(super) fn gauss<S: Real, const N: usize>(
    abscissas: [S; N],
    weights: [S; N],
) -> impl Iterator<Item = ([S; 2], S)> {
    (0..N * N).map(move |point| {
        let (i, j) = (point % N, point / N);
        ([abscissas[i], abscissas[j]], weights[i] * weights[j])
    })
}

/// The consistent mass `∫ ρ N_a N_b dV` of each pair of nodes, kg, exact for any corners.
pub(crate) fn masses<S: Real>(reference: &[[S; 2]; 4], surface_density: S) -> [[S; 4]; 4] {
    let root = S::from_f64(0.6).sqrt();
    let [edge, middle] = [5.0, 8.0].map(|nine| S::from_f64(nine) / S::from_f64(9.0));
    let mut masses = [[S::zero(); 4]; 4];
    for (place, weight) in gauss([-root, S::zero(), root], [edge, middle, edge]) {
        let shapes = shapes(place);
        let area = determinant(&jacobian(reference, &shapes));
        let mass = surface_density * weight * area;
        for (row, (by, _)) in masses.iter_mut().zip(&shapes) {
            for (entry, (other, _)) in row.iter_mut().zip(&shapes) {
                *entry += mass * *by * *other;
            }
        }
    }
    masses
}
