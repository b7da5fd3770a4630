//! Parts of a mesh.

use eem_material::number::digest::Digest;

/// Some faces on the surface of a mesh, from [`Mesh::face`](crate::Mesh::face). They are valid for copies of the
/// mesh and for equal meshes, but not after it has been moved, mapped or refined.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Face {
    /// The digest of its mesh.
    pub(super) mesh: Digest,
    /// Cells with the number of their face, in ascending order.
    pub(crate) sides: Vec<[usize; 2]>,
    /// Their nodes, each once, in ascending order.
    pub(super) nodes: Vec<usize>,
}

impl Face {
    /// The nodes of the mesh that belong to it, in ascending order.
    #[must_use]
    pub fn nodes(&self) -> &[usize] {
        &self.nodes
    }
}

/// A closed line of nodes, from [`Mesh::outlines`](crate::Mesh::outlines).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Outline {
    /// The cell, from 0.
    pub cell: usize,
    /// Its nodes, from 0, in order; the last is connected to the first.
    pub nodes: Vec<usize>,
}
