//! A scene with the handles of everything in it.

use eem::prelude::*;
use eem::{FreeEnergy, HeatPartner};

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
#[derive(Debug, Default)]
pub struct Build<const D: usize> {
    /// The scene itself, for what has no method here.
    pub scene: Scene<D>,
    /// What is in it.
    pub handles: Handles,
}

impl<const D: usize> Build<D> {
    /// An empty scene.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// A node that does not move; m.
    pub fn anchor(&mut self, position: [f64; D]) -> Node {
        let node = self.scene.anchor(position);
        self.handles.nodes.push(node);
        node
    }

    /// A mass (kg) with its position (m) and velocity (m/s).
    pub fn mass(&mut self, mass: f64, position: [f64; D], velocity: [f64; D]) -> Node {
        let node = self.scene.mass(mass, position, velocity);
        self.handles.nodes.push(node);
        node
    }

    /// A spring without temperature.
    pub fn spring<M>(&mut self, model: M, ends: [Node; 2]) -> Element
    where
        M: FreeEnergy<f64> + Send + Sync + 'static,
    {
        let spring = self.scene.spring(model, ends);
        self.handles.elements.push(spring);
        spring
    }

    /// A spring with its initial temperature, K.
    pub fn warm<M>(&mut self, model: M, ends: [Node; 2], temperature: f64) -> Element
    where
        M: FreeEnergy<f64> + Send + Sync + 'static,
    {
        let spring = self.spring(model, ends);
        self.scene.set_temperature(spring, temperature);
        spring
    }

    /// A reservoir, K.
    pub fn reservoir(&mut self, temperature: f64) -> Reservoir {
        let reservoir = self.scene.reservoir(temperature);
        self.handles.reservoirs.push(reservoir);
        reservoir
    }

    /// A path of heat, W/K.
    pub fn conduct(&mut self, from: Element, to: impl Into<HeatPartner>, conductance: f64) {
        self.scene.conduct(from, to, conductance);
    }
}
