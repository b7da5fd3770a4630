//! The surface of a mesh.

use core::convert::Infallible;

use super::Mesh;
use super::error::MeshError;
use super::face::Face;
use super::sides;
use crate::element::kinematics::Shape;

impl<H: Shape<D>, const D: usize> Mesh<H, D> {
    /// The surface faces whose nodes all satisfy a condition.
    ///
    /// ```
    /// use eem::kinematics::Hex8;
    /// use eem::{Mesh, MeshError};
    ///
    /// let cube = Mesh::<Hex8, 3>::block([2, 2, 2], [[0.0, 1.0]; 3])?;
    /// assert_eq!(cube.face(|[x, ..]| x == 1.0)?.nodes().len(), 9);
    /// // Inside there is no surface.
    /// assert_eq!(cube.face(|[x, ..]| x == 0.5), Err(MeshError::NoFace));
    /// # Ok::<(), MeshError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`MeshError::NoFace`] if there are none.
    pub fn face(&self, condition: impl Fn([f64; D]) -> bool) -> Result<Face, MeshError> {
        let holds: Vec<bool> = self.nodes.iter().map(|&place| condition(place)).collect();
        let mut sides = self.surface();
        sides.retain(|&side| self.nodes_of(side).all(|node| holds[node]));
        self.face_of(sides)
    }

    /// These faces of cells, in ascending order.
    pub(crate) fn face_of(&self, sides: Vec<[usize; 2]>) -> Result<Face, MeshError> {
        if sides.is_empty() {
            return Err(MeshError::NoFace);
        }
        let mut nodes: Vec<_> = sides.iter().flat_map(|&side| self.nodes_of(side)).collect();
        nodes.sort_unstable();
        nodes.dedup();
        let mesh = self.digest;
        Ok(Face { mesh, sides, nodes })
    }

    /// Whether some faces are faces of this mesh, or of one that is equal to it.
    pub(crate) fn has(&self, face: &Face) -> bool {
        face.mesh == self.digest
    }

    /// The nodes of a face of a cell.
    pub(crate) fn nodes_of(&self, [cell, face]: [usize; 2]) -> impl Iterator<Item = usize> + '_ {
        let nodes = self.cells[cell].as_ref();
        H::FACES[face].iter().map(|&node| nodes[node])
    }

    /// The faces that belong to one cell.
    pub(crate) fn surface(&self) -> Vec<[usize; 2]> {
        let mut sides = Vec::new();
        self.for_same_sides(|same| {
            if let &[side] = same {
                sides.push(side);
            }
        });
        sides.sort_unstable();
        sides
    }

    /// Shows the faces of all cells, those with the same nodes at once.
    pub(super) fn for_same_sides(&self, mut show: impl FnMut(&[[usize; 2]])) {
        let shown = sides::for_same::<H, D, Infallible>(&self.cells, self.nodes.len(), |same| {
            show(same);
            Ok(())
        });
        match shown {
            Ok(()) => {}
        }
    }
}
