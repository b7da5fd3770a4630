//! What a scene consists of but for the models of its elements, whatever its dimension.

use std::borrow::Cow;

use super::entry::{self, ElementEntry, NodeEntry};
use super::error::SceneError;
use super::loads::SceneLoads;
use crate::algebra::memory::MemoryLimit;
use crate::element::conduction::{Conduction, Conductor};
use crate::element::ends::Ends;
use crate::element::group::Loose;
use crate::element::handle::{Element, Handle, Kind, Node, Reservoir};
use crate::element::layout::{Layout, Shape};
use crate::element::lineage::Lineage;
use crate::element::masses::Masses;
use eem_material::free_energy::FreeEnergy;
use eem_material::number::compact::compact;

/// Nodes, elements without their models, reservoirs, conductances and loads. It is compiled once for all dimensions.
#[derive(Clone, Debug)]
pub(crate) struct Plan {
    pub(crate) lineage: Lineage,
    pub(crate) entries: Entries,
    pub(crate) reservoirs: Vec<f64>,
    pub(crate) conductors: Vec<Conductor>,
    pub(crate) loads: SceneLoads,
    /// The time at which a run begins, s.
    pub(crate) start: f64,
    pub(crate) memory_limit: MemoryLimit,
    /// Errors so far, reported by `Simulation::new`.
    pub(crate) errors: Vec<SceneError>,
}

/// Nodes and elements.
#[derive(Clone, Debug, Default)]
pub(crate) struct Entries {
    pub(crate) nodes: Vec<NodeEntry>,
    /// The positions of all nodes, m, and their velocities, m/s.
    pub(crate) positions: Vec<f64>,
    pub(crate) velocities: Vec<f64>,
    /// Masses of solids that couple two nodes, kg.
    pub(crate) pairs: Vec<([usize; 2], f64)>,
    pub(crate) elements: Vec<ElementEntry>,
}

/// The groups of elements of a scene.
pub(crate) trait Groups {
    /// The capabilities of the elements of a group, unless it is invalid.
    fn shape(&self, group: usize) -> Option<Shape>;

    /// The name of their model.
    fn name(&self, group: usize) -> &'static &'static str;

    /// The first parameter of an element that is not finite.
    fn infinite_parameter(&self, group: usize, place: usize) -> Option<(&'static str, f64)>;
}

impl<const D: usize> Groups for Vec<Box<dyn Loose<D>>> {
    fn shape(&self, group: usize) -> Option<Shape> {
        Some(self.get(group)?.shape())
    }

    fn name(&self, group: usize) -> &'static &'static str {
        self[group].name()
    }

    fn infinite_parameter(&self, group: usize, place: usize) -> Option<(&'static str, f64)> {
        self[group].infinite_parameter(place)
    }
}

impl Plan {
    /// A plan of nothing in a space of this dimension.
    pub(super) fn empty(dimension: usize) -> Self {
        Self {
            lineage: Lineage::new(),
            entries: Entries::default(),
            reservoirs: Vec::new(),
            conductors: Vec::new(),
            loads: SceneLoads::none(dimension),
            start: 0.0,
            memory_limit: MemoryLimit::NONE,
            errors: Vec::new(),
        }
    }

    /// The dimension of space.
    pub(crate) fn dimension(&self) -> usize {
        self.loads.dimension()
    }

    /// The position of a node, m.
    pub(crate) fn position(&self, node: usize) -> &[f64] {
        &self.entries.positions[node * self.dimension()..][..self.dimension()]
    }

    /// The velocity of a node, m/s, if its momentum is not given.
    pub(crate) fn velocity(&self, node: usize) -> &[f64] {
        &self.entries.velocities[node * self.dimension()..][..self.dimension()]
    }

    /// Writes the initial momentum of a node of this mass, kg m/s.
    pub(crate) fn find_momentum(&self, node: usize, mass: f64, own: &mut [f64]) {
        if let Some(momentum) = &self.entries.nodes[node].momentum {
            return own.copy_from_slice(momentum);
        }
        for (own, velocity) in own.iter_mut().zip(self.velocity(node)) {
            *own = mass * velocity;
        }
    }

    /// The handle of a valid element.
    pub(crate) fn element_at(&self, index: usize, groups: &dyn Groups) -> Element {
        let scene = self.lineage.giver(Kind::Element, index);
        Element::new(
            scene,
            index,
            groups.name(self.entries.elements[index].group),
        )
    }

    /// The numbering of its unknowns and state variables, and its paths of heat, given the places and shapes of elements.
    pub(crate) fn numbering(
        &self,
        masses: &Masses,
        elements: (&[[u32; 2]], &[Shape]),
    ) -> (Layout, Conduction) {
        let mut layout = entry::layout(self.dimension(), masses, elements);
        let reservoirs = self.reservoir_temperatures().into_owned();
        let conduction = Conduction::new(&self.conductors, reservoirs, &layout);
        layout.couple(|slot| conduction.meets_slots(slot));
        (layout, conduction)
    }

