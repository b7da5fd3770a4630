//! Solids of a scene: nodes, quadrilaterals, viscous strains, and cells with their points and masses.

use super::Scene;
use crate::element::group::{ExplicitGroup, Loose, LooseElements, Placed, identity};
use crate::element::handle::{Element, Node};
use crate::element::kinematics::{
    Measure, Points, Quad4, QuadraticStrain, Shape, SolidPoint, Strain, StrainEnergy,
};
use crate::element::loads::point;
use crate::scene::bulk::Bulk;
use crate::scene::entry::INVALID;
use crate::scene::error::SceneError;
use crate::scene::solid_error::SolidError;
use eem_material::arrays::{Arrays, ArraysOf};
use eem_material::free_energy::FreeEnergy;
use eem_material::joint::components;
use eem_material::number::scalar::is_positive;
use eem_material::point_energy::PointEnergy;
use eem_material::tabled::Tabled;
use eem_mesh::{integrals, per_node};

/// The properties of a quadrilateral besides its material and corners.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Section {
    /// ρ, kg/m³.
    pub density: f64,
    /// Thickness out of the plane, m.
    pub thickness: f64,
}

/// # Nodes of solids
impl<const D: usize> Scene<D> {
    /// A node that moves and gets its mass from solids. Position in m, velocity in m/s.
    pub fn node(&mut self, position: [f64; D], velocity: [f64; D]) -> Node {
        self.plan.push_node(Some(0.0), &position, &velocity)
    }

    /// Sets the initial position of a node, m. Solids keep their reference shape, so they start deformed.
    pub fn set_position(&mut self, node: Node, position: [f64; D]) {
        if self.plan.expect_own(&node) {
            self.plan.entries.positions[node.index * D..][..D].copy_from_slice(&position);
        }
    }
}

/// # Solids in the plane
impl Scene<2> {
    /// A quadrilateral of a solid in plane strain with four nodes as corners, counterclockwise. Returns its
    /// integration points; the first coordinate varies fastest.
    ///
    /// The present positions of the nodes are the strain-free shape. Each point has its own temperature and viscous
    /// strains; its handle is for [`conduct`](Self::conduct), [`set_temperature`](Self::set_temperature) and
    /// others. The mass is consistent, `∫ ρ N_a N_b dV`, so it couples nodes:
    /// [`Scheme::EemEntropy`](crate::Scheme::EemEntropy), [`EemTemperature`](crate::Scheme::EemTemperature),
    /// [`Staggered`](crate::Scheme::Staggered) and the midpoint and trapezoidal rules can step it. Corners may be
    /// anchors.
    ///
    /// ```
    /// use eem::materials::SaintVenantKirchhoff;
    /// use eem::prelude::*;
    ///
    /// let mut scene = Scene::<2>::new();
    /// let corners = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]];
    /// let nodes = corners.map(|corner| scene.node(corner, [-corner[1], corner[0]]));
    /// let steel = SaintVenantKirchhoff { lame: 2000.0, shear: 1000.0 };
    /// scene.quadrilateral(steel, nodes, Section { density: 10.0, thickness: 1.0 });
    ///
    /// let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.1)?;
    /// let before = run.ledger();
    /// assert!((before.kinetic_energy - 0.5 * 20.0 * 5.0 / 3.0).abs() < 1e-12);
    /// run.run_until(1.0)?;
    /// assert!((run.ledger().balance - before.balance).abs() < 1e-13 * before.energy);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[expect(clippy::needless_pass_by_value, reason = "as for a spring")]
    pub fn quadrilateral<M, const N: usize>(
        &mut self,
        model: M,
        nodes: [Node; 4],
        section: Section,
    ) -> [Element; 4]
    where
        M: FreeEnergy<f64> + StrainEnergy<N> + Send + Sync + 'static,
    {
        let bulk = Bulk::new(section.density).thickness(section.thickness);
        let first = self.plan.next_element(&model);
        let measures = bulk.measures(model.strains(), first).map_err(Some);
        self.push_cell::<Quad4, M, N>(&model, &nodes, &bulk, measures)
    }
}

