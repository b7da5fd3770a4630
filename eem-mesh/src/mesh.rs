//! Meshes of solids: positions of nodes, and cells of one shape.

mod boundary;
mod check;
mod error;
mod face;
mod geometry;
mod grid;
mod lattice;
mod network;
mod polygon;
mod sides;

pub use error::MeshError;
pub use face::facing;
pub use face::{Face, Outline, Skewness, SubFace};
pub use geometry::{distance, per_node};

use eem_material::number::digest::Digest;
use geometry::mean;
use nalgebra::{Rotation, SVector};

use crate::shape::Shape;

/// A mesh of cells of the shape `H` in `D` dimensions: [`Quad4`](crate::Quad4),
/// [`Quad8`](crate::Quad8), [`Hex8`](crate::Hex8) or [`Hex20`](crate::Hex20).
///
/// Every mesh is valid: `det ∂X/∂ξ` of every cell is positive at its integration points and nodes, every node
/// belongs to a cell, no two nodes coincide, no two cells have the same nodes, and at most two cells share a face
/// (in the plane an edge), one on each side.
///
/// Mid-side nodes may be off the middle as long as `det ∂X/∂ξ` stays positive at the nodes: on a straight edge by
/// less than a quarter of its length. Quarter-point cells, with singular strain at the corner, are rejected, as are
/// corners of 180°.
///
/// ```
/// use eem::kinematics::Hex20;
/// use eem::Mesh;
///
/// let beam = Mesh::<Hex20, 3>::block([4, 1, 1], [[0.0, 4.0], [0.0, 1.0], [0.0, 0.5]])?;
/// assert_eq!((beam.cells().len(), beam.nodes().len()), (4, 56));
///
/// let raised = beam.translated([0.0, 0.0, 1.0])?;
/// assert_eq!(raised.nodes()[0], [0.0, 0.0, 1.0]);
/// # Ok::<(), eem::MeshError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Mesh<H: Shape<D>, const D: usize> {
    nodes: Vec<[f64; D]>,
    cells: Vec<H::PerNode<usize>>,
    /// Tells meshes apart: equal meshes have the same digest.
    digest: Digest,
}

impl<H: Shape<D>, const D: usize> Mesh<H, D> {
    /// A mesh from nodes, m, and for each cell the indices of its nodes in the order of VTK.
    ///
    /// ```
    /// use eem::kinematics::Quad4;
    /// use eem::Mesh;
    ///
    /// let corners = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    /// assert!(Mesh::<Quad4, 2>::new(corners.clone(), vec![[0, 1, 2, 3]]).is_ok());
    ///
    /// // Clockwise.
    /// let error = Mesh::<Quad4, 2>::new(corners, vec![[0, 3, 2, 1]]).unwrap_err();
    /// assert!(error.to_string().starts_with("cell 0 is inside out: det dX/dxi is -0.25 m^2"));
    /// ```
    ///
    /// # Errors
    ///
    /// [`MeshError`] names the first invalid node or cell.
    pub fn new(nodes: Vec<[f64; D]>, cells: Vec<H::PerNode<usize>>) -> Result<Self, MeshError> {
        check::check::<H, D>(&nodes, &cells)?;
        let digest = Digest::of(|digest| {
            digest.count(nodes.len());
            for &coordinate in nodes.as_flattened() {
                // −0 and 0 are the same position.
                digest.number(coordinate + 0.0);
            }
            for &node in cells.iter().flat_map(AsRef::as_ref) {
                digest.count(node);
            }
        });
        Ok(Self {
            nodes,
            cells,
            digest,
        })
    }

    /// The positions of the nodes, m.
    #[must_use]
    pub fn nodes(&self) -> &[[f64; D]] {
        &self.nodes
    }

    /// The nodes of each cell.
    #[must_use]
    pub fn cells(&self) -> &[H::PerNode<usize>] {
        &self.cells
    }

    /// The mesh moved by a vector, m.
    ///
    /// # Errors
    ///
    /// If a coordinate is not finite, or two nodes coincide after rounding.
    pub fn translated(&self, by: [f64; D]) -> Result<Self, MeshError> {
        self.mapped(|place| core::array::from_fn(|axis| place[axis] + by[axis]))
    }

    /// The mesh rotated about the origin.
    ///
    /// ```
    /// use core::f64::consts::PI;
    /// use eem::kinematics::Hex8;
    /// use eem::Mesh;
    /// use eem::nalgebra::{Rotation3, Vector3};
    ///
    /// let panel = Mesh::<Hex8, 3>::block([4, 2, 1], [[0.5, 4.5], [-0.5, 0.5], [-0.05, 0.05]])?;
    /// let opposite = panel.rotated(&Rotation3::new(PI * Vector3::z()))?;
    /// assert!((opposite.nodes()[0][0] + 0.5).abs() < 1e-15);
    /// # Ok::<(), eem::MeshError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// If two nodes coincide after rounding.
    pub fn rotated(&self, by: &Rotation<f64, D>) -> Result<Self, MeshError> {
        self.mapped(|place| (by.matrix() * SVector::from(place)).into())
    }

    /// The mesh with every node moved by a function.
    ///
    /// ```
    /// use eem::kinematics::Quad4;
    /// use eem::Mesh;
    ///
    /// // Cook's membrane.
    /// let square = Mesh::<Quad4, 2>::block([2, 2], [[0.0, 1.0]; 2])?;
    /// let membrane = square.mapped(|[x, y]| [48.0 * x, 44.0 * x + y * (44.0 - 28.0 * x)])?;
    /// assert_eq!(membrane.nodes()[8], [48.0, 60.0]);
    /// # Ok::<(), eem::MeshError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// If a cell becomes inverted, a coordinate is not finite, or two nodes coincide.
    pub fn mapped(&self, map: impl Fn([f64; D]) -> [f64; D]) -> Result<Self, MeshError> {
        let nodes = self.nodes.iter().map(|&place| map(place)).collect();
        Self::new(nodes, self.cells.clone())
    }

    /// The cells whose centre, the mean of their nodes, satisfies a condition; the rest is cut away.
    ///
    /// ```
    /// use eem::kinematics::Quad4;
    /// use eem::Mesh;
    ///
    /// let square = Mesh::<Quad4, 2>::block([2, 2], [[0.0, 2.0]; 2])?;
    /// let angle = square.kept(|[x, y]| x < 1.0 || y < 1.0)?;
    /// assert_eq!((angle.cells().len(), angle.nodes().len()), (3, 8));
    /// # Ok::<(), eem::MeshError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`MeshError::Empty`] if there are no such cells.
    pub fn kept(&self, condition: impl Fn([f64; D]) -> bool) -> Result<Self, MeshError> {
        let centre =
            |cell: &H::PerNode<usize>| mean(cell.as_ref().iter().map(|&node| self.nodes[node]));
        let cells = self.cells.iter().filter(|cell| condition(centre(cell)));
        let mut cells: Vec<_> = cells.copied().collect();
        let mut indices = vec![None; self.nodes.len()];
        let named = cells.iter().flat_map(AsRef::as_ref);
        named.for_each(|&node| indices[node] = Some(0));
        let mut nodes = Vec::new();
        for (index, &place) in indices.iter_mut().zip(&self.nodes) {
            if let Some(index) = index {
                *index = nodes.len();
                nodes.push(place);
            }
        }
        for node in cells.iter_mut().flat_map(AsMut::as_mut) {
            *node = indices[*node].unwrap_or(usize::MAX);
        }
        Self::new(nodes, cells)
    }
}
