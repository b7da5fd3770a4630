//! Errors of meshes.

use thiserror::Error;

use eem_material::number::readable::Readable;

/// Why a mesh, or a part of it, is invalid.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum MeshError {
    /// There are no cells.
    #[error("the mesh has no cells")]
    Empty,
    /// The cuts of a grid, or the heights of an extrusion, do not ascend.
    #[error("cut {cut} along axis {axis} is {value} m, it must be finite and above the one before", value = Readable(*value))]
    Cut {
        /// The axis, from 0.
        axis: usize,
        /// The cut, from 0.
        cut: usize,
        /// The position of the cut, m.
        value: f64,
    },
    /// The ends of a block along an axis do not ascend.
    #[error(
        "the block reaches from {from} m to {to} m along axis {axis}: both ends must be finite, and the second above the first",
        from = Readable(*from), to = Readable(*to)
    )]
    Range {
        /// The axis, from 0.
        axis: usize,
        /// The first end, m.
        from: f64,
        /// The second end, m.
        to: f64,
    },
    /// There are too many nodes to number them.
    #[error(
        "{cells} cells have {nodes} nodes, which take {bytes} bytes, and no more than 4294967295 nodes can be numbered: use fewer cells"
    )]
    TooMany {
        /// The number of cells; [`u128::MAX`] stands for that or more, here and below.
        cells: u128,
        /// The number of nodes.
        nodes: u128,
        /// Memory needed to make and check the mesh.
        bytes: u128,
    },
    /// A mesh takes more memory than there is.
    #[error(
        "{cells} cells with {nodes} nodes take {bytes} bytes, {}: use fewer cells, or a machine with more memory",
        available.map_or_else(|| "which the system refuses".to_owned(), |most| format!("and {most} are available"))
    )]
    TooLarge {
        /// The number of cells.
        cells: u128,
        /// The number of nodes.
        nodes: u128,
        /// Memory needed to make and check the mesh.
        bytes: u128,
        /// Memory available, bytes; `None` if unknown, or if the allocation failed although there seemed to be
        /// enough.
        available: Option<u64>,
    },
    /// Two sides of a polygon cross or touch.
    #[error("sides {first} and {second} of the polygon cross or touch, counted from 0: side n leads from corner n to the next", first = sides[0], second = sides[1])]
    Crossing {
        /// The sides, from 0.
        sides: [usize; 2],
    },
    /// A cell names a node that does not exist.
    #[error("cell {cell} has node {node}, but there are {nodes} nodes, counted from 0")]
    NoSuchNode {
        /// The cell, from 0.
        cell: usize,
        /// The node, from 0.
        node: usize,
        /// The number of nodes.
        nodes: usize,
    },
    /// A cell has a node twice.
    #[error("cell {cell} has node {node} twice")]
    Repeated {
        /// The cell, from 0.
        cell: usize,
        /// The node, from 0.
        node: usize,
    },
    /// A node belongs to no cell.
    #[error("node {node} belongs to no cell")]
    Orphan {
        /// The node, from 0.
        node: usize,
    },
    /// Two nodes coincide.
    #[error("nodes {first} and {second} are in the same place", first = nodes[0], second = nodes[1])]
    Duplicate {
        /// The nodes, from 0.
        nodes: [usize; 2],
    },
    /// A coordinate is not finite.
    #[error("coordinate {axis} of node {node} is {value} m, it must be finite", value = Readable(*value))]
    Place {
        /// The node, from 0.
        node: usize,
        /// The axis, from 0.
        axis: usize,
        /// The coordinate, m.
        value: f64,
    },
    /// A cell is inside out at one of its points.
    #[error(
        "cell {cell} is inside out: det dX/dxi is {value} {unit} at its point {point}, it must be positive and finite; its nodes come in the order of VTK",
        value = Readable(*value)
    )]
    InsideOut {
        /// The cell, from 0.
        cell: usize,
        /// The point, from 0.
        point: usize,
        /// `det ∂X/∂ξ`.
        value: f64,
        /// Its unit, m² or m³.
        unit: &'static str,
    },
    /// A cell is inside out at one of its nodes, or two edges are collinear there.
    #[error(
        "cell {cell} is inside out, or flat, at its node {node}: det dX/dxi is {value} {unit} there, it must be positive and finite; at a corner less than half a turn lies between its edges",
        value = Readable(*value)
    )]
    InsideOutAtNode {
        /// The cell, from 0.
        cell: usize,
        /// The node, from 0.
        node: usize,
        /// `det ∂X/∂ξ`.
        value: f64,
        /// Its unit, m² or m³.
        unit: &'static str,
    },
    /// The volume of a cell overflows or underflows.
    #[error(
        "cell {cell} is too large or too small: det dX/dxi is {value} {unit}, outside of what a number holds; give lengths in m",
        value = Readable(*value)
    )]
    Scale {
        /// The cell, from 0.
        cell: usize,
        /// The computed value of `det ∂X/∂ξ`.
        value: f64,
        /// Its unit, m² or m³.
        unit: &'static str,
    },
    /// Two cells have the same nodes.
    #[error("cells {first} and {second} have the same nodes: leave one of them", first = cells[0], second = cells[1])]
    SameNodes {
        /// The cells, from 0.
        cells: [usize; 2],
    },
    /// More than two cells have a face in common.
    #[error(
        "cells {first}, {second} and {third} all have a face with the corners {nodes:?}, which two can have in common",
        first = cells[0], second = cells[1], third = cells[2]
    )]
    CrowdedFace {
        /// Three of the cells, from 0.
        cells: [usize; 3],
        /// The corners of the face, from 0.
        nodes: Vec<usize>,
    },
    /// Two cells lie on the same side of the face that they have in common.
    #[error(
        "cells {first} and {second} are on the same side of their face with the corners {nodes:?}, one in the other",
        first = cells[0], second = cells[1]
    )]
    SameSide {
        /// The cells, from 0.
        cells: [usize; 2],
        /// The corners of the face, from 0.
        nodes: Vec<usize>,
    },
    /// The distance in the search for a node is invalid.
    #[error("a node is looked for within {within} m, which must be zero or positive", within = Readable(*within))]
    Distance {
        /// The distance, m.
        within: f64,
    },
    /// There is no node at a position.
    #[error("no node is at {place:?} m: the nearest is at {nearest:?} m")]
    NoNodeAt {
        /// The position, m.
        place: Vec<f64>,
        /// The position of the nearest node, m.
        nearest: Vec<f64>,
    },
    /// No surface face satisfies a condition.
    #[error("no face of the surface has all its nodes where the condition holds")]
    NoFace,
}
