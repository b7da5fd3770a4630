//! Solids from meshes.

use nalgebra::SVector;

use super::Scene;
use crate::element::handle::{Element, Node};
use crate::element::kinematics::{Points, Shape, StrainEnergy};
use crate::material::free_energy::{Array, FreeEnergy};
use crate::number::scalar::Real;
use crate::scene::cell::Stuff;
use crate::scene::error::SceneError;
use crate::scene::mesh::{Mesh, MeshError, distance};

/// What a solid is besides its material and its mesh.
///
/// ```
/// use eem::Bulk;
///
/// let rubber = Bulk::<3>::new(1100.0).fibre([0.0, 0.0, 1.0]);
/// let tin = Bulk::<2>::new(7300.0).thickness(1e-3).lumped();
/// ```
#[derive(Clone, Debug)]
pub struct Bulk<const D: usize, S = f64> {
    density: S,
    /// m; one in space.
    thickness: f64,
    /// W/(m K).
    conductivity: Option<f64>,
    allow_skew_cells: bool,
    fibres: Vec<[S; D]>,
    lumped: bool,
    joints: Vec<Joint<D>>,
}

/// A node of another solid, of which nodes in its place, m, and not farther away than a distance, m, become
/// part.
#[derive(Clone, Copy, Debug)]
struct Joint<const D: usize> {
    node: Node,
    place: [f64; D],
    within: f64,
}

impl<const D: usize, S: Real> Bulk<D, S> {
    /// Of some density, kg/m³, in the plane 1 m thick.
    #[must_use]
    pub fn new(density: S) -> Self {
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

    /// Fourier's law with a conductivity, W/(m K): paths of heat between all neighbouring points, in the
    /// reference configuration. Without it points are insulated from each other.
    ///
    /// Cells have to be nearly rectangular, see [`Mesh::skew_faces`]; if they are not, the scene is refused with
    /// [`SolidError::SkewCells`](crate::SolidError::SkewCells).
    #[must_use]
    pub fn conductivity(mut self, conductivity: f64) -> Self {
        self.conductivity = Some(conductivity);
        self
    }

    /// Conducts also where cells are skew. Heat then flows along the lines of the mesh and not against the gradient
    /// of the temperature, however fine the mesh is:
    ///
    /// ```text
    /// Q = −K ∇θ,   K = k Σ d̂ ⊗ d̂     d̂ the unit vectors along the lines of the mesh
    /// ```
    ///
    /// In cells sheared by 0.3, K has 0.28 k off its diagonal. Energy is kept and entropy grows as they should.
    ///
    /// ```
    /// use eem::kinematics::Quad4;
    /// use eem::prelude::*;
    /// use eem::SolidError;
    /// # #[derive(Clone, FreeEnergy)]
    /// # #[free_energy(|e1: StrainTrace, e2: StrainSquare, theta: Temperature| {
    /// #     0.5 * lame * e1.powi(2) + shear * e2 + c * (theta - theta * ln(theta / 300.0))
    /// # })]
    /// # struct Solid { lame: f64, shear: f64, c: f64 }
    ///
    /// let square = Mesh::<Quad4, 2>::block([2, 2], [[0.0, 1.0]; 2])?;
    /// let sheared = square.mapped(|[x, y]| [x + 0.5 * y, y])?;
    /// let build = |bulk: Bulk<2>| {
    ///     let mut scene = Scene::<2>::new();
    ///     let body = scene.solid(Solid { lame: 2000.0, shear: 1000.0, c: 100.0 }, &sheared, &bulk);
    ///     body.points().iter().for_each(|&point| scene.set_temperature(point, 300.0));
    ///     Simulation::new(scene, Scheme::EemTemperature, 0.1)
    /// };
    /// let bulk = Bulk::new(10.0).conductivity(20.0);
    /// let error = build(bulk.clone()).unwrap_err().into();
    /// assert!(matches!(
    ///     error,
    ///     SceneError::Solid(SolidError::SkewCells { skew: 24, faces: 24, .. })
    /// ));
    /// assert!(build(bulk.allow_skew_cells()).is_ok());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn allow_skew_cells(mut self) -> Self {
        self.allow_skew_cells = true;
        self
    }

