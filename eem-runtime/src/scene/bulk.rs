//! What a solid is besides its material and its mesh.

use crate::element::handle::Node;
use crate::element::kinematics::Shape;
use crate::number::scalar::Real;
use crate::scene::body::Body;
use crate::scene::mesh::distance;

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
    pub(super) density: S,
    /// m; one in space.
    pub(super) thickness: f64,
    /// W/(m K).
    pub(super) conductivity: Option<f64>,
    pub(super) allow_skew_cells: bool,
    pub(super) fibres: Vec<[S; D]>,
    pub(super) lumped: bool,
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
    /// Cells have to be nearly rectangular, see [`Mesh::skew_faces`](crate::Mesh::skew_faces); if they are not, the scene is refused with
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
    pub(super) fn joint(&self, place: [f64; D]) -> Option<Node> {
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
