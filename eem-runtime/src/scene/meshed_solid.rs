//! Solids from meshes.

use std::collections::{BTreeMap, BTreeSet};

use super::Scene;
use crate::element::handle::{Element, Node};
use crate::element::kinematics::{Points, Shape, StrainEnergy};
use crate::scene::bulk::{Body, Bulk, Shared, joined};
use crate::scene::entry::INVALID;
use crate::scene::error::SceneError;
use crate::scene::solid_error::SolidError;
use eem_material::free_energy::FreeEnergy;
use eem_mesh::{Mesh, per_node};

/// # Solids from meshes
impl<const D: usize> Scene<D> {
    /// A solid with this mesh, strain-free and at rest; in the plane in plane strain.
    ///
    /// Each integration point has its own temperature and viscous strains; its handle is for
    /// [`conduct`](Self::conduct), [`set_temperature`](Self::set_temperature) and others. The schemes are those for
    /// a [`quadrilateral`](Scene::quadrilateral).
    ///
    /// ```
    /// use eem::prelude::*;
    ///
    /// /// Saint-Venant and Kirchhoff, with a fibre.
    /// #[derive(Clone, FreeEnergy)]
    /// #[free_energy(|e1: StrainTrace, e2: StrainSquare, e4: FibreStrain| {
    ///     0.5 * lame * e1.powi(2) + shear * e2 + 0.5 * fibre * e4.powi(2)
    /// })]
    /// struct Reinforced { lame: f64, shear: f64, fibre: f64 }
    ///
    /// let mut scene = Scene::<3>::new();
    /// let rubber = Reinforced { lame: 2000.0, shear: 1000.0, fibre: 500.0 };
    /// let mesh = Mesh::<Hex8, 3>::block([2, 1, 1], [[0.0, 2.0], [0.0, 1.0], [0.0, 1.0]])?;
    /// let beam = scene.solid(rubber, &mesh, &Bulk::new(10.0).fibre([1.0, 0.0, 0.0]));
    /// for (&node, [x, ..]) in beam.nodes().iter().zip(mesh.nodes()) {
    ///     scene.set_velocity(node, [0.0, *x, 0.0]);
    /// }
    /// let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.05)?;
    /// let before = run.ledger();
    /// run.step()?;
    /// assert!((run.ledger().balance - before.balance).abs() < 1e-14 * before.energy);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[expect(clippy::needless_pass_by_value, reason = "as for a spring")]
    pub fn solid<H, M, const N: usize>(
        &mut self,
        model: M,
        mesh: &Mesh<H, D>,
        bulk: &Bulk<D>,
    ) -> Body<H, D>
    where
        H: Shape<D>,
        M: FreeEnergy<f64> + StrainEnergy<N> + Send + Sync + 'static,
    {
        let first = self.plan.next_element(&model);
        let nodes = self.nodes_of_mesh(mesh, bulk, first);
        // One error for the solid, not one per cell.
        let measures = bulk.measures(model.strains(), first).map_err(|error| {
            self.plan.refuse(error);
            None
        });
        let conductivity = bulk.conductivity.filter(|_| M::THERMAL);
        if conductivity.is_some() != bulk.conductivity.is_some() {
            self.plan
                .refuse(SolidError::NoTemperature { element: first });
        }
        let mut points = Vec::with_capacity(mesh.cells().len() * H::PerPoint::<Element>::LEN);
        for cell in mesh.cells() {
            let named = per_node::<H, _, D>(|at| nodes[cell[at]]);
            points.extend(self.push_cell::<H, M, N>(&model, &named, bulk, measures.clone()));
        }
        let body = Body {
            mesh: mesh.clone(),
            nodes,
            points,
            thickness: bulk.thickness,
            conductivity,
            #[cfg(feature = "gradients")]
            is_lumped: bulk.lumped,
        };
        self.conduct_in(&body, bulk.allow_skew_cells);
        body
    }

    /// The nodes of a mesh whose first point is `element`: new ones, and those of solids to which it is joined. If a joint
    /// is invalid, an error is recorded, and all nodes are new.
    fn nodes_of_mesh<H: Shape<D>>(
        &mut self,
        mesh: &Mesh<H, D>,
        bulk: &Bulk<D>,
        element: Element,
    ) -> Vec<Node> {
        let shared = joined(&bulk.joints, mesh, element);
        let shared = shared.and_then(|shared| {
            self.check_joined_cells(mesh, &shared, element)?;
            Ok(shared)
        });
        let shared = shared.unwrap_or_else(|error| {
            self.plan.refuse(error);
            vec![None; mesh.nodes().len()]
        });
        let places = mesh.nodes().iter().zip(shared);
        let nodes = places.map(|(place, shared)| match shared {
            Some(shared) => shared.node,
            None => self.node(*place, [0.0; D]),
        });
        nodes.collect()
    }