    /// The direction of the next fibre, for the next argument of the role `FibreStrain`. Its length means
    /// nothing.
    #[must_use]
    pub fn fibre(mut self, direction: [S; D]) -> Self {
        self.fibres.push(direction);
        self
    }

    /// A mass per node that couples no others, instead of the consistent one: sums of rows for shapes with
    /// corners only, shares like the diagonal for the others. It changes moments of inertia: that of a cube
    /// of n cells per side, of corners only, is 1 + 2/n² times as large.
    #[must_use]
    pub fn lumped(mut self) -> Self {
        self.lumped = true;
        self
    }

    /// Makes nodes that are at most a distance, m, away from a node of another solid that node: joints that
    /// transmit forces and no torques.
    #[must_use]
    pub fn joined_to<H: Shape<D>>(mut self, other: &Body<H, D>, within: f64) -> Self {
        let nodes = other.nodes.iter().zip(other.mesh.nodes());
        self.joints.extend(nodes.map(|(&node, &place)| Joint {
            node,
            place,
            within,
        }));
        self
    }

    /// The first node of another solid in a place.
    fn joint(&self, place: [f64; D]) -> Option<Node> {
        let is_near = |joint: &&Joint<D>| distance(place, joint.place) <= joint.within;
        self.joints.iter().find(is_near).map(|joint| joint.node)
    }
}

impl<S: Real> Bulk<2, S> {
    /// Out of the plane, m.
    #[must_use]
    pub fn thickness(mut self, thickness: f64) -> Self {
        self.thickness = thickness;
        self
    }
}

/// A solid of a scene: its mesh, with the handles of its nodes and of the points where its free energy is
/// evaluated. It stays with the reference configuration.
#[derive(Clone, Debug)]
pub struct Body<H: Shape<D>, const D: usize> {
    mesh: Mesh<H, D>,
    nodes: Vec<Node>,
    points: Vec<Element>,
    thickness: f64,
    conductivity: Option<f64>,
}

impl<H: Shape<D>, const D: usize> Body<H, D> {
    /// Its mesh.
    #[must_use]
    pub fn mesh(&self) -> &Mesh<H, D> {
        &self.mesh
    }

    /// Its nodes, as in the mesh.
    #[must_use]
    pub fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// Its points, cell after cell, the first coordinate of a cell fastest.
    #[must_use]
    pub fn points(&self) -> &[Element] {
        &self.points
    }

    /// m; one in space.
    pub(super) fn thickness(&self) -> f64 {
        self.thickness
    }

    /// W/(m K).
    pub(super) fn conductivity(&self) -> Option<f64> {
        self.conductivity
    }

    /// The nodes where a condition holds in the reference configuration.
    pub fn nodes_where(&self, condition: impl Fn([f64; D]) -> bool) -> Vec<Node> {
        let all = self.mesh.nodes().iter().zip(&self.nodes);
        let found = all.filter(|(place, _)| condition(**place));
        found.map(|(_, &node)| node).collect()
    }

