//! Errors of Gmsh files.

use std::path::PathBuf;

use thiserror::Error;

use crate::mesh::MeshError;
use eem_material::number::readable::Readable;

/// Why a Gmsh file contains no mesh. Nodes, elements and entities are named by their tags.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum MshError {
    /// A file cannot be read.
    #[error("`{path}` cannot be read: {reason}", path = path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// The reason.
        reason: String,
    },
    /// The format of the file is not supported.
    #[error(
        "the mesh has the format `{found}`, and `4.1 0 8` is read, which is version 4.1 in ASCII: save it by `gmsh -format msh41 -save`, without `-bin`"
    )]
    Format {
        /// The format in the file.
        found: String,
    },
    /// A section is missing.
    #[error("the mesh has no section `${name}`")]
    Section {
        /// Its name.
        name: &'static str,
    },
    /// A line is outside of all sections.
    #[error(
        "line {line} of the mesh is `{found}`, outside of all sections, where only heads like `$Nodes` are"
    )]
    Outside {
        /// The number of the line, from 1.
        line: usize,
        /// The text of the line.
        found: String,
    },
    /// A section has no end.
    #[error(
        "the section `${section}` of the mesh, which begins in line {line}, has no `$End{section}`"
    )]
    Unended {
        /// Its name.
        section: String,
        /// Where it begins, from 1.
        line: usize,
    },
    /// A section appears twice.
    #[error(
        "line {line} of the mesh begins a second section `${name}`, the first begins in line {first}: leave one of them"
    )]
    SecondSection {
        /// The name of both.
        name: String,
        /// Where the first begins, from 1.
        first: usize,
        /// Where the second begins, from 1.
        line: usize,
    },
    /// A line is invalid.
    #[error("line {line} of the mesh, in `${section}`, is `{found}`: {fault}")]
    Line {
        /// The section.
        section: String,
        /// The number of the line, from 1.
        line: usize,
        /// The text of the line.
        found: String,
        /// What is wrong with it.
        fault: LineFault,
    },
    /// An element has a node that does not exist.
    #[error("element {element} has node {node}, which is not in the mesh")]
    NoNode {
        /// The element.
        element: u64,
        /// The node.
        node: u64,
    },
    /// A node belongs to no element.
    #[error(
        "node {node} belongs to no element: delete it, or take entities that do not need it by `Msh::mesh_of`"
    )]
    Orphan {
        /// The node.
        node: u64,
    },
    /// Elements have another shape.
    #[error(
        "entity {entity} has {found}, and {shape} is asked for: recombine it, and set the order of its elements, in Gmsh"
    )]
    WrongElement {
        /// The entity.
        entity: i32,
        /// Its elements.
        found: &'static str,
        /// The requested shape.
        shape: &'static str,
    },
    /// There are no elements of a shape.
    #[error("there are no {shape} elements{of}", of = entity.map_or_else(String::new, |entity| format!(" of entity {entity}")))]
    NoElements {
        /// The shape.
        shape: &'static str,
        /// The entity, if one was asked for.
        entity: Option<i32>,
    },
    /// No face of the surface of a mesh belongs to an entity.
    #[error("no face of the surface of the mesh, as it was read, belongs to entity {entity}")]
    NoFace {
        /// The entity.
        entity: i32,
    },
    /// The nodes of a mesh in the plane do not have the same z.
    #[error(
        "node {node} is at z = {z} m and others at {first} m: a mesh in the plane has one z",
        z = Readable(*z), first = Readable(*first)
    )]
    Plane {
        /// The node.
        node: u64,
        /// Its z, m.
        z: f64,
        /// The z of the first node, m.
        first: f64,
    },
    /// Two nodes are in the same place.
    #[error("nodes {first} and {second} are in the same place: remove duplicates in Gmsh by `Coherence Mesh`", first = nodes[0], second = nodes[1])]
    Duplicate {
        /// The nodes.
        nodes: [u64; 2],
    },
    /// An element is invalid.
    #[error("element {element} of the file: {error}")]
    Element {
        /// The element.
        element: u64,
        /// The error in the numbering of the mesh.
        error: MeshError,
    },
    /// Elements contradict each other.
    #[error("elements {elements:?} of the file: {error}")]
    Elements {
        /// The elements.
        elements: Vec<u64>,
        /// The error in the numbering of the mesh.
        error: MeshError,
    },
    /// Another error of the mesh, in its own numbering.
    #[error(transparent)]
    Mesh(#[from] MeshError),
}

/// Why a line of a Gmsh file is invalid.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum LineFault {
    /// The line has too many or too few numbers, or invalid ones.
    #[error("these are not the numbers that have to be there")]
    Numbers,
    /// The section continues after its last block.
    #[error("the section has to end here, by what its first line says of it")]
    NotTheEnd,
    /// The first line of a section contradicts its blocks.
    #[error(
        "its blocks hold {count} in all, with tags from {least} to {largest}, which the second, third and fourth number have to be",
        least = range[0], largest = range[1]
    )]
    Totals {
        /// How many nodes or elements there are.
        count: usize,
        /// Their least and their largest tag.
        range: [u64; 2],
    },
    /// A tag belongs to two nodes, or to two elements.
    #[error("the tag {tag} is that of line {first} already")]
    Repeated {
        /// The tag.
        tag: u64,
        /// The line that has it first, from 1.
        first: usize,
    },
    /// The dimension of an entity is invalid.
    #[error("the dimension of an entity is 0, 1, 2 or 3, and {found} is given first")]
    EntityDimension {
        /// The dimension.
        found: u64,
    },
    /// The elements of an entity have another dimension than the entity.
    #[error("the entity has the dimension {found}, and its {elements} have the dimension {needed}")]
    Dimension {
        /// The dimension of the entity.
        found: usize,
        /// Its elements.
        elements: &'static str,
        /// The dimension of the elements.
        needed: usize,
    },
    /// The number that tells whether nodes have coordinates within their entity is invalid.
    #[error(
        "the third number is 1 if nodes have coordinates within their entity and else 0, and {found} is given"
    )]
    Parametric {
        /// The number in the file.
        found: u64,
    },
}
