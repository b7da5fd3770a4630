//! Cells of solids: their integration points, and their mass at the nodes.

use super::Scene;
use crate::element::group::{ExplicitGroup, Loose, LooseElements, Parts, Placed, identity};
use crate::element::handle::{Element, Node};
use crate::element::kinematics::{
    Measure, Points, QuadraticStrain, Shape, SolidPoint, Strain, StrainEnergy,
};
use crate::scene::check::check_position;
use crate::scene::entry::INVALID;
use crate::scene::error::SceneError;
use crate::scene::solid_error::SolidError;
use eem_material::free_energy::{FreeEnergy, Material};
use eem_material::number::scalar::is_positive;
use eem_material::point_energy::PointEnergy;
use eem_mesh::{integrals, per_node};

/// The properties of a cell besides its material and nodes.
#[derive(Clone, Copy, Debug)]
pub(super) struct CellProperties<'a, const D: usize> {
    /// ρ, kg/m³.
    pub(super) density: f64,
    /// Thickness in the plane, m; one in space.
    pub(super) thickness: f64,
    /// The directions of the fibres.
    pub(super) fibres: &'a [[f64; D]],
    /// Whether the mass is lumped, so that it does not couple nodes.
    pub(super) lumped: bool,
    /// Whether the solid is invalid; an error is then already recorded.
    pub(super) is_invalid: bool,
}

/// Explicit schemes refuse scenes with solids.
fn no_explicit<const D: usize>(_: Box<dyn Loose<D>>, _: Placed<'_>) -> Box<dyn ExplicitGroup<D>> {
    unreachable!("explicit schemes refuse solids")
}

impl<const D: usize> Scene<D> {
    /// Adds a cell in the present positions of its nodes; returns its points. Errors are recorded for `Simulation::new`.
    pub(super) fn push_cell<H, M, const N: usize>(
        &mut self,
        model: &M,
        nodes: &H::PerNode<Node>,
        properties: CellProperties<'_, D>,
    ) -> H::PerPoint<Element>
    where
        H: Shape<D>,
        M: FreeEnergy<f64> + StrainEnergy<N> + Send + Sync + 'static,
    {
        let first = self.next_element(model);
        let points = H::PerPoint::from_fn(|point| first.after(point));
        let (group, place) =
            match self.expect_cell::<H, N>(nodes, (model.strains(), properties), points.as_ref()) {
                Ok(cell) => {
                    let parts = H::PerPoint::from_fn(|at| {
                        let point = cell.as_ref()[at];
                        let energy = PointEnergy::new(model.at_point(), point.volume());
                        (energy, point)
                    });
                    self.push_parts::<_, SolidPoint<H, N, D>>(first, parts)
                }
                // The handles must be valid until the scene is checked.
                Err(errors) => {
                    self.errors.extend(errors);
                    (INVALID, 0)
                }
            };
        for point in 0..points.as_ref().len() {
            self.push_element(nodes.as_ref(), [group, place + point]);
        }
        points
    }

    /// Adds an element to the group of its material.
    fn push_parts<M: Material, K: QuadraticStrain<D>>(
        &mut self,
        first: Element,
        parts: Parts<M, K, D>,
    ) -> (usize, usize) {
        let kind = identity(&parts.as_ref()[0].0);
        let new = || -> Box<dyn Loose<D>> { Box::new(LooseElements::<M, K, D>::new(no_explicit)) };
        let (group, set) = self.set_of::<LooseElements<M, K, D>>(kind, new);
        let place = set.points();
        set.elements.push((first, parts));
        (group, place)
    }

    /// The points of a cell, whose mass is added to its nodes. `Err(None)` if the error is already recorded.
    fn expect_cell<H: Shape<D>, const N: usize>(
        &mut self,
        nodes: &H::PerNode<Node>,
        (strains, properties): ([Strain; N], CellProperties<'_, D>),
        points: &[Element],
    ) -> Result<H::PerPoint<SolidPoint<H, N, D>>, Option<SceneError>> {
        for node in nodes.as_ref() {
            if !self.expect_own(node) {
                return Err(None);
            }
            check_position(*node, &self.nodes[node.index])?;
        }
        if properties.is_invalid {
            return Err(None);
        }
        let measures = properties
            .measures(strains, points[0])
            .map_err(SceneError::from)?;
        let position = |at: usize| self.nodes[nodes[at].index].position.into();
        let reference = per_node::<H, _, D>(position);
        let cell = SolidPoint::<H, N, D>::points(&reference, properties.thickness, measures);
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
        self.add_masses::<H>(nodes.as_ref(), &reference, properties);
        Ok(cell)
    }

    /// Adds the mass of a cell.
    fn add_masses<H: Shape<D>>(
        &mut self,
        nodes: &[Node],
        reference: &H::PerNode<[f64; D]>,
        properties: CellProperties<'_, D>,
    ) {
        let mut masses =
            integrals::masses::<H, D>(reference, properties.density * properties.thickness);
        if properties.lumped {
            integrals::lump::<H, D>(&mut masses);
        }
        for (a, row) in masses.as_ref().iter().enumerate() {
            let entry = &mut self.nodes[nodes[a].index];
            let mass = entry.mass.as_mut().unwrap_or(&mut entry.held);
            // A negative mass is that of the node itself, as masses of solids are positive.
            if *mass < 0.0 {
                let (node, value) = (nodes[a], *mass);
                self.errors.push(SceneError::Mass { node, value });
            }
            *mass += row[a];
            for (b, &mass) in row.as_ref().iter().enumerate().take(a) {
                let [i, j] = [nodes[a].index, nodes[b].index];
                self.pairs.push(([i.min(j), i.max(j)], mass));
            }
        }
    }
}

impl<const D: usize> CellProperties<'_, D> {
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
        Measure::along(strains, self.fibres).ok_or(SolidError::Fibre { element })
    }
}