    /// The node that is at a place of the reference configuration, m, or not farther away than `within`.
    ///
    /// # Errors
    ///
    /// [`MeshError::NoNodeAt`] says where the nearest node is.
    pub fn node_at(&self, place: [f64; D], within: f64) -> Result<Node, MeshError> {
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

/// # Solids from meshes
impl<const D: usize, S: Real> Scene<D, S> {
    /// A solid at rest, free of strain where its mesh is: in space, or in plane strain.
    ///
    /// Every point has a temperature and viscous strains of its own; handles of points are what
    /// [`conduct`](Self::conduct) and [`set_temperature`](Self::set_temperature) take. Schemes are those of
    /// a [`quadrilateral`](Scene::quadrilateral).
    ///
    /// ```
    /// use eem::kinematics::Hex8;
    /// use eem::prelude::*;
    ///
    /// /// Saint-Venant and Kirchhoff, with a fibre.
    /// #[derive(Clone, FreeEnergy)]
    /// #[free_energy(|e1: StrainTrace, e2: StrainSquare, e4: FibreStrain| {
    ///     0.5 * lame * e1.powi(2) + shear * e2 + 0.5 * fibre * e4.powi(2)
    /// })]
    /// struct Reinforced {
    ///     lame: f64,
    ///     shear: f64,
    ///     fibre: f64,
    /// }
    ///
    /// let mut scene = Scene::<3>::new();
    /// let rubber = Reinforced { lame: 2000.0, shear: 1000.0, fibre: 500.0 };
    /// let mesh = Mesh::<Hex8, 3>::block([2, 1, 1], [[0.0, 2.0], [0.0, 1.0], [0.0, 1.0]])?;
    /// let beam = scene.solid(rubber, &mesh, &Bulk::new(10.0).fibre([1.0, 0.0, 0.0]));
    /// for (&node, [x, ..]) in beam.nodes().iter().zip(mesh.nodes()) {
    ///     scene.set_velocity(node, [0.0, *x, 0.0]);
    /// }
    /// scene.fix(beam.node_at([0.0, 0.0, 0.0], 0.0)?);
    ///
    /// let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.05)?;
    /// let before = run.ledger();
    /// run.step()?;
    /// let change = run.ledger().balance - before.balance;
    /// assert!(change.abs() < 1e-14 * before.energy);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[expect(clippy::needless_pass_by_value, reason = "as for a spring")]
    pub fn solid<H, M, const N: usize>(
        &mut self,
        model: M,
        mesh: &Mesh<H, D>,
        bulk: &Bulk<D, S>,
    ) -> Body<H, D>
    where
        H: Shape<D>,
        M: FreeEnergy<S> + StrainEnergy<N> + Send + Sync + 'static,
    {
        let places = mesh.nodes().iter();
        let nodes: Vec<Node> = places
            .map(|&place| match bulk.joint(place) {
                Some(node) => node,
                None => self.node(place.map(S::from_f64), [S::zero(); D]),
            })
            .collect();
        let stuff = Stuff {
            density: bulk.density,
            thickness: S::from_f64(bulk.thickness),
            fibres: &bulk.fibres,
            lumped: bulk.lumped,
        };
        let mut points = Vec::with_capacity(mesh.cells().len() * H::PerPoint::<Element>::LEN);
        for cell in mesh.cells() {
            let mut named = H::PerNode::filled(nodes[0]);
            for (handle, &node) in named.as_mut().iter_mut().zip(cell.as_ref()) {
                *handle = nodes[node];
            }
            points.extend(self.push_cell::<H, M, N>(&model, &named, stuff));
        }
        let body = Body {
            mesh: mesh.clone(),
            nodes,
            points,
            thickness: bulk.thickness,
            conductivity: bulk.conductivity,
        };
        self.conduct_in(&body, bulk.allow_skew_cells);
        body
    }

    /// Replaces the initial velocity of a node, m/s, or its momentum. Anchors have none.
    pub fn set_velocity(&mut self, node: Node, velocity: [S; D]) {
        if self.expect_own(&node) {
            let entry = &mut self.nodes[node.index];
            if entry.mass.is_none() {
                self.misuse.push(SceneError::WrongKind {
                    node,
                    quantity: "a velocity",
                    kind: "an anchor",
                });
                return;
            }
            entry.velocity = SVector::from(velocity);
            entry.momentum = None;
        }
    }

    /// Makes a node an anchor, which stays where it is and has neither mass nor velocity.
    pub fn fix(&mut self, node: Node) {
        if self.expect_own(&node) {
            if self.loads.forces.iter().any(|(loaded, _)| *loaded == node) {
                self.misuse.push(SceneError::WrongKind {
                    node,
                    quantity: "a force",
                    kind: "fixed",
                });
            }
            let entry = &mut self.nodes[node.index];
            entry.mass = None;
            entry.momentum = None;
            entry.velocity = SVector::from([S::zero(); D]);
        }
    }
}
