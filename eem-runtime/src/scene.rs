//! A scene as a user describes it: nodes, elements, reservoirs, conductances.
//!
//! Building a scene never fails; [`Simulation::new`](crate::Simulation::new) checks it and returns all errors.

// The documentation shows methods in this order.
mod parts;

mod meshed_solid;

mod act;

mod body_heat;

pub(crate) mod bulk;
mod check;
pub(crate) mod entry;
pub(crate) mod error;
pub(crate) mod loads;
pub(crate) mod refused;
pub(crate) mod solid;
pub(crate) mod solid_error;

use core::any::TypeId;
use std::borrow::Cow;

use crate::algebra::memory::MemoryLimit;
use crate::element::conduction::{Conduction, Conductor};
use crate::element::ends::Ends;
use crate::element::group::Loose;
use crate::element::handle::{Element, Handle, Kind, Node, Reservoir};
use crate::element::layout::{Layout, Shape};
use crate::element::lineage::{Counts, Lineage};
use crate::element::masses::Masses;
use crate::scene::error::SceneError;
use crate::scene::loads::SceneLoads;
use eem_material::free_energy::FreeEnergy;
use entry::{ElementEntry, NodeEntry};

/// A scene in `D` dimensions: masses, anchors, springs, solids, reservoirs and loads.
///
/// | first | then | at last |
/// |---|---|---|
/// | [`new`](Self::new) | [`anchor`](Self::anchor), [`mass`](Self::mass), [`spring`](Self::spring), [`solid`](Self::solid) | [`Simulation::new`](crate::Simulation::new) |
/// | | [`set_temperature`](Self::set_temperature), [`reservoir`](Self::reservoir), [`conduct`](Self::conduct) | or first [`equilibrium`](Self::equilibrium) |
/// | | [`set_gravity`](Self::set_gravity), [`force`](Self::force), [`move_anchor`](Self::move_anchor), [`traction`](Self::traction) | |
///
/// ```
/// use eem::Scene;
///
/// let mut scene = Scene::<2>::new();
/// let pivot = scene.anchor([0.0, 0.0]);
/// let bob = scene.mass(1.0, [3.0, 0.0], [0.0, 1.0]);
/// let air = scene.reservoir(300.0);
/// assert_eq!(pivot.to_string(), "node 0");
/// assert_eq!(bob.to_string(), "node 1");
/// assert_eq!(air.to_string(), "reservoir 0");
/// ```
#[derive(Debug)]
pub struct Scene<const D: usize> {
    pub(crate) lineage: Lineage,
    pub(crate) nodes: Vec<NodeEntry<D>>,
    /// Masses of solids that couple two nodes, kg.
    pub(crate) pairs: Vec<([usize; 2], f64)>,
    pub(crate) elements: Vec<ElementEntry>,
    pub(crate) reservoirs: Vec<f64>,
    pub(crate) conductors: Vec<Conductor>,
    pub(crate) groups: Vec<Box<dyn Loose<D>>>,
    pub(crate) loads: SceneLoads,
    /// The time at which a run begins, s.
    pub(crate) start: f64,
    pub(crate) memory_limit: MemoryLimit,
    /// Errors so far, reported by `Simulation::new`.
    pub(crate) errors: Vec<SceneError>,
}

impl<const D: usize> Default for Scene<D> {
    fn default() -> Self {
        const {
            assert!(D >= 1, "a scene has at least one dimension");
        }
        Self {
            lineage: Lineage::new(),
            nodes: Vec::new(),
            pairs: Vec::new(),
            elements: Vec::new(),
            reservoirs: Vec::new(),
            conductors: Vec::new(),
            groups: Vec::new(),
            loads: SceneLoads::none(D),
            start: 0.0,
            memory_limit: MemoryLimit::NONE,
            errors: Vec::new(),
        }
    }
}

impl<const D: usize> Scene<D> {
    /// The errors of the calls so far: handles of other scenes, loads on anchors, invalid cells of solids.
    /// [`Simulation::new`](crate::Simulation::new) reports these, too, and checks all numbers.
    ///
    /// ```
    /// use eem::{Scene, SceneError};
    ///
    /// let mut scene = Scene::<1>::new();
    /// let wall = scene.anchor([0.0]);
    /// assert!(scene.errors().is_empty());
    /// scene.dead_load(wall, [1.0]);
    /// assert!(matches!(scene.errors(), [SceneError::WrongKind { .. }]));
    /// ```
    #[must_use]
    pub fn errors(&self) -> &[SceneError] {
        &self.errors
    }

    /// The numbering of its unknowns and state variables, and its paths of heat, given the places and shapes of elements.
    pub(crate) fn numbering(
        &self,
        masses: &Masses,
        elements: (&[[u32; 2]], &[Shape]),
    ) -> (Layout, Conduction) {
        let mut layout = entry::layout(D, masses, elements);
        let reservoirs = self.reservoir_temperatures().into_owned();
        let conduction = Conduction::new(&self.conductors, reservoirs, &layout);
        layout.couple(|slot| conduction.meets_slots(slot));
        (layout, conduction)
    }

    /// The group of each element, and its index there.
    pub(crate) fn places(&self) -> Vec<[u32; 2]> {
        entry::places(&self.elements)
    }

