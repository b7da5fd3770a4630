//! Parts of a mesh, and digests that tell meshes apart.

use core::hash::Hasher;
use std::hash::DefaultHasher;

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

/// A hash of the positions of all nodes, bit by bit, and of the nodes of all cells. Equal meshes have the same one,
/// other meshes with a probability of 2⁻⁶⁴.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Digest(u64);

impl Digest {
    pub(super) fn of<C: AsRef<[usize]>, const D: usize>(nodes: &[[f64; D]], cells: &[C]) -> Self {
        let mut hasher = DefaultHasher::new();
        hasher.write_usize(nodes.len());
        for coordinate in nodes.as_flattened() {
            // −0 and 0 are the same position.
            hasher.write_u64((coordinate + 0.0).to_bits());
        }
        for &node in cells.iter().flat_map(AsRef::as_ref) {
            hasher.write_usize(node);
        }
        Self(hasher.finish())
    }
}
