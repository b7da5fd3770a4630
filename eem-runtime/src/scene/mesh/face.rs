//! Parts of the surface of a mesh.

/// Some faces of the surface of a mesh, from [`Mesh::face`](crate::Mesh::face).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Face {
    /// Cells with the number of their face.
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

/// A line of nodes around a part of a mesh, from [`Mesh::outlines`](crate::Mesh::outlines).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Outline {
    /// The cell, from 0.
    pub cell: usize,
    /// Its nodes, from 0, one after the other around it; the first follows the last.
    pub nodes: Vec<usize>,
}
