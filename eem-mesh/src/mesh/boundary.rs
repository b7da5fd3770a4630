//! The surface of a mesh, and the areas and volumes of its nodes, `∫ N_a dA` and `∫ N_a dV`.

use super::Mesh;
use super::error::MeshError;
use super::face::{Face, Outline};
use super::sides::with_cells;
use crate::integrals;
use crate::shape::Shape;
use crate::tensor::Symmetric;
use eem_material::number::scalar::Scalar;

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
        let outline = |cell, nodes: &[usize]| Outline {
            cell,
            nodes: interleaved(nodes),
        };
        if D == 2 {
            let cells = self.cells.iter().enumerate();
            return cells
                .map(|(cell, nodes)| outline(cell, nodes.as_ref()))
                .collect();
        }
        let sides = self.surface().into_iter();
        let around = |side: [usize; 2]| outline(side[0], &self.nodes_of(side).collect::<Vec<_>>());
        sides.map(around).collect()
    }

    /// The `Face` of these faces of cells, which ascend.
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

    /// Whether a face belongs to this mesh or to an equal one.
    #[doc(hidden)]
    #[must_use]
    pub fn has(&self, face: &Face) -> bool {
        face.mesh == self.digest
    }

    /// The nodes of a face of a cell.
    #[doc(hidden)]
    pub fn nodes_of(&self, [cell, face]: [usize; 2]) -> impl Iterator<Item = usize> + '_ {
        let nodes = self.cells[cell].as_ref();
        H::FACES[face].iter().map(|&node| nodes[node])
    }

    /// The faces that belong to only one cell, each as this cell and the number of the face.
    #[doc(hidden)]
    #[must_use]
    pub fn surface(&self) -> Vec<[usize; 2]> {
        let mut sides = Vec::new();
        self.for_same_sides(|same| {
            if let &[side] = same {
                sides.push(side);
            }
        });
        sides.sort_unstable();
        sides
    }

    /// Calls a function with the faces of all cells, those with the same nodes together.
    pub(super) fn for_same_sides(&self, mut show: impl FnMut(&[[usize; 2]])) {
        with_cells::<H, D, _>(&self.cells, |cells| {
            cells.for_same(self.nodes.len(), &mut |same| {
                show(same);
                true
            });
        });
    }
}

/// Four corners, each followed by the mid-side node behind it if there is one.
fn interleaved(nodes: &[usize]) -> Vec<usize> {
    let (corners, middles) = nodes.split_at(nodes.len().min(4));
    let next = |at: usize| middles.get(at).copied();
    let pairs = corners.iter().enumerate();
    pairs
        .flat_map(|(at, &corner)| [Some(corner), next(at)])
        .flatten()
        .collect()
}

impl<H: Shape<D>, const D: usize> Mesh<H, D> {
    /// The area of each node of a face; m², m in the plane.
    #[doc(hidden)]
    #[must_use]
    pub fn areas(&self, face: &Face) -> Vec<(usize, f64)> {
        let mut areas = vec![0.0; self.nodes.len()];
        for &[cell, side] in &face.sides {
            let (axis, end) = (side / 2, if side % 2 == 0 { -1.0 } else { 1.0 });
            // The rule of the cell with its points moved to the face, where the weights across sum to 2.
            for (mut place, weight) in integrals::rule::<H, D>() {
                place[axis] = end;
                let (jacobian, functions) = self.jacobian(cell, place);
                let cofactor = H::Tensor::cofactor(&jacobian);
                let size = cofactor
                    .iter()
                    .fold(0.0, |size: f64, row| Scalar::hypot(size, row[axis]));
                for (&node, (share, _)) in self.cells[cell].as_ref().iter().zip(&functions) {
                    areas[node] += share * (0.5 * weight * size);
                }
            }
        }
        let of = |&node: &usize| (node, areas[node]);
        face.nodes().iter().map(of).collect()
    }

    /// The volume of each node; m³, m² in the plane.
    #[doc(hidden)]
    #[must_use]
    pub fn volumes(&self) -> Vec<f64> {
        let mut volumes = vec![0.0; self.nodes.len()];
        for cell in 0..self.cells.len() {
            for (place, weight) in integrals::rule::<H, D>() {
                let (jacobian, functions) = self.jacobian(cell, place);
                let size = weight * H::Tensor::determinant(&jacobian);
                for (&node, (share, _)) in self.cells[cell].as_ref().iter().zip(&functions) {
                    volumes[node] += share * size;
                }
            }
        }
        volumes
    }

    /// `∂X/∂ξ` at a point of the parent cell, with the shape functions.
    fn jacobian(&self, cell: usize, place: [f64; D]) -> ([[f64; D]; D], integrals::Functions<D>) {
        let nodes = self.cells[cell].as_ref().iter();
        let reference: Vec<_> = nodes.map(|&node| self.nodes[node]).collect();
        let functions = integrals::functions::<H, D>(place);
        (integrals::jacobian(&reference, &functions), functions)
    }
}
