//! The checks of a mesh.

use super::error::MeshError;
use super::geometry::power_of_two;
use super::sides::{Cells, with_cells};
use crate::integrals;
use crate::shape::Shape;
use crate::tensor::Symmetric;
use eem_material::free_energy::Array;

/// Returns the first error of a mesh.
pub(super) fn check<H: Shape<D>, const D: usize>(
    nodes: &[[f64; D]],
    cells: &[H::PerNode<usize>],
) -> Result<(), MeshError> {
    if cells.is_empty() {
        return Err(MeshError::Empty);
    }
    check_names::<H, D>(nodes.len(), cells)?;
    check_finite(nodes)?;
    check_distinct(nodes)?;
    check_sizes::<H, D>(nodes, cells)?;
    with_cells::<H, D, _>(cells, |cells| check_faces(cells, nodes.len()))
}

/// An error unless `det ∂X/∂ξ` is positive at all points and nodes, and so everywhere in a quadrilateral of four nodes.
fn check_sizes<H: Shape<D>, const D: usize>(
    nodes: &[[f64; D]],
    cells: &[H::PerNode<usize>],
) -> Result<(), MeshError> {
    let unit = if D == 2 { "m^2" } else { "m^3" };
    let points = integrals::rule::<H, D>().into_iter();
    let points: Vec<_> = points
        .map(|(place, _)| integrals::functions::<H, D>(place))
        .collect();
    let at_nodes = H::NODES.iter().map(|node| node.map(f64::from));
    let at_nodes: Vec<_> = at_nodes.map(integrals::functions::<H, D>).collect();
    let mut reference = H::PerNode::filled([0.0; D]);
    let is_size = |value: f64| value > 0.0 && value.is_finite();
    for (cell, its_nodes) in cells.iter().enumerate() {
        for (place, &node) in reference.as_mut().iter_mut().zip(its_nodes.as_ref()) {
            *place = nodes[node];
        }
        let size = |functions: &integrals::Functions<D>| {
            let jacobian = integrals::jacobian(reference.as_ref(), functions);
            H::Tensor::determinant(&jacobian)
        };
        let scale = |functions, value| {
            let is_there = is_size(scaled_size::<H, D>(reference.as_ref(), functions));
            is_there.then_some(MeshError::Scale { cell, value, unit })
        };
        for (at, functions) in points.iter().chain(&at_nodes).enumerate() {
            let value = size(functions);
            if is_size(value) {
                continue;
            }
            let inside_out = match at.checked_sub(points.len()) {
                None => MeshError::InsideOut {
                    cell,
                    point: at,
                    value,
                    unit,
                },
                Some(node) => MeshError::InsideOutAtNode {
                    cell,
                    node: its_nodes.as_ref()[node],
                    value,
                    unit,
                },
            };
            return Err(scale(functions, value).unwrap_or(inside_out));
        }
    }
    Ok(())
}

/// `det ∂X/∂ξ` of a cell scaled to about the size one by powers of two.
fn scaled_size<H: Shape<D>, const D: usize>(
    reference: &[[f64; D]],
    functions: &integrals::Functions<D>,
) -> f64 {
    let power = power_of_two(reference.as_flattened().iter());
    let first = reference[0];
    let places = reference.iter();
    let arms =
        places.map(|place| core::array::from_fn(|axis| power * place[axis] - power * first[axis]));
    let mut arms: Vec<[f64; D]> = arms.collect();
    let power = power_of_two(arms.as_flattened().iter());
    for coordinate in arms.as_flattened_mut() {
        *coordinate *= power;
    }
    H::Tensor::determinant(&integrals::jacobian(&arms, functions))
}

/// An error unless at most two faces of cells have the same nodes, and face each other.
fn check_faces(cells: &Cells<'_>, nodes: usize) -> Result<(), MeshError> {
    let mut found = Ok(());
    cells.for_same(nodes, &mut |same| {
        found = check_same(cells, same);
        found.is_ok()
    });
    found
}

/// The same of faces with the same nodes.
fn check_same(cells: &Cells<'_>, same: &[[usize; 2]]) -> Result<(), MeshError> {
    let &[first, second, ref more @ ..] = same else {
        return Ok(());
    };
    let pair = [first[0], second[0]];
    let all_nodes = |cell: usize| {
        let mut all = cells.nodes_of(cell).to_vec();
        all.sort_unstable();
        all
    };
    if all_nodes(pair[0]) == all_nodes(pair[1]) {
        return Err(MeshError::SameNodes { cells: pair });
    }
    // The corners counterclockwise, seen from outside.
    let corners = |[cell, face]: [usize; 2]| {
        let corners = cells.faces[face].iter().take(1 << (cells.dimensions - 1));
        let mut corners: Vec<usize> = corners.map(|&node| cells.nodes_of(cell)[node]).collect();
        // Around a face in space, from the one with the least number.
        if cells.dimensions == 3 {
            let least = (0..corners.len()).min_by_key(|&at| corners[at]);
            corners.rotate_left(least.unwrap_or_default());
        }
        corners
    };
    let nodes = corners(first);
    if let Some(third) = more.first() {
        return Err(MeshError::CrowdedFace {
            cells: [pair[0], pair[1], third[0]],
            nodes,
        });
    }
    if nodes == corners(second) {
        return Err(MeshError::SameSide { cells: pair, nodes });
    }
    Ok(())
}

/// An error unless cells have existing nodes, each once, and every node has a cell.
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

/// An error unless all coordinates are finite.
pub(super) fn check_finite<const D: usize>(nodes: &[[f64; D]]) -> Result<(), MeshError> {
    for (node, place) in nodes.iter().enumerate() {
        if let Some(axis) = place.iter().position(|coordinate| !coordinate.is_finite()) {
            let value = place[axis];
            return Err(MeshError::Place { node, axis, value });
        }
    }
    Ok(())
}

/// An error if two nodes have the same position.
fn check_distinct<const D: usize>(nodes: &[[f64; D]]) -> Result<(), MeshError> {
    match first_pair(nodes.as_flattened(), D) {
        Some(nodes) => Err(MeshError::Duplicate { nodes }),
        None => Ok(()),
    }
}

/// The first two nodes with the same coordinates in a list of them, by the bits of these. Compiled once for all dimensions.
fn first_pair(coordinates: &[f64], dimensions: usize) -> Option<[usize; 2]> {
    let key = |node: usize| {
        let place = &coordinates[node * dimensions..][..dimensions];
        // −0 and 0 are the same.
        place.iter().map(|coordinate| (coordinate + 0.0).to_bits())
    };
    let mut order: Vec<usize> = (0..coordinates.len() / dimensions).collect();
    order.sort_unstable_by(|&a, &b| key(a).cmp(key(b)).then(a.cmp(&b)));
    let mut pairs = order.windows(2);
    let pair = pairs.find(|pair| key(pair[0]).eq(key(pair[1])))?;
    Some([pair[0], pair[1]])
}
