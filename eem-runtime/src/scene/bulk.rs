//! Bodies, which are solids of a scene with their meshes, nodes and points; their properties, and their joints with others.

use crate::element::handle::{Element, Node};
use crate::element::kinematics::Shape;
use crate::scene::solid_error::SolidError;
use eem_mesh::{Mesh, MeshError, distance};
#[cfg(feature = "gradients")]
use eem_mesh::{integrals, per_node};

/// The properties of a solid besides its material and mesh: density, thickness, fibres, conduction, joints.
///
/// ```
/// use eem::Bulk;
///
/// let rubber = Bulk::<3>::new(1100.0).fibre([0.0, 0.0, 1.0]);
/// let tin = Bulk::<2>::new(7300.0).thickness(1e-3).lumped();
/// ```
#[derive(Clone, Debug)]
pub struct Bulk<const D: usize> {
    pub(super) density: f64,
    /// Thickness, m; one in space.
    pub(super) thickness: f64,
    /// Conductivity, W/(m K).
    pub(super) conductivity: Option<f64>,
    pub(super) allow_skew_cells: bool,
    pub(super) fibres: Vec<[f64; D]>,
    pub(super) lumped: bool,
    pub(super) joints: Vec<Joint<D>>,
}

impl<const D: usize> Bulk<D> {
    /// A solid with a density, kg/m³; in the plane 1 m thick.
    #[must_use]
    pub fn new(density: f64) -> Self {
        Self {
            density,
            thickness: 1.0,
            conductivity: None,
            allow_skew_cells: false,
            fibres: Vec::new(),
            lumped: false,
            joints: Vec::new(),
        }
    }

    /// Fourier's law with a conductivity, W/(m K). Without it the integration points are thermally insulated.
    ///
    /// Cells must be nearly rectangular, see [`Mesh::skew_faces`](crate::Mesh::skew_faces); otherwise the error is
    /// [`SolidError::SkewCells`](crate::SolidError::SkewCells).
    #[must_use]
    pub fn conductivity(mut self, conductivity: f64) -> Self {
        self.conductivity = Some(conductivity);
        self
    }

    /// Allows conduction in skew cells. Heat then flows along the lines of the mesh instead of down the gradient of
    /// the temperature, and refining the mesh does not help:
    ///
    /// ```text
    /// Q = −K ∇θ,   K = k Σ d̂ ⊗ d̂     d̂ the unit vectors along the lines of the mesh
    /// ```
    ///
    /// In cells sheared by 0.3, K has off-diagonal entries of 0.28 k. Energy is still conserved and entropy still
    /// grows.
    ///
    /// ```
    /// use eem::materials::ThermoelasticSolid;
    /// use eem::prelude::*;
    ///
    /// let square = Mesh::<Quad4, 2>::block([2, 2], [[0.0, 1.0]; 2])?;
    /// let sheared = square.mapped(|[x, y]| [x + 0.5 * y, y])?;
    /// let errors = |bulk: &Bulk<2>| {
    ///     let mut scene = Scene::<2>::new();
    ///     scene.solid(ThermoelasticSolid::RUBBER, &sheared, bulk);
    ///     scene.errors().len()
    /// };
    /// let bulk = Bulk::new(10.0).conductivity(20.0);
    /// assert_eq!((errors(&bulk), errors(&bulk.clone().allow_skew_cells())), (1, 0));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn allow_skew_cells(mut self) -> Self {
        self.allow_skew_cells = true;
        self
    }

    /// The direction of the next fibre, for the next argument with the role `FibreStrain`. Its length is ignored.
    #[must_use]
    pub fn fibre(mut self, direction: [f64; D]) -> Self {
        self.fibres.push(direction);
        self
    }

    /// Uses a lumped mass instead of the consistent one: row sums for cells with corner nodes only, otherwise
    /// masses proportional to the diagonal. This changes moments of inertia: that of a cube with n cells per side
    /// (corner nodes only) becomes 1 + 2/n² times as large.
    #[must_use]
    pub fn lumped(mut self) -> Self {
        self.lumped = true;
        self
    }

    /// Joins this solid to another: a node within the distance `within`, m, of a node of the other solid becomes
    /// that node (the nearest). Such joints transmit forces and no torques.
    ///
    /// ```
    /// use eem::materials::SaintVenantKirchhoff;
    /// use eem::prelude::*;
    ///
    /// let mut scene = Scene::<2>::new();
    /// let steel = SaintVenantKirchhoff { lame: 2000.0, shear: 1000.0 };
    /// let mesh = Mesh::<Quad4, 2>::block([1, 1], [[0.0, 1.0]; 2])?;
    /// let first = scene.solid(steel.clone(), &mesh, &Bulk::new(10.0));
    /// let joined = Bulk::new(10.0).joined_to(&first, 1e-9);
    /// let second = scene.solid(steel, &mesh.translated([1.0, 0.0])?, &joined);
    /// assert_eq!(second.nodes()[0], first.nodes()[1]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`Simulation::new`](crate::Simulation::new) returns
    /// [`SolidError::JointDistance`](crate::SolidError::JointDistance) for an invalid distance,
    /// [`SolidError::NotJoined`](crate::SolidError::NotJoined) if no node is near enough,
    /// [`SolidError::JoinedNodes`](crate::SolidError::JoinedNodes) if two nodes of a cell would become one, and
    /// [`SolidError::JoinedCell`](crate::SolidError::JoinedCell) if a cell would coincide with one of the other
    /// solid.
    #[must_use]
    pub fn joined_to<H: Shape<D>>(mut self, other: &Body<H, D>, within: f64) -> Self {
        self.joints.push(Joint::new(other, within));
        self
    }
}