    /// The capabilities of the elements of each group.
    pub(crate) fn shapes(&self) -> Vec<Shape> {
        let mut shapes = Vec::with_capacity(self.groups.len());
        for group in &self.groups {
            shapes.push(group.shape());
        }
        shapes
    }

    /// The nodes of its elements.
    pub(crate) fn ends(&self) -> Ends {
        entry::ends(&self.elements)
    }

    fn push_node(&mut self, mass: Option<f64>, position: [f64; D], velocity: [f64; D]) -> Node {
        self.nodes.push(NodeEntry {
            mass,
            held: 0.0,
            position: position.into(),
            velocity: velocity.into(),
            momentum: None,
        });
        self.node_at(self.nodes.len() - 1)
    }

    fn push_element(&mut self, nodes: &[Node], [group, place]: [usize; 2]) {
        self.elements.push(ElementEntry {
            nodes: nodes.iter().map(|node| node.index).collect(),
            temperature: None,
            viscous_stretches: Vec::new(),
            group,
            place,
        });
    }

    /// The handle of the next element, of this model.
    fn next_element<M: FreeEnergy<f64>>(&self, model: &M) -> Element {
        let index = self.elements.len();
        Element::new(
            self.lineage.giver(Kind::Element, index),
            index,
            model.model(),
        )
    }

    /// The index of the group for elements of one type and kind, created if necessary, and the group.
    fn set_of<B: Loose<D>>(
        &mut self,
        kind: (TypeId, u64),
        new: impl FnOnce() -> Box<dyn Loose<D>>,
    ) -> (usize, &mut B) {
        let mut groups = self.groups.iter();
        let same = groups.position(|group| group.as_any().is::<B>() && group.kind() == kind);
        let group = same.unwrap_or_else(|| {
            self.groups.push(new());
            self.groups.len() - 1
        });
        let set = self.groups[group].as_any_mut().downcast_mut();
        let set = set.unwrap_or_else(|| unreachable!("the group has this type"));
        (group, set)
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
    fn refuse(&mut self, error: impl Into<SceneError>) {
        self.errors.push(error.into());
    }

    /// Whether a handle is of this scene; if not, an error is recorded.
    fn expect_own<H: Handle>(&mut self, handle: &H) -> bool {
        let own = self.lineage.expect(handle);
        own.map_err(|error| self.refuse(error)).is_ok()
    }

    /// The mass matrix. Anchors keep their masses as nodes of solids.
    pub(crate) fn masses(&self) -> Masses {
        let mut pairs = self.pairs.clone();
        let nodes = self.nodes.iter().enumerate();
        for ((index, node), is_coupled) in nodes.zip(self.are_coupled()) {
            if node.mass.is_none() && is_coupled {
                pairs.push(([index; 2], node.held));
            }
        }
        let mut own = Vec::with_capacity(self.nodes.len());
        for node in &self.nodes {
            own.push(node.mass.unwrap_or(0.0));
        }
        Masses::new(own, pairs)
    }

    /// Which nodes are coupled by masses of solids; empty if none is.
    fn are_coupled(&self) -> Vec<bool> {
        self.marked(self.pairs.iter().flat_map(|(nodes, _)| nodes))
    }

    /// Which nodes are among these; empty if none is.
    fn marked<'a>(&self, nodes: impl Iterator<Item = &'a usize>) -> Vec<bool> {
        let mut marks = Vec::new();
        for &node in nodes {
            marks.resize(self.nodes.len(), false);
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
    fn reservoir_at(&self, index: usize) -> Reservoir {
        let scene = self.lineage.giver(Kind::Reservoir, index);
        Reservoir { scene, index }
    }

    /// The handle of a valid element.
    pub(crate) fn element_at(&self, index: usize) -> Element {
        let scene = self.lineage.giver(Kind::Element, index);
        Element::new(scene, index, self.groups[self.elements[index].group].name())
    }
}

/// Handles of a scene are valid for its copies too; handles of parts that are added to one of them later are valid only there.
/// Loads are shared: what a closure keeps behind a lock is common to all copies.
///
/// ```
/// use eem::prelude::*;
///
/// let mut scene = Scene::<1>::new();
/// let mass = scene.mass(1.0, [0.0], [2.0]);
/// let mut pushed = scene.clone();
/// pushed.dead_load(mass, [3.0]);
/// for (scene, speed) in [(scene, 2.0), (pushed, 5.0)] {
///     let mut run = Simulation::new(scene, Scheme::EemEntropy, 1.0)?;
///     run.step()?;
///     assert_eq!(run.velocity(mass)?[0], speed);
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
impl<const D: usize> Clone for Scene<D> {
    fn clone(&self) -> Self {
        let counts = Counts {
            nodes: self.nodes.len(),
            elements: self.elements.len(),
            reservoirs: self.reservoirs.len(),
            paths: self.conductors.len(),
        };
        Self {
            lineage: self.lineage.copy(counts),
            nodes: self.nodes.clone(),
            pairs: self.pairs.clone(),
            elements: self.elements.clone(),
            reservoirs: self.reservoirs.clone(),
            conductors: self.conductors.clone(),
            groups: self.groups.iter().map(|group| group.duplicate()).collect(),
            loads: self.loads.clone(),
            start: self.start,
            memory_limit: self.memory_limit,
            errors: self.errors.clone(),
        }
    }
}
