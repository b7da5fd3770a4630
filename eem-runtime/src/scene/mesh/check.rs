//! The rules that a mesh must satisfy.

use super::error::MeshError;
use crate::element::kinematics::{Shape, Symmetric, integrals};
use crate::material::free_energy::Array;

/// The first thing that is wrong.
pub(super) fn check<H: Shape<D>, const D: usize>(
    nodes: &[[f64; D]],
    cells: &[H::PerNode<usize>],
) -> Result<(), MeshError> {
    if cells.is_empty() {
        return Err(MeshError::Empty);
    }
    check_names::<H, D>(nodes.len(), cells)?;
    check_places(nodes)?;
    let rule = integrals::rule::<H, D>().into_iter();
    let points: Vec<_> = rule
        .map(|(place, _)| integrals::functions::<H, f64, D>(place))
        .collect();
    let mut reference = H::PerNode::filled([0.0; D]);
    for (index, cell) in cells.iter().enumerate() {
        for (place, &node) in reference.as_mut().iter_mut().zip(cell.as_ref()) {
            *place = nodes[node];
        }
        for (point, functions) in points.iter().enumerate() {
            let jacobian = integrals::jacobian(reference.as_ref(), functions);
            let value = H::Tensor::<f64>::determinant(&jacobian);
            if !(value > 0.0 && value.is_finite()) {
                return Err(MeshError::InsideOut {
                    cell: index,
                    point,
                    value,
                    unit: if D == 2 { "m^2" } else { "m^3" },
                });
            }
        }
    }
    Ok(())
}

/// Cells have nodes that exist, each once, and every node has a cell.
fn check_names<H: Shape<D>, const D: usize>(
    nodes: usize,
    cells: &[H::PerNode<usize>],
) -> Result<(), MeshError> {
    // The last cell that named a node.
    let mut named = vec![None; nodes];
    for (cell, its_nodes) in cells.iter().enumerate() {
        for &node in its_nodes.as_ref() {
            match named.get_mut(node) {
                None => return Err(MeshError::NoSuchNode { cell, node, nodes }),
                Some(last) if *last == Some(cell) => {
                    return Err(MeshError::Repeated { cell, node });
                }
                Some(last) => *last = Some(cell),
            }
        }
    }
    match named.iter().position(Option::is_none) {
        Some(node) => Err(MeshError::Orphan { node }),
        None => Ok(()),
    }
}

/// Places are finite, and no two are the same.
fn check_places<const D: usize>(nodes: &[[f64; D]]) -> Result<(), MeshError> {
    for (node, place) in nodes.iter().enumerate() {
        if let Some(axis) = place.iter().position(|coordinate| !coordinate.is_finite()) {
            let value = place[axis];
            return Err(MeshError::Place { node, axis, value });
        }
    }
    // −0 and 0 are one place.
    let key = |&node: &usize| nodes[node].map(|coordinate| (coordinate + 0.0).to_bits());
    let mut order: Vec<usize> = (0..nodes.len()).collect();
    order.sort_by_key(key);
    let mut pairs = order.windows(2);
    match pairs.find(|pair| key(&pair[0]) == key(&pair[1])) {
        Some(pair) => Err(MeshError::Duplicate {
            nodes: [pair[0], pair[1]],
        }),
        None => Ok(()),
    }
}
