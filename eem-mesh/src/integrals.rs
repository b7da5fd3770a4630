//! Integrals over the reference configuration of a cell, computed once, by Gauss rules of two to four points per axis.

use crate::shape::Shape;
use crate::tensor::{Symmetric, Tensor};
use eem_material::free_energy::Array;

/// `N_a` and `∂N_a/∂ξ` of all nodes.
pub type Functions<const D: usize> = Vec<(f64, [f64; D])>;

/// The shape functions at a position in the parent cell.
#[must_use]
pub fn functions<H: Shape<D>, const D: usize>(place: [f64; D]) -> Functions<D> {
    let nodes = 0..H::NODES.len();
    nodes.map(|node| H::function(node, place)).collect()
}

/// The points and weights of a cell of this shape.
#[must_use]
pub fn rule<H: Shape<D>, const D: usize>() -> Vec<([f64; D], f64)> {
    gauss(H::PER_AXIS)
}

/// `∂X/∂ξ`, m, from the positions of the nodes in the reference configuration.
#[must_use]
pub fn jacobian<const D: usize>(
    reference: &[[f64; D]],
    functions: &[(f64, [f64; D])],
) -> Tensor<D> {
    let mut jacobian = [[0.0; D]; D];
    for (node, (_, slope)) in reference.iter().zip(functions).skip(1) {
        for (axis, row) in jacobian.iter_mut().enumerate() {
            for (entry, &slope) in row.iter_mut().zip(slope) {
                *entry += (node[axis] - reference[0][axis]) * slope;
            }
        }
    }
    jacobian
}

/// A mass per pair of nodes, kg.
pub type Pairs<H, const D: usize> = <H as Shape<D>>::PerNode<<H as Shape<D>>::PerNode<f64>>;

/// The consistent mass `∫ ρ N_a N_b dV` of each pair of nodes, kg, exact for any cell whose edges are straight.
/// The density is per area in the plane.
pub fn masses<H: Shape<D>, const D: usize>(
    reference: &H::PerNode<[f64; D]>,
    density: f64,
) -> Pairs<H, D> {
    let reference = reference.as_ref();
    let mut masses = Pairs::<H, D>::filled(H::PerNode::filled(0.0));
    for (place, weight) in gauss(H::PER_AXIS + 1) {
        let functions = functions::<H, D>(place);
        let volume = H::Tensor::determinant(&jacobian(reference, &functions));
        let mass = density * weight * volume;
        for (row, (by, _)) in masses.as_mut().iter_mut().zip(&functions) {
            for (entry, (other, _)) in row.as_mut().iter_mut().zip(&functions) {
                *entry += mass * *by * *other;
            }
        }
    }
    masses
}

/// Lumps the mass on the diagonal; off-diagonal entries become zero. With linear shape functions a node gets the sum of its
/// row. With others some of these sums are negative, so the whole mass is distributed in proportion to the diagonal (Hinton,
/// Rock & Zienkiewicz 1976).
pub fn lump<H: Shape<D>, const D: usize>(masses: &mut Pairs<H, D>) {
    let rows = masses.as_ref().iter();
    let sums: Vec<f64> = rows
        .map(|row| row.as_ref().iter().fold(0.0, |sum, &mass| sum + mass))
        .collect();
    let total = sums.iter().fold(0.0, |total, &sum| total + sum);
    let diagonal = (0..sums.len()).map(|a| masses[a][a]);
    let diagonal = diagonal.fold(0.0, |sum, mass| sum + mass);
    let is_linear = H::NODES.iter().all(|node| !node.contains(&0));
    for (a, row) in masses.as_mut().iter_mut().enumerate() {
        let own = if is_linear {
            sums[a]
        } else {
            row[a] * total / diagonal
        };
        *row = H::PerNode::filled(0.0);
        row[a] = own;
    }
}

/// Abscissas and weights on [−1, 1].
fn on_axis(points: usize) -> Vec<(f64, f64)> {
    match points {
        2 => {
            let root = (1.0_f64 / 3.0).sqrt();
            vec![(-root, 1.0), (root, 1.0)]
        }
        3 => {
            let root = 0.6_f64.sqrt();
            let [edge, middle] = [5.0, 8.0].map(|nine| nine / 9.0);
            vec![(-root, edge), (0.0, middle), (root, edge)]
        }
        // x² = 3/7 ∓ 2/7 √(6/5), weights (18 ± √30)/36
        _ => {
            let shift = 2.0 * 1.2_f64.sqrt();
            let [inner, outer] = [3.0 - shift, 3.0 + shift].map(|seventh| (seventh / 7.0).sqrt());
            let [heavy, light] =
                [30.0_f64.sqrt(), -30.0_f64.sqrt()].map(|root| (18.0 + root) / 36.0);
            let half = [(outer, light), (inner, heavy)];
            let [first, second] = half.map(|(at, weight)| (-at, weight));
            vec![first, second, half[1], half[0]]
        }
    }
}

/// The points of a cell with their weights, the first coordinate fastest.
#[must_use]
pub fn gauss<const D: usize>(per_axis: usize) -> Vec<([f64; D], f64)> {
    let axis = on_axis(per_axis);
    let points = (0..D).fold(1, |points, _| points * axis.len());
    let point = |mut index: usize| {
        let (mut place, mut weight) = ([0.0; D], 1.0);
        for at in &mut place {
            let (abscissa, share) = axis[index % axis.len()];
            index /= axis.len();
            *at = abscissa;
            weight *= share;
        }
        (place, weight)
    };
    (0..points).map(point).collect()
}
