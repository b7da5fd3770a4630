//! What can be wrong with a file of Gmsh.

use std::path::PathBuf;

use thiserror::Error;

use crate::number::readable::Readable;
use crate::scene::mesh::MeshError;

/// Why there is no mesh in a file of Gmsh. Nodes, elements and entities are named by their tags.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum MshError {
    /// A file cannot be read.
    #[error("`{path}` cannot be read: {reason}", path = path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// Why.
        reason: String,
    },
    /// The file has another format.
    #[error(
        "the mesh has the format `{found}`, and `4.1 0 8` is read, which is version 4.1 in ASCII: save it by `gmsh -format msh41 -save`, without `-bin`"
    )]
    Format {
        /// What it says of its format.
        found: String,
    },
    /// A section is missing.
    #[error("the mesh has no section `${name}`")]
    Section {
        /// Its name.
        name: &'static str,
    },
    /// A line is not what it has to be.
    #[error(
        "line {line} of the mesh, in `${section}`, is `{found}`: these are not the numbers that have to be there"
    )]
    Line {
        /// The section.
        section: &'static str,
        /// From 1.
        line: usize,
        /// What is there.
        found: String,
    },
    /// A node has two places.
    #[error("node {node} is in the mesh twice")]
    RepeatedNode {
        /// The node.
        node: u64,
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
        /// What it has.
        found: &'static str,
        /// What it has to have.
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
    /// A mesh in the plane is not in one.
    #[error(
        "node {node} is at z = {z} m and others at {first} m: a mesh in the plane has one z",
        z = Readable(*z), first = Readable(*first)
    )]
    Plane {
        /// The node.
        node: u64,
        /// m.
        z: f64,
        /// That of the first node, m.
        first: f64,
    },
    /// Two nodes are in the same place.
    #[error("nodes {first} and {second} are in the same place: remove duplicates in Gmsh by `Coherence Mesh`", first = nodes[0], second = nodes[1])]
    Duplicate {
        /// The nodes.
        nodes: [u64; 2],
    },
    /// Something is wrong with an element.
    #[error("element {element} of the file: {error}")]
    Element {
        /// The element.
        element: u64,
        /// What is wrong, in the numbering of the mesh.
        error: MeshError,
    },
    /// Something else is wrong with the mesh, in its own numbering.
    #[error(transparent)]
    Mesh(#[from] MeshError),
}
