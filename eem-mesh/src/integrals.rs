//! Integrals over the reference configuration of a cell, computed once, by Gauss rules of two to four points per axis.

use crate::shape::Shape;
use crate::tensor::{Symmetric, Tensor};
use eem_material::free_energy::Array;
use eem_material::number::scalar::Real;

/// `N_a` and `∂N_a/∂ξ` of all nodes.
pub type Functions<S, const D: usize> = Vec<(S, [S; D])>;

/// The shape functions at a position in the parent cell.
pub fn functions<H: Shape<D>, S: Real, const D: usize>(place: [S; D]) -> Functions<S, D> {
    let nodes = 0..H::NODES.len();
    nodes.map(|node| H::function(node, place)).collect()
}

/// The points and weights of a cell of this shape.
#[must_use]
pub fn rule<H: Shape<D>, const D: usize>() -> Vec<([f64; D], f64)> {
    gauss(H::PER_AXIS)
}

/// `∂X/∂ξ`, m, from the positions of the nodes in the reference configuration.
pub fn jacobian<S: Real, const D: usize>(
    reference: &[[S; D]],
    functions: &[(S, [S; D])],
) -> Tensor<S, D> {
    let mut jacobian = [[S::zero(); D]; D];
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
pub type Pairs<H, S, const D: usize> = <H as Shape<D>>::PerNode<<H as Shape<D>>::PerNode<S>>;

/// The consistent mass `∫ ρ N_a N_b dV` of each pair of nodes, kg, exact for any cell whose edges are straight.
/// The density is per area in the plane.
pub fn masses<H: Shape<D>, S: Real, const D: usize>(
    reference: &H::PerNode<[S; D]>,
    density: S,
) -> Pairs<H, S, D> {
    let reference = reference.as_ref();
    let mut masses = Pairs::<H, S, D>::filled(H::PerNode::filled(S::zero()));
    for (place, weight) in gauss(H::PER_AXIS + 1) {
        let functions = functions::<H, S, D>(place);
        let volume = H::Tensor::<S>::determinant(&jacobian(reference, &functions));
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
pub fn lump<H: Shape<D>, S: Real, const D: usize>(masses: &mut Pairs<H, S, D>) {
    let rows = masses.as_ref().iter();
    let sums: Vec<S> = rows
        .map(|row| row.as_ref().iter().fold(S::zero(), |sum, &mass| sum + mass))
        .collect();
    let total = sums.iter().fold(S::zero(), |total, &sum| total + sum);
    let diagonal = (0..sums.len()).map(|a| masses[a][a]);
    let diagonal = diagonal.fold(S::zero(), |sum, mass| sum + mass);
    let is_linear = H::NODES.iter().all(|node| !node.contains(&0));
    for (a, row) in masses.as_mut().iter_mut().enumerate() {
        let own = if is_linear {
            sums[a]
        } else {
            row[a] * total / diagonal
        };
        *row = H::PerNode::filled(S::zero());
        row[a] = own;
    }
}

/// Abscissas and weights on [−1, 1].
fn on_axis<S: Real>(points: usize) -> Vec<(S, S)> {
    let number = S::from_f64;
    match points {
        2 => {
            let root = (S::one() / number(3.0)).sqrt();
            vec![(-root, S::one()), (root, S::one())]
        }
        3 => {
            let root = number(0.6).sqrt();
            let [edge, middle] = [5.0, 8.0].map(|nine| number(nine) / number(9.0));
            vec![(-root, edge), (S::zero(), middle), (root, edge)]
        }
        // x² = 3/7 ∓ 2/7 √(6/5), weights (18 ± √30)/36
        _ => {
            let shift = number(2.0) * number(1.2).sqrt();
            let [inner, outer] = [number(3.0) - shift, number(3.0) + shift]
                .map(|seventh| (seventh / number(7.0)).sqrt());
            let [heavy, light] = [number(30.0).sqrt(), -number(30.0).sqrt()]
                .map(|root| (number(18.0) + root) / number(36.0));
            let half = [(outer, light), (inner, heavy)];
            let [first, second] = half.map(|(at, weight)| (-at, weight));
            vec![first, second, half[1], half[0]]
        }
    }
}

/// The points of a cell with their weights, the first coordinate fastest.
#[must_use]
pub fn gauss<S: Real, const D: usize>(per_axis: usize) -> Vec<([S; D], S)> {
    let axis = on_axis::<S>(per_axis);
    let points = (0..D).fold(1, |points, _| points * axis.len());
    let point = |mut index: usize| {
        let (mut place, mut weight) = ([S::zero(); D], S::one());
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