impl Bulk<2> {
    /// The thickness out of the plane, m.
    #[must_use]
    pub fn thickness(mut self, thickness: f64) -> Self {
        self.thickness = thickness;
        self
    }
}

/// Another solid, with whose nodes those of a new mesh are merged within a distance.
#[derive(Clone, Debug)]
pub(super) struct Joint<const D: usize> {
    /// The first point of the other solid.
    other: Element,
    /// Sorted by the first coordinate.
    nodes: Vec<Shared<D>>,
    /// The largest distance of merged nodes, m.
    within: f64,
}

/// A node of another solid and its position, m.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shared<const D: usize> {
    pub(super) node: Node,
    place: [f64; D],
}

impl<const D: usize> Joint<D> {
    pub(super) fn new<H: Shape<D>>(other: &Body<H, D>, within: f64) -> Self {
        let places = other.mesh().nodes().iter();
        let nodes = other.nodes().iter().zip(places);
        let mut nodes: Vec<_> = nodes
            .map(|(&node, &place)| Shared { node, place })
            .collect();
        nodes.sort_by(|a, b| a.place[0].total_cmp(&b.place[0]));
        Self {
            other: other.first(),
            nodes,
            within,
        }
    }

    /// The nearest node within the distance from a position, and how far it is, m.
    fn nearest(&self, place: [f64; D]) -> Option<(f64, Shared<D>)> {
        let is_before = |shared: &Shared<D>| place[0] - shared.place[0] > self.within;
        let from = self.nodes.partition_point(is_before);
        let near = self.nodes[from..].iter();
        let near = near.take_while(|shared| shared.place[0] - place[0] <= self.within);
        let near = near.map(|&shared| (distance(place, shared.place), shared));
        let near = near.filter(|(distance, _)| *distance <= self.within);
        near.min_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// The error that no node of a mesh is near enough.
    fn too_far<H: Shape<D>>(&self, mesh: &Mesh<H, D>, element: Element) -> SolidError {
        let unlimited = Self {
            within: f64::INFINITY,
            ..self.clone()
        };
        let places = mesh.nodes().iter();
        let nearest = places.filter_map(|&place| unlimited.nearest(place));
        SolidError::NotJoined {
            elements: [element, self.other],
            within: self.within,
            nearest: nearest.fold(f64::INFINITY, |least, (distance, _)| least.min(distance)),
        }
    }
}

/// For each node of a mesh the node of another solid with which it is merged, if there is one.
pub(super) fn joined<H: Shape<D>, const D: usize>(
    joints: &[Joint<D>],
    mesh: &Mesh<H, D>,
    element: Element,
) -> Result<Vec<Option<Shared<D>>>, SolidError> {
    let mut nearest: Vec<Option<(f64, Shared<D>)>> = vec![None; mesh.nodes().len()];
    for joint in joints {
        let elements = [element, joint.other];
        let within = joint.within;
        if !(within >= 0.0 && within.is_finite()) {
            return Err(SolidError::JointDistance { elements, within });
        }
        let mut is_joined = false;
        for (known, &place) in nearest.iter_mut().zip(mesh.nodes()) {
            let Some(found) = joint.nearest(place) else {
                continue;
            };
            is_joined = true;
            if known.is_none_or(|(distance, _)| found.0 < distance) {
                *known = Some(found);
            }
        }
        if !is_joined {
            return Err(joint.too_far(mesh, element));
        }
    }
    let mut known = nearest.iter().flatten();
    if known.any(|(distance, _)| *distance > 0.0) {
        // The mesh must be valid with its nodes in their new positions.
        let places = mesh.nodes().iter().zip(&nearest);
        let places = places.map(|(&place, known)| known.map_or(place, |(_, shared)| shared.place));
        let checked = Mesh::<H, D>::new(places.collect(), mesh.cells().to_vec());
        let within = joints.iter().map(|joint| joint.within);
        checked.map_err(|error| SolidError::JoinedNodes {
            element,
            within: within.fold(0.0, f64::max),
            error,
        })?;
    }
    let shared = nearest.into_iter().map(|known| Some(known?.1));
    Ok(shared.collect())
}

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
