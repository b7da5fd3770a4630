//! A scene and, beside it, what the judge has to know of it: both are told the same.

use std::sync::Arc;

use eem::prelude::*;

use super::model::{Body, Model};
use super::watched::{EXACT, Watched};

/// A force as a function of time.
type OfTime<const D: usize> = Arc<dyn Fn(f64) -> [f64; D] + Send + Sync>;

/// A scene that is being described.
pub(crate) struct World<const D: usize> {
    scene: Scene<D>,
    nodes: Vec<Node>,
    elements: Vec<Element>,
    facts: Facts<D>,
}

/// What the judge knows of a scene.
pub(crate) struct Facts<const D: usize> {
    /// The masses of the nodes, kg; `None` for an anchor.
    pub(crate) masses: Vec<Option<f64>>,
    pub(crate) springs: Vec<Spring>,
    /// Temperatures of the reservoirs, K.
    pub(crate) reservoirs: Vec<f64>,
    /// m/s².
    pub(crate) gravity: [f64; D],
    pub(crate) forces: Vec<(usize, OfTime<D>)>,
    /// Whether an anchor is moved: then its work and momentum are not known here.
    pub(crate) has_moved_anchors: bool,
    /// The springs that thermostats keep at a temperature.
    pub(crate) kept: Vec<usize>,
    /// Paths of heat.
    pub(crate) paths: usize,
    /// Whether the impulses of its loads are known: those of a force at the middle of a step, or none.
    pub(crate) has_known_impulses: bool,
    /// Whether a step is reported as its two halves: their energies between are not seen, and their bounds are added.
    pub(crate) has_halves: bool,
}

/// A spring, by the indices of its ends.
pub(crate) struct Spring {
    pub(crate) ends: [usize; 2],
    pub(crate) body: Arc<dyn Body>,
}

impl<const D: usize> World<D> {
    pub(crate) fn new() -> Self {
        let facts = Facts {
            masses: Vec::new(),
            springs: Vec::new(),
            reservoirs: Vec::new(),
            gravity: [0.0; D],
            forces: Vec::new(),
            has_moved_anchors: false,
            kept: Vec::new(),
            paths: 0,
            has_known_impulses: true,
            has_halves: false,
        };
        Self {
            scene: Scene::new(),
            nodes: Vec::new(),
            elements: Vec::new(),
            facts,
        }
    }

    pub(crate) fn anchor(&mut self, position: [f64; D]) -> Node {
        let node = self.scene.anchor(position);
        self.nodes.push(node);
        self.facts.masses.push(None);
        node
    }

    pub(crate) fn mass(&mut self, mass: f64, position: [f64; D], velocity: [f64; D]) -> Node {
        let node = self.scene.mass(mass, position, velocity);
        self.nodes.push(node);
        self.facts.masses.push(Some(mass));
        node
    }

    /// A spring of a model without temperature.
    pub(crate) fn spring<M: Model>(&mut self, model: M, ends: [Node; 2]) -> Element {
        let element = self.scene.spring(model.clone(), ends);
        let ends = ends.map(|node| self.index(node));
        self.elements.push(element);
        self.facts.springs.push(Spring {
            ends,
            body: Arc::new(model),
        });
        element
    }

    /// A spring at a temperature, K.
    pub(crate) fn warm<M: Model>(&mut self, model: M, ends: [Node; 2], theta: f64) -> Element {
        let element = self.spring(model, ends);
        self.scene.set_temperature(element, theta);
        element
    }

    pub(crate) fn set_viscous_stretch(&mut self, element: Element, dashpot: usize, stretch: f64) {
        self.scene.set_viscous_stretch(element, dashpot, stretch);
    }

    pub(crate) fn reservoir(&mut self, temperature: f64) -> Reservoir {
        self.facts.reservoirs.push(temperature);
        self.scene.reservoir(temperature)
    }

    /// Conduction between two springs.
    pub(crate) fn conduct(&mut self, ends: [Element; 2], conductance: f64) {
        self.facts.paths += 1;
        self.scene.conduct(ends[0], ends[1], conductance);
    }

    /// Conduction to a reservoir.
    pub(crate) fn cool(&mut self, element: Element, reservoir: Reservoir, conductance: f64) {
        self.facts.paths += 1;
        self.scene.conduct(element, reservoir, conductance);
    }

    pub(crate) fn set_gravity(&mut self, gravity: [f64; D]) {
        self.scene.set_gravity(gravity);
        self.facts.gravity = gravity;
    }

    pub(crate) fn force(
        &mut self,
        node: Node,
        force: impl Fn(f64) -> [f64; D] + Send + Sync + 'static,
    ) {
        let force: OfTime<D> = Arc::new(force);
        self.facts.forces.push((self.index(node), force.clone()));
        self.scene.force(node, move |time| force(time));
    }

    pub(crate) fn move_anchor(
        &mut self,
        anchor: Node,
        position: impl Fn(f64) -> [f64; D] + Send + Sync + 'static,
    ) {
        self.facts.has_moved_anchors = true;
        self.scene.move_anchor(anchor, position);
    }

    pub(crate) fn prescribe_temperature(
        &mut self,
        element: Element,
        temperature: impl Fn(f64) -> f64 + Send + Sync + 'static,
    ) {
        let place = self.elements.iter().position(|own| *own == element);
        self.facts.kept.push(place.expect("a spring of this scene"));
        self.scene.prescribe_temperature(element, temperature);
    }

    /// Ready to be stepped, and watched while it is.
    pub(crate) fn start(mut self, scheme: Scheme, step: f64) -> Result<Watched<D>, SceneError> {
        let is_loaded =
            !self.facts.forces.is_empty() || self.facts.gravity.iter().any(|g| g.abs() > 0.0);
        let is_at_middle = EXACT.contains(&scheme) || scheme == Scheme::EemDamped;
        self.facts.has_known_impulses = !is_loaded || is_at_middle;
        Ok(Watched::new(
            Simulation::new(self.scene, scheme, step)?,
            self.facts,
        ))
    }

    /// All nodes, in the order in which they were added.
    pub(crate) fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    fn index(&self, node: Node) -> usize {
        let place = self.nodes.iter().position(|own| *own == node);
        place.expect("a node of this scene")
    }
}