    /// The group of each element, and its index there.
    pub(crate) fn places(&self) -> Vec<[u32; 2]> {
        let places = self.entries.elements.iter();
        let places = places.map(|entry| [compact(entry.group), compact(entry.place)]);
        places.collect()
    }

    /// The nodes of its elements.
    pub(crate) fn ends(&self) -> Ends {
        let mut ends = Ends::none();
        for entry in &self.entries.elements {
            ends.push(entry.nodes.iter().map(|&node| compact(node)));
        }
        ends
    }

    pub(super) fn push_node(
        &mut self,
        mass: Option<f64>,
        position: &[f64],
        velocity: &[f64],
    ) -> Node {
        self.entries.nodes.push(NodeEntry {
            mass,
            held: 0.0,
            momentum: None,
        });
        self.entries.positions.extend_from_slice(position);
        self.entries.velocities.extend_from_slice(velocity);
        self.node_at(self.entries.nodes.len() - 1)
    }

    pub(super) fn push_element(&mut self, nodes: &[Node], [group, place]: [usize; 2]) {
        self.entries.elements.push(ElementEntry {
            nodes: nodes.iter().map(|node| node.index).collect(),
            temperature: None,
            viscous_stretches: Vec::new(),
            group,
            place,
        });
    }

    /// The handle of the next element, of this model.
    pub(super) fn next_element<M: FreeEnergy<f64>>(&self, model: &M) -> Element {
        let index = self.entries.elements.len();
        Element::new(
            self.lineage.giver(Kind::Element, index),
            index,
            model.model(),
        )
    }

    /// The temperatures of all reservoirs at the start, K.
    pub(crate) fn reservoir_temperatures(&self) -> Cow<'_, [f64]> {
        let mut temperatures = Cow::Borrowed(&self.reservoirs[..]);
        for (index, temperature) in &self.loads.ovens {
            temperatures.to_mut()[*index] = temperature(self.start);
        }
        temperatures
    }

    /// Records an error for `Simulation::new`.
    pub(super) fn refuse(&mut self, error: impl Into<SceneError>) {
        self.errors.push(error.into());
    }

    /// Whether a handle is of this scene; if not, an error is recorded.
    pub(super) fn expect_own<H: Handle>(&mut self, handle: &H) -> bool {
        let own = self.lineage.expect(handle);
        own.map_err(|error| self.refuse(error)).is_ok()
    }

    /// The mass matrix. Anchors keep their masses as nodes of solids.
    pub(crate) fn masses(&self) -> Masses {
        let mut pairs = self.entries.pairs.clone();
        let nodes = self.entries.nodes.iter().enumerate();
        for ((index, node), is_coupled) in nodes.zip(self.are_coupled()) {
            if node.mass.is_none() && is_coupled {
                pairs.push(([index; 2], node.held));
            }
        }
        let mut own = Vec::with_capacity(self.entries.nodes.len());
        for node in &self.entries.nodes {
            own.push(node.mass.unwrap_or(0.0));
        }
        Masses::new(own, pairs)
    }

    /// Which nodes are coupled by masses of solids; empty if none is.
    pub(super) fn are_coupled(&self) -> Vec<bool> {
        self.marked(self.entries.pairs.iter().flat_map(|(nodes, _)| nodes))
    }

    /// Which nodes are among these; empty if none is.
    pub(super) fn marked<'a>(&self, nodes: impl Iterator<Item = &'a usize>) -> Vec<bool> {
        let mut marks = Vec::new();
        for &node in nodes {
            marks.resize(self.entries.nodes.len(), false);
            marks[node] = true;
        }
        marks
    }

    /// The handle of a node.
    pub(crate) fn node_at(&self, index: usize) -> Node {
        let scene = self.lineage.giver(Kind::Node, index);
        Node { scene, index }
    }

    /// The handle of a reservoir.
    pub(super) fn reservoir_at(&self, index: usize) -> Reservoir {
        let scene = self.lineage.giver(Kind::Reservoir, index);
        Reservoir { scene, index }
    }

    /// Whether a node is of this scene, and a mass or an anchor as required; if not, an error is recorded.
    pub(super) fn expect_kind(&mut self, node: Node, mass: bool, quantity: &'static str) -> bool {
        if !self.expect_own(&node) {
            return false;
        }
        let is_mass = self.entries.nodes[node.index].mass.is_some();
        let found = SceneError::expect_kind(node, [is_mass, mass], quantity);
        found.map_err(|error| self.refuse(error)).is_ok()
    }
}
