//! A scene whose numbers are of any type, with the handles of everything in it.

use eem::prelude::*;
use eem::{FreeEnergy, HeatPartner, Real};

/// Everything in a scene, in the order in which it was made.
#[derive(Debug, Default)]
pub struct Handles {
    /// All nodes.
    pub nodes: Vec<Node>,
    /// All springs and points of solids.
    pub elements: Vec<Element>,
    /// All reservoirs.
    pub reservoirs: Vec<Reservoir>,
}

/// A scene under construction.
#[derive(Debug)]
pub struct Build<const D: usize, S: Real> {
    /// The scene itself, for what has no method here.
    pub scene: Scene<D, S>,
    /// What is in it.
    pub handles: Handles,
    /// Initial velocities are multiplied by it, so that members of an ensemble differ.
    factor: S,
}

/// A vector of numbers of any type.
#[must_use]
pub fn vector<S: Real, const D: usize>(numbers: [f64; D]) -> [S; D] {
    numbers.map(S::from_f64)
}

impl<const D: usize, S: Real> Build<D, S> {
    /// An empty scene whose initial velocities are multiplied by `factor`.
    #[must_use]
    pub fn new(factor: S) -> Self {
        Self {
            scene: Scene::default(),
            handles: Handles::default(),
            factor,
        }
    }

    /// A node that does not move; m.
    pub fn anchor(&mut self, position: [f64; D]) -> Node {
        let node = self.scene.anchor(vector(position));
        self.handles.nodes.push(node);
        node
    }

    /// A mass (kg) with its position (m) and velocity (m/s).
    pub fn mass(&mut self, mass: f64, position: [f64; D], velocity: [f64; D]) -> Node {
        let velocity = self.scaled(velocity);
        let node = self
            .scene
            .mass(S::from_f64(mass), vector(position), velocity);
        self.handles.nodes.push(node);
        node
    }

    /// A velocity, times the factor of this scene.
    pub fn scaled(&self, velocity: [f64; D]) -> [S; D] {
        velocity.map(|component| S::from_f64(component) * self.factor)
    }

    /// A spring without temperature.
    pub fn spring<M>(&mut self, model: M, ends: [Node; 2]) -> Element
    where
        M: FreeEnergy<S> + Send + Sync + 'static,
    {
        let spring = self.scene.spring(model, ends);
        self.handles.elements.push(spring);
        spring
    }

    /// A spring with its initial temperature, K.
    pub fn warm<M>(&mut self, model: M, ends: [Node; 2], temperature: f64) -> Element
    where
        M: FreeEnergy<S> + Send + Sync + 'static,
    {
        let spring = self.spring(model, ends);
        self.scene.set_temperature(spring, S::from_f64(temperature));
        spring
    }

    /// A reservoir, K.
    pub fn reservoir(&mut self, temperature: f64) -> Reservoir {
        let reservoir = self.scene.reservoir(S::from_f64(temperature));
        self.handles.reservoirs.push(reservoir);
        reservoir
    }

    /// A path of heat, W/K.
    pub fn conduct(&mut self, from: Element, to: impl Into<HeatPartner>, conductance: f64) {
        self.scene.conduct(from, to, S::from_f64(conductance));
    }
}
