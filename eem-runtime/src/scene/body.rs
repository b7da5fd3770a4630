//! Bodies: solids of a scene with their meshes, nodes and points.

use crate::element::handle::{Element, Node};
use crate::element::kinematics::Shape;
#[cfg(feature = "gradients")]
#[cfg(feature = "gradients")]
use eem_mesh::integrals;
#[cfg(feature = "gradients")]
use eem_mesh::per_node;
use eem_mesh::{Mesh, MeshError, distance};

/// A solid of a scene: its mesh and the handles of its nodes and integration points, in the reference
/// configuration.
///
/// ```
/// use eem::materials::SaintVenantKirchhoff;
/// use eem::prelude::*;
///
/// let mut scene = Scene::<3>::new();
/// let steel = SaintVenantKirchhoff { lame: 2000.0, shear: 1000.0 };
/// let mesh = Mesh::<Hex8, 3>::block([2, 1, 1], [[0.0, 2.0], [0.0, 1.0], [0.0, 1.0]])?;
/// let body = scene.solid(steel, &mesh, &Bulk::new(10.0));
/// // Twelve nodes, and eight points per hexahedron of eight nodes.
/// assert_eq!((body.nodes().len(), body.points().len()), (12, 16));
/// assert_eq!(body.nodes_where(|[x, ..]| x >= 2.0).len(), 4);
/// assert_eq!(body.node_at([2.0, 0.0, 0.0], 1e-9)?, body.nodes()[2]);
/// let error = body.node_at([2.0, 0.5, 0.0], 1e-9).unwrap_err();
/// assert!(error.to_string().starts_with("no node is at [2.0, 0.5, 0.0] m: the nearest is at [2.0,"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Body<H: Shape<D>, const D: usize> {
    pub(super) mesh: Mesh<H, D>,
    pub(super) nodes: Vec<Node>,
    pub(super) points: Vec<Element>,
    /// Thickness, m; one in space.
    pub(super) thickness: f64,
    /// Conductivity, W/(m K).
    pub(super) conductivity: Option<f64>,
    #[cfg(feature = "gradients")]
    pub(super) is_lumped: bool,
}

impl<H: Shape<D>, const D: usize> Body<H, D> {
    /// Its mesh.
    #[must_use]
    pub fn mesh(&self) -> &Mesh<H, D> {
        &self.mesh
    }

    /// The handles of its nodes, in the order of the mesh.
    #[must_use]
    pub fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// The masses of pairs of nodes at unit density, of one cell after the other, m³; the lower index comes first.
    #[cfg(feature = "gradients")]
    pub(crate) fn pair_masses(&self) -> impl Iterator<Item = ([usize; 2], f64)> {
        self.mesh.cells().iter().flat_map(|cell| {
            let places = self.mesh.nodes();
            let reference = per_node::<H, _, D>(|at| places[cell[at]]);
            let mut masses = integrals::masses::<H, D>(&reference, self.thickness);
            if self.is_lumped {
                integrals::lump::<H, D>(&mut masses);
            }
            let nodes = per_node::<H, _, D>(|at| self.nodes[cell[at]].index);
            let count = nodes.as_ref().len();
            let pairs = (0..count).flat_map(|a| (0..=a).map(move |b| [a, b]));
            pairs.map(move |[a, b]| {
                let [i, j] = [nodes[a], nodes[b]];
                ([i.min(j), i.max(j)], masses[a][b])
            })
        })
    }

    /// The handles of its integration points, cell by cell; the first coordinate of a cell varies fastest.
    #[must_use]
    pub fn points(&self) -> &[Element] {
        &self.points
    }

    /// Its first point, which names it in errors.
    pub(super) fn first(&self) -> Element {
        self.points[0]
    }

    /// The nodes whose position in the reference configuration satisfies a condition.
    pub fn nodes_where(&self, condition: impl Fn([f64; D]) -> bool) -> Vec<Node> {
        let all = self.mesh.nodes().iter().zip(&self.nodes);
        let found = all.filter(|(place, _)| condition(**place));
        found.map(|(_, &node)| node).collect()
    }

    /// The node nearest to a position of the reference configuration, m, at most `within` away.
    ///
    /// # Errors
    ///
    /// [`MeshError::NoNodeAt`] contains the position of the nearest node. [`MeshError::Distance`] if `within` is
    /// invalid.
    pub fn node_at(&self, place: [f64; D], within: f64) -> Result<Node, MeshError> {
        if within.is_nan() || within < 0.0 {
            return Err(MeshError::Distance { within });
        }
        let all = self.mesh.nodes().iter().zip(&self.nodes);
        let distances = all.map(|(other, &node)| (distance(place, *other), other, node));
        let nearest = distances.min_by(|a, b| a.0.total_cmp(&b.0));
        match nearest {
            Some((distance, _, node)) if distance <= within => Ok(node),
            nearest => Err(MeshError::NoNodeAt {
                place: place.to_vec(),
                nearest: nearest.map_or_else(Vec::new, |(_, place, _)| place.to_vec()),
            }),
        }
    }
}
