//! A scene and, beside it, what the judge has to know of it: both are told the same.

use std::sync::Arc;

use eem::prelude::*;

use super::model::{Body, Model};
use super::watched::{EXACT, Watched};

/// A force, a position or a temperature as a function of time.
pub(crate) type OfTime<T> = Arc<dyn Fn(f64) -> T + Send + Sync>;

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
    pub(crate) forces: Vec<(usize, OfTime<[f64; D]>)>,
    /// The anchors that are moved.
    pub(crate) motions: Vec<(usize, OfTime<[f64; D]>)>,
    /// The springs that thermostats keep at a temperature.
    pub(crate) kept: Vec<(usize, OfTime<f64>)>,
    /// The temperatures of ovens.
    pub(crate) ovens: Vec<OfTime<f64>>,
    /// Paths of heat.
    pub(crate) paths: usize,
    pub(crate) scheme: Scheme,
    /// Whether a step is reported as its two halves: their energies between are not seen, and their bounds are added.
    pub(crate) has_halves: bool,
}

impl<const D: usize> Facts<D> {
    /// Whether a step has one force per spring, that at its middle.
    pub(crate) fn has_one_force(&self) -> bool {
        let is_of_middle = EXACT.contains(&self.scheme) || self.scheme == Scheme::EemDamped;
        is_of_middle && !self.has_halves
    }

    /// Whether a thermostat gives the heat of a step at one temperature, not in a part of mechanics and one of heat.
    pub(crate) fn has_one_temperature(&self) -> bool {
        self.has_one_force() && self.scheme != Scheme::Staggered
    }

    /// Whether its dashpots have also their own viscosity.
    pub(crate) fn has_own_viscosity(&self) -> bool {
        self.has_one_force() && self.scheme != Scheme::EemDamped
    }

    /// Whether the heat of a step is a sum with positive weights, that of each part of a step then being one of its mean
    /// rate at least.
    pub(crate) fn has_positive_weights(&self) -> bool {
        !matches!(self.scheme, Scheme::EemExplicit | Scheme::Auto)
    }

    /// Whether the impulses of its loads are known: those of a force at the middle of a step, or none.
    pub(crate) fn has_known_impulses(&self) -> bool {
        let is_loaded = !self.forces.is_empty() || self.gravity.iter().any(|g| g.abs() > 0.0);
        !is_loaded || self.has_one_force()
    }
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
            motions: Vec::new(),
            kept: Vec::new(),
            ovens: Vec::new(),
            paths: 0,
            scheme: Scheme::Auto,
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

    /// A reservoir whose temperature is given, and whose heat is counted as that of a thermostat.
    pub(crate) fn oven(
        &mut self,
        temperature: impl Fn(f64) -> f64 + Send + Sync + 'static,
    ) -> Reservoir {
        let temperature: OfTime<f64> = Arc::new(temperature);
        self.facts.ovens.push(temperature.clone());
        // It stores no entropy, whose energy would count.
        self.facts.reservoirs.push(0.0);
        self.scene.oven(move |time| temperature(time))
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
        let force: OfTime<[f64; D]> = Arc::new(force);
        self.facts.forces.push((self.index(node), force.clone()));
        self.scene.force(node, move |time| force(time));
    }

    pub(crate) fn move_anchor(
        &mut self,
        anchor: Node,
        position: impl Fn(f64) -> [f64; D] + Send + Sync + 'static,
    ) {
        let position: OfTime<[f64; D]> = Arc::new(position);
        let place = self.index(anchor);
        self.facts.motions.push((place, position.clone()));
        self.scene.move_anchor(anchor, move |time| position(time));
    }

    pub(crate) fn prescribe_temperature(
        &mut self,
        element: Element,
        temperature: impl Fn(f64) -> f64 + Send + Sync + 'static,
    ) {
        let temperature: OfTime<f64> = Arc::new(temperature);
        let place = self.place(element);
        self.facts.kept.push((place, temperature.clone()));
        let temperature = move |time| temperature(time);
        self.scene.prescribe_temperature(element, temperature);
    }

    pub(crate) fn hold_temperature(&mut self, element: Element, temperature: f64) {
        let place = self.place(element);
        self.facts
            .kept
            .push((place, Arc::new(move |_| temperature)));
        self.scene.hold_temperature(element, temperature);
    }

    /// Ready to be stepped, and watched while it is.
    pub(crate) fn start(mut self, scheme: Scheme, step: f64) -> Result<Watched<D>, SceneError> {
        self.facts.scheme = scheme;
        Ok(Watched::new(
            Simulation::new(self.scene, scheme, step)?,
            self.facts,
        ))
    }

    /// All nodes, in the order in which they were added.
    pub(crate) fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    fn place(&self, element: Element) -> usize {
        let place = self.elements.iter().position(|own| *own == element);
        place.expect("a spring of this scene")
    }

    fn index(&self, node: Node) -> usize {
        let place = self.nodes.iter().position(|own| *own == node);
        place.expect("a node of this scene")
    }
}