/// # Viscous strains of solids
impl<const D: usize> Scene<D> {
    /// The initial viscous strain Γ at a point of a solid; zero by default. Only its symmetric part counts and,
    /// without a volumetric viscosity, only its deviator.
    ///
    /// The free energy needs an argument with the role `ViscousStrain`; otherwise the error is
    /// [`SolidError::NoViscousStrain`].
    ///
    /// ```
    /// use eem::prelude::*;
    ///
    /// #[derive(Clone, FreeEnergy)]
    /// #[free_energy(|e2: StrainSquare, m3: ViscousStrain, m2: ViscousSquare| 3.0 * (e2 - 2 * m3 + m2))]
    /// #[viscosity(m3 = 5.0)]
    /// struct Fluid;
    ///
    /// let mut scene = Scene::<3>::new();
    /// let mesh = Mesh::<Hex8, 3>::block([1; 3], [[0.0, 1.0]; 3])?;
    /// let point = scene.solid(Fluid, &mesh, &Bulk::new(10.0)).points()[0];
    /// scene.set_viscous_strain(point, [[0.4, 0.1, 0.0], [0.1, 0.2, 0.0], [0.0, 0.0, 0.0]]);
    /// let run = Simulation::new(scene, Scheme::EemEntropy, 0.1)?;
    /// let strain = run.viscous_strain(point)?;
    /// assert!((strain[(0, 0)] - 0.2_f64).abs() < 1e-15 && (strain[(1, 0)] - 0.1).abs() < 1e-15);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn set_viscous_strain(&mut self, point: Element, strain: [[f64; 3]; 3]) {
        if !self.plan.expect_own(&point) {
            return;
        }
        let entry = &self.plan.entries.elements[point.index()];
        // An invalid solid is already an error.
        let Some(group) = self.groups.get(entry.group) else {
            return;
        };
        let shape = group.shape();
        if shape.viscous_strain == 0 {
            self.plan
                .refuse(SolidError::NoViscousStrain { element: point });
        }
        if let Some(error) = invalid_shear(point, &strain, D == 2) {
            return self.plan.refuse(error);
        }
        let components = components(&strain).into_iter().take(shape.viscous_strain);
        let entry = &mut self.plan.entries.elements[point.index()];
        entry
            .viscous_stretches
            .extend((shape.scalar_dashpots()..).zip(components));
    }
}

/// The error of a tensor that is not symmetric or, in plane strain, has shear out of the plane.
fn invalid_shear(element: Element, strain: &[[f64; 3]; 3], is_plane: bool) -> Option<SolidError> {
    [[0, 1], [0, 2], [1, 2]].into_iter().find_map(|[i, j]| {
        let values = [strain[i][j], strain[j][i]];
        #[expect(clippy::float_cmp, reason = "a tensor is symmetric to the last bit")]
        let is_symmetric = values[0] == values[1];
        let is_out_of_plane = is_plane && j == 2 && values[0] != 0.0;
        (!is_symmetric || is_out_of_plane).then_some(SolidError::ViscousShear {
            element,
            place: [i, j],
            values,
            is_plane,
        })
    })
}

/// The measures of a material; an error that may already be recorded if a solid is invalid.
type Measures<const N: usize, const D: usize> = Result<[Measure<D>; N], Option<SolidError>>;

/// The arrays of a material of solids with N strains at a point.
type SolidArrays<M, const N: usize> =
    ArraysOf<PointEnergy<<M as StrainEnergy<N>>::AtPoint>, [f64; N], [f64; KEPT]>;

/// The most values that a form of a solid keeps of the old state of a point; one that keeps more computes them again.
const KEPT: usize = 48;

/// Explicit schemes refuse scenes with solids.
fn no_explicit<const D: usize>(_: Box<dyn Loose<D>>, _: Placed<'_>) -> Box<dyn ExplicitGroup<D>> {
    unreachable!("explicit schemes refuse solids")
}

impl<const D: usize> Scene<D> {
    /// Adds a cell in the present positions of its nodes; returns its points. Errors are recorded for `Simulation::new`; those of
    /// measures are, if they are `None`.
    pub(super) fn push_cell<H, M, const N: usize>(
        &mut self,
        model: &M,
        nodes: &H::PerNode<Node>,
        bulk: &Bulk<D>,
        measures: Measures<N, D>,
    ) -> H::PerPoint<Element>
    where
        H: Shape<D>,
        M: FreeEnergy<f64> + StrainEnergy<N> + Send + Sync + 'static,
    {
        let first = self.plan.next_element(model);
        let points = H::PerPoint::from_fn(|point| first.after(point));
        let (group, place) = match self.expect_cell::<H, N>(nodes, bulk, measures, points.as_ref())
        {
            Ok(cell) => {
                let models = cell.as_ref().iter().map(|point| {
                    let energy = PointEnergy::new(model.at_point(), point.volume());
                    Tabled::<SolidArrays<M, N>>::new::<_, [f64; N]>(energy)
                });
                let models: Vec<_> = models.collect();
                self.push_parts::<_, SolidPoint<H, N, D>>((first, cell), models)
            }
            // The handles must be valid until the scene is checked.
            Err(errors) => {
                self.plan.errors.extend(errors);
                (INVALID, 0)
            }
        };
        for point in 0..points.as_ref().len() {
            self.plan
                .push_element(nodes.as_ref(), [group, place + point]);
        }
        points
    }

