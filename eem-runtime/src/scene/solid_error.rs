//! Errors of solids.

use thiserror::Error;

use crate::element::handle::{Element, Node};
use eem_material::number::readable::Readable;
use eem_mesh::MeshError;

/// Why a solid is rejected.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum SolidError {
    /// A spring has neither stress nor strain.
    #[error(
        "{element} is a spring, which has neither stress nor strain; ask for `stretch` and `force`"
    )]
    NotASolid {
        /// The spring.
        element: Element,
    },
    /// The free energy of an element has no argument with the role `ViscousStrain`.
    #[error("{element} has no viscous strain: its free energy has no `ViscousStrain`")]
    NoViscousStrain {
        /// The element.
        element: Element,
    },
    /// A cell is inverted or has no volume at a point of its reference configuration.
    #[error(
        "det dX/dxi of the solid at {element} is {value} {unit}, it must be positive and finite: give its {order}",
        value = Readable(*value)
    )]
    InsideOut {
        /// The point.
        element: Element,
        /// `det ∂X/∂ξ`.
        value: f64,
        /// Its unit, m² or m³.
        unit: &'static str,
        /// How nodes are ordered.
        order: &'static str,
    },
    /// The number of fibre directions does not match the free energy.
    #[error(
        "the free energy of the solid at {element} has {needed} strains of fibres, and {given} directions are given: add the mesh by `Scene::solid` with one `Bulk::fibre` each"
    )]
    Fibres {
        /// Its first point.
        element: Element,
        /// The number in the free energy.
        needed: usize,
        /// The number of directions.
        given: usize,
    },
    /// The prescribed motion of a node of a solid has no velocity at the start.
    #[error(
        "coordinate {axis} of the motion of {node} has no finite velocity at the start, which the solid there needs: give it finite positions from the start on"
    )]
    AnchorSpeed {
        /// The anchor.
        node: Node,
        /// The axis, from 0.
        axis: usize,
    },
    /// A solid with heat exchange through its surface has no conductivity.
    #[error("the solid at {element} has no conductivity: give it one by `Bulk::conductivity`")]
    NoConductivity {
        /// Its first point.
        element: Element,
    },
    /// A solid has a conductivity but no temperature.
    #[error(
        "the solid at {element} has a conductivity, but no temperature: leave `Bulk::conductivity` out, or take a free energy with an argument `Temperature`"
    )]
    NoTemperature {
        /// Its first point.
        element: Element,
    },
    /// The cells of a conducting solid are too skew: heat would flow in wrong directions.
    #[error(
        "the cells of the solid at {element} are too skew for its conductivity: heat crosses {skew} of {faces} faces between points at a cosine |A·d|/(|A||d|) below 0.95, the worst in cell {cell} at {cosine:.3}, and one in twenty may; use cells that are nearly rectangular, or accept wrong directions of heat by `Bulk::allow_skew_cells`"
    )]
    SkewCells {
        /// Its first point.
        element: Element,
        /// The number of skew faces between points.
        skew: usize,
        /// The number of all faces between points.
        faces: usize,
        /// The cosine between the normal and the heat path of the worst face.
        cosine: f64,
        /// The cell with the worst face, from 0.
        cell: usize,
    },
    /// Two solids with heat conduction between them share no whole face.
    #[error(
        "the solids at {first} and {second} share no whole face that heat could pass: join all nodes of a face by `Bulk::joined_to`, and give both the same cells there",
        first = elements[0], second = elements[1]
    )]
    NoSharedFace {
        /// Their first points.
        elements: [Element; 2],
    },
    /// The distance for a joint is invalid.
    #[error(
        "the solid at {first} is joined to that at {second} within {within} m (`Bulk::joined_to`), which must be finite and not negative",
        first = elements[0], second = elements[1], within = Readable(*within)
    )]
    JointDistance {
        /// The first points of the solid and of the other one.
        elements: [Element; 2],
        /// The distance, m.
        within: f64,
    },
    /// No node is near enough to join two solids.
    #[error(
        "no node of the solid at {first} is within {within} m of one of the solid at {second}, to which it is joined (`Bulk::joined_to`): the nearest are {nearest} m apart; move its mesh, or join within a larger distance",
        first = elements[0], second = elements[1], within = Readable(*within), nearest = Readable(*nearest)
    )]
    NotJoined {
        /// The first points of the solid and of the other one.
        elements: [Element; 2],
        /// The distance within which nodes are joined, m.
        within: f64,
        /// The least distance of two of their nodes, m.
        nearest: f64,
    },
    /// Joining would damage cells of a solid.
    #[error(
        "the solid at {element} is joined within {within} m (`Bulk::joined_to`), and with its nodes where those are that they become, {error}: join within a smaller distance, or move its mesh",
        within = Readable(*within)
    )]
    JoinedNodes {
        /// Its first point.
        element: Element,
        /// The distance within which nodes are joined, m; the largest if there are several.
        within: f64,
        /// The error of the joined mesh.
        error: MeshError,
    },
    /// Joining would put a cell onto one of the other solid.
    #[error(
        "cell {cell} of the solid at {first} is joined (`Bulk::joined_to`) to all nodes of the cell at {second}, and would be in its place: move its mesh",
        first = elements[0], second = elements[1]
    )]
    JoinedCell {
        /// The cell, from 0.
        cell: usize,
        /// The first points of the solid, and of the other cell.
        elements: [Element; 2],
    },
    /// A face does not belong to the mesh of the solid.
    #[error(
        "the face is not of the mesh of the solid at {element}: take it from its own mesh, by `Body::mesh` and `Mesh::face`; a mesh that has been moved or refined has faces of its own"
    )]
    ForeignFace {
        /// Its first point.
        element: Element,
    },
    /// The direction of a fibre is zero or not finite.
    #[error("the direction of a fibre of the solid at {element} must be finite and not zero")]
    Fibre {
        /// Its first point.
        element: Element,
    },
    /// A density, thickness, conductivity or film coefficient is not positive and finite.
    #[error("the {quantity} of the solid at {element} is {value} {unit}, it must be positive and finite", value = Readable(*value))]
    Section {
        /// Its first point.
        element: Element,
        /// The quantity.
        quantity: &'static str,
        /// Its value.
        value: f64,
        /// Its unit.
        unit: &'static str,
    },
    /// A viscous strain is not symmetric, or has shear out of the plane in plane strain.
    #[error(
        "the viscous strain of {element} has {first} in row {row}, column {column} and {second} across the diagonal: it must be symmetric{plane}",
        row = place[0], column = place[1], first = Readable(values[0]), second = Readable(values[1]),
        plane = if *is_plane { ", in plane strain with zeros between the plane and its normal" } else { "" }
    )]
    ViscousShear {
        /// The point.
        element: Element,
        /// Row and column, from 0.
        place: [usize; 2],
        /// The two values that must be equal.
        values: [f64; 2],
        /// Whether this is plane strain.
        is_plane: bool,
    },
}

impl SolidError {
    /// The error of a quantity that is not positive and finite.
    pub(super) fn section(
        element: Element,
        quantity: &'static str,
        value: f64,
        unit: &'static str,
    ) -> Self {
        Self::Section {
            element,
            quantity,
            value,
            unit,
        }
    }
}