    /// An error if a cell has all its nodes in common with an existing one.
    fn check_joined_cells<H: Shape<D>>(
        &self,
        mesh: &Mesh<H, D>,
        shared: &[Option<Shared<D>>],
        element: Element,
    ) -> Result<(), SolidError> {
        let mut joined = BTreeMap::new();
        for (cell, nodes) in mesh.cells().iter().enumerate() {
            let nodes = nodes
                .as_ref()
                .iter()
                .map(|&node| Some(shared[node]?.node.index));
            let nodes: Option<BTreeSet<usize>> = nodes.collect();
            joined.extend(nodes.map(|nodes| (nodes, cell)));
        }
        if joined.is_empty() {
            return Ok(());
        }
        for (index, entry) in self.plan.entries.elements.iter().enumerate() {
            let nodes = entry.nodes.iter().copied().collect();
            let cell = joined.get(&nodes).filter(|_| entry.group != INVALID);
            if let Some(&cell) = cell {
                let elements = [element, self.element_at(index)];
                return Err(SolidError::JoinedCell { cell, elements });
            }
        }
        Ok(())
    }

    /// Sets the initial velocity of a node, m/s, instead of its momentum. Not for anchors.
    ///
    /// ```
    /// use eem::prelude::*;
    ///
    /// let mut scene = Scene::<1>::new();
    /// let mass = scene.mass(2.0, [0.0], [0.0]);
    /// scene.set_velocity(mass, [3.0]);
    /// let run = Simulation::new(scene, Scheme::EemEntropy, 0.1)?;
    /// assert_eq!(run.momentum(mass)?[0], 6.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn set_velocity(&mut self, node: Node, velocity: [f64; D]) {
        if self.plan.expect_kind(node, true, "a velocity") {
            self.plan.entries.nodes[node.index].momentum = None;
            self.plan.entries.velocities[node.index * D..][..D].copy_from_slice(&velocity);
        }
    }

    /// Makes a node an anchor, which stays in place unless [`move_anchor`](Self::move_anchor) moves it.
    ///
    /// Its mass remains part of the solid: half of the weight of a cell that stands on four fixed nodes is carried
    /// by the others, and moving the node takes work.
    ///
    /// ```
    /// use eem::materials::SaintVenantKirchhoff;
    /// use eem::prelude::*;
    ///
    /// let mut scene = Scene::<2>::new();
    /// let steel = SaintVenantKirchhoff { lame: 2000.0, shear: 1000.0 };
    /// let mesh = Mesh::<Quad4, 2>::block([2, 1], [[0.0, 2.0], [0.0, 1.0]])?;
    /// let body = scene.solid(steel, &mesh, &Bulk::new(10.0));
    /// body.nodes_where(|[x, _]| x <= 0.0).into_iter().for_each(|node| scene.fix(node));
    /// scene.set_gravity([0.0, -9.81]);
    /// let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.1)?;
    /// run.step()?;
    /// assert_eq!(run.position(body.nodes()[0])?[1], 0.0);
    /// assert!(run.position(body.nodes()[2])?[1] < 0.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn fix(&mut self, node: Node) {
        if self.plan.expect_own(&node) {
            let loads = &self.plan.loads;
            let is_pushed = loads.rockets.iter().any(|rocket| rocket.line.node == node);
            let is_loaded = loads.forces.iter().any(|&(loaded, _)| loaded == node);
            let given = [(is_pushed, "a rocket"), (is_loaded, "a force")];
            for (_, quantity) in given.into_iter().filter(|&(is_given, _)| is_given) {
                self.plan.refuse(SceneError::WrongKind {
                    node,
                    quantity,
                    kind: "fixed later; fix nodes before faces and bodies are loaded, which leaves them out",
                });
            }
            let entry = &mut self.plan.entries.nodes[node.index];
            entry.held += entry.mass.take().unwrap_or(0.0);
            entry.momentum = None;
            self.plan.entries.velocities[node.index * D..][..D].fill(0.0);
        }
    }
}