    /// Adds an element to the group of its material.
    fn push_parts<A: Arrays, K: QuadraticStrain<D>>(
        &mut self,
        element: (Element, K::PerPoint<K>),
        models: Vec<Tabled<A>>,
    ) -> (usize, usize) {
        let kind = identity(&models[0]);
        let new = || -> Box<dyn Loose<D>> {
            Box::new(LooseElements::<K, D>::new::<A>(no_explicit, None))
        };
        let (group, set) = self.set_of::<LooseElements<K, D>>(kind, new);
        (group, set.push(element, models))
    }

    /// The points of a cell, whose mass is added to its nodes. `Err(None)` if the error is already recorded.
    fn expect_cell<H: Shape<D>, const N: usize>(
        &mut self,
        nodes: &H::PerNode<Node>,
        bulk: &Bulk<D>,
        measures: Measures<N, D>,
        points: &[Element],
    ) -> Result<H::PerPoint<SolidPoint<H, N, D>>, Option<SceneError>> {
        for node in nodes.as_ref() {
            if !self.plan.expect_own(node) {
                return Err(None);
            }
            self.plan.check_position(*node)?;
        }
        let measures = measures.map_err(|error| error.map(SceneError::from))?;
        let position = |at: usize| point(&self.plan.entries.positions, nodes[at].index);
        let reference = per_node::<H, _, D>(position);
        let cell = SolidPoint::<H, N, D>::points(&reference, bulk.thickness, measures);
        let cell = cell.map_err(|(point, size)| {
            SceneError::Solid(SolidError::InsideOut {
                element: points[point],
                value: size,
                unit: if D == 2 { "m^2" } else { "m^3" },
                order: if H::NODES.len() == 4 {
                    "corners against the clock"
                } else {
                    "nodes in the order of VTK"
                },
            })
        })?;
        self.add_masses::<H>(nodes.as_ref(), &reference, bulk);
        Ok(cell)
    }

    /// Adds the mass of a cell.
    fn add_masses<H: Shape<D>>(
        &mut self,
        nodes: &[Node],
        reference: &H::PerNode<[f64; D]>,
        bulk: &Bulk<D>,
    ) {
        let per_area = bulk.density * bulk.thickness;
        let mut masses = integrals::masses::<H, D>(reference, per_area);
        if bulk.lumped {
            integrals::lump::<H, D>(&mut masses);
        }
        for (a, row) in masses.as_ref().iter().enumerate() {
            let entry = &mut self.plan.entries.nodes[nodes[a].index];
            let mass = entry.mass.as_mut().unwrap_or(&mut entry.held);
            // A negative mass is that of the node itself, as masses of solids are positive.
            if *mass < 0.0 {
                let (node, value) = (nodes[a], *mass);
                self.plan.errors.push(SceneError::Mass { node, value });
            }
            *mass += row[a];
            for (b, &mass) in row.as_ref().iter().enumerate().take(a) {
                let [i, j] = [nodes[a].index, nodes[b].index];
                self.plan.entries.pairs.push(([i.min(j), i.max(j)], mass));
            }
        }
    }
}

impl<const D: usize> Bulk<D> {
    /// The measures of a material along the fibres; an error if the solid with this first point is invalid.
    pub(super) fn measures<const N: usize>(
        &self,
        strains: [Strain; N],
        element: Element,
    ) -> Result<[Measure<D>; N], SolidError> {
        let numbers = [
            ("density", self.density, "kg/m^3"),
            ("thickness", self.thickness, "m"),
        ];
        for (quantity, value, unit) in numbers {
            if !is_positive(value) {
                return Err(SolidError::section(element, quantity, value, unit));
            }
        }
        let is_fibre = |strain: &&Strain| **strain == Strain::Fibre;
        let needed = strains.iter().filter(is_fibre).count();
        let given = self.fibres.len();
        if needed != given {
            return Err(SolidError::Fibres {
                element,
                needed,
                given,
            });
        }
        Measure::along(strains, &self.fibres).ok_or(SolidError::Fibre { element })
    }
}
