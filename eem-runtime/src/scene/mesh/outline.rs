//! What there is to draw of a mesh.

use super::Mesh;
use super::face::Outline;
use crate::element::kinematics::Shape;

impl<H: Shape<D>, const D: usize> Mesh<H, D> {
    /// Lines for drawing the mesh: around each cell in the plane, around each surface face in space,
    /// counterclockwise seen from outside. Mid-side nodes lie between their corners.
    ///
    /// ```
    /// use eem::Mesh;
    /// use eem::kinematics::{Hex8, Quad8};
    ///
    /// let square = Mesh::<Quad8, 2>::block([1, 1], [[0.0, 2.0]; 2])?;
    /// let outlines = square.outlines();
    /// let around = outlines[0].nodes.iter().map(|&node| square.nodes()[node]);
    /// assert_eq!(around.take(3).collect::<Vec<_>>(), [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]]);
    ///
    /// // The faces between cells are not to be seen.
    /// let cube = Mesh::<Hex8, 3>::block([2, 2, 2], [[0.0, 1.0]; 3])?;
    /// assert_eq!(cube.outlines().len(), 6 * 4);
    /// # Ok::<(), eem::MeshError>(())
    /// ```
    #[must_use]
    pub fn outlines(&self) -> Vec<Outline> {
        if D == 2 {
            let cells = self.cells.iter().enumerate();
            let around = |(cell, nodes): (usize, &H::PerNode<usize>)| Outline {
                cell,
                nodes: interleaved(nodes.as_ref()),
            };
            return cells.map(around).collect();
        }
        let around = |side: [usize; 2]| Outline {
            cell: side[0],
            nodes: interleaved(&self.nodes_of(side).collect::<Vec<_>>()),
        };
        self.surface().into_iter().map(around).collect()
    }
}

/// Four corners, with the middles of edges that follow them in between.
fn interleaved(nodes: &[usize]) -> Vec<usize> {
    let (corners, middles) = nodes.split_at(nodes.len().min(4));
    let next = |at: usize| middles.get(at).copied();
    let pairs = corners.iter().enumerate();
    pairs
        .flat_map(|(at, &corner)| [Some(corner), next(at)])
        .flatten()
        .collect()
}
