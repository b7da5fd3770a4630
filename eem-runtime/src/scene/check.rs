//! The rules for a scene, and for its initial state: products of the user's numbers are finite, and prescribed motions
//! and temperatures begin at the initial values.

use core::mem;

use super::Scene;
use crate::element::conduction::Conductor;
use crate::element::error::StateError;
use crate::element::handle::{Element, HeatPartner, Node};
use crate::element::layout::Shape;
use crate::element::loads::PushLine;
use crate::scene::entry::{ElementEntry, INVALID, NodeEntry, infinite};
use crate::scene::error::{RocketError, SceneError};
use crate::scene::loads::{MOTION_ROUNDINGS, extent};
use eem_material::number::scalar::{Scalar, is_positive};

impl<const D: usize> Scene<D> {
    /// All errors; those of the initial state only if all numbers are valid by themselves.
    pub(crate) fn check(&self) -> Vec<SceneError> {
        let mut errors = self.errors.clone();
        // Nodes of an invalid solid are not checked: their errors would follow from its own.
        let invalid = self.elements.iter();
        let invalid = invalid.filter(|entry| entry.group == INVALID);
        let is_invalid = self.marked(invalid.flat_map(|entry| &entry.nodes));
        for (index, entry) in self.nodes.iter().enumerate() {
            if is_invalid.get(index) != Some(&true) {
                check_node(self.node_at(index), entry, &mut errors);
            }
        }
        let nodes = self.nodes.iter().enumerate();
        for ((index, entry), is_coupled) in nodes.zip(self.are_coupled()) {
            if is_coupled && entry.momentum.is_some() {
                errors.push(SceneError::NodeOfSolid {
                    node: self.node_at(index),
                    quantity: "a momentum",
                    instead: "give its velocity",
                });
            }
        }
        let reservoirs = self.reservoir_temperatures();
        for (index, &temperature) in reservoirs.iter().enumerate() {
            if !is_positive(temperature) {
                errors.push(SceneError::ReservoirTemperature {
                    reservoir: self.reservoir_at(index),
                    value: temperature,
                });
            }
        }
        for (index, entry) in self.elements.iter().enumerate() {
            let Some(group) = self.groups.get(entry.group) else {
                continue;
            };
            let element = self.element_at(index);
            if let Some((parameter, value)) = group.infinite_parameter(entry.place) {
                errors.push(SceneError::Parameter {
                    element,
                    parameter,
                    value,
                });
            }
            check_element(element, entry, group.shape(), &mut errors);
        }
        self.check_loads(&mut errors);
        self.check_rockets(&mut errors);
        self.check_conductors(&mut errors);
        if !self.start.is_finite() {
            let value = self.start;
            errors.push(SceneError::StartTime { value });
        }
        if errors.is_empty() {
            for (index, entry) in self.nodes.iter().enumerate() {
                if let Some(mass) = entry.mass {
                    let (node, momentum) = (self.node_at(index), entry.start_momentum(mass));
                    let vectors = [momentum.as_slice(), &self.loads.gravity];
                    errors.extend(check_products((node, mass), vectors).err());
                }
            }
            let flows = check_heat_flows(&self.elements, &self.conductors, &reservoirs);
            errors.extend(flows.err());
            self.check_motions(&mut errors);
            self.check_thermostats(&mut errors);
        }
        errors
    }

    fn check_loads(&self, errors: &mut Vec<SceneError>) {
        let gravity = infinite(&self.loads.gravity);
        errors.extend(gravity.map(|(axis, value)| SceneError::Gravity { axis, value }));
        let twice = |handle: &dyn core::fmt::Display, quantity| SceneError::PrescribedTwice {
            handle: handle.to_string(),
            quantity,
        };
        let mut are_prescribed = Vec::new();
        for (element, _) in &self.loads.temperatures {
            self.check_thermal(*element, errors);
            are_prescribed.resize(self.elements.len(), false);
            if mem::replace(&mut are_prescribed[element.index()], true) {
                errors.push(twice(element, "the temperature"));
            }
        }
        let mut are_moved = Vec::new();
        for (anchor, _) in &self.loads.motions {
            are_moved.resize(self.nodes.len(), false);
            if mem::replace(&mut are_moved[anchor.index], true) {
                errors.push(twice(anchor, "the motion"));
            }
        }
    }

    fn check_rockets(&self, errors: &mut Vec<SceneError>) {
        let moves = |node: Node| {
            let mut motions = self.loads.motions.iter();
            self.nodes[node.index].mass.is_some() || motions.any(|&(moved, _)| moved == node)
        };
        for rocket in &self.loads.rockets {
            let PushLine { node, tail, head } = rocket.line;
            let [from, to] = [&self.nodes[tail.index], &self.nodes[head.index]];
            if from.position == to.position && !moves(tail) && !moves(head) {
                errors.push(RocketError::NoLength { node, tail, head }.into());
            }
        }
    }

    fn check_conductors(&self, errors: &mut Vec<SceneError>) {
        for conductor in &self.conductors {
            let (element, partner) = (conductor.element, conductor.partner);
            self.check_thermal(element, errors);
            if let HeatPartner::Element(other) = partner {
                if other == element {
                    errors.push(SceneError::SelfConduction { element });
                } else {
                    self.check_thermal(other, errors);
                }
            }
            let value = conductor.conductance;
            if !value.is_finite() || value < 0.0 {
                errors.push(SceneError::Conductance {
                    element,
                    partner,
                    value,
                });
            }
        }
    }

    fn check_thermal(&self, element: Element, errors: &mut Vec<SceneError>) {
        let group = self.groups.get(self.elements[element.index()].group);
        let error = SceneError::NotThermal { element };
        if group.is_some_and(|group| !group.shape().thermal) && !errors.contains(&error) {
            errors.push(error);
        }
    }

    /// Motions of anchors must begin where the anchors were created.
    fn check_motions(&self, errors: &mut Vec<SceneError>) {
        let mut scale = 0.0;
        for node in &self.nodes {
            scale = Scalar::maximum(scale, extent(node.position.as_slice()));
        }
        for (anchor, motion) in &self.loads.motions {
            let created = self.nodes[anchor.index].position;
            let prescribed = motion.position(self.start, &created.into(), 0.0);
            for axis in 0..D {
                if !is_rounding(prescribed[axis] - created[axis], scale) {
                    errors.push(SceneError::AnchorJump {
                        node: *anchor,
                        axis,
                        created: created[axis],
                        prescribed: prescribed[axis],
                    });
                }
            }
        }
    }

    /// Thermostats must begin at the initial temperature.
    fn check_thermostats(&self, errors: &mut Vec<SceneError>) {
        for (element, temperature) in &self.loads.temperatures {
            let Some(initial) = self.elements[element.index()].temperature else {
                continue;
            };
            let prescribed = temperature.at(self.start, initial, 0.0);
            if !is_rounding(prescribed - initial, initial) {
                errors.push(SceneError::TemperatureJump {
                    element: *element,
                    initial,
                    prescribed,
                });
            }
        }
    }
}

fn check_node<const D: usize>(node: Node, entry: &NodeEntry<D>, errors: &mut Vec<SceneError>) {
    errors.extend(check_position(node, entry).err());
    if entry.momentum.is_none() {
        for (axis, value) in infinite(entry.velocity.as_slice()) {
            errors.push(SceneError::Velocity { node, axis, value });
        }
    }
    if let Some(mass) = entry.mass.filter(|&mass| !is_positive(mass)) {
        let value = mass;
        errors.push(SceneError::Mass { node, value });
    }
}

/// An error unless the position of a node is finite.
pub(super) fn check_position<const D: usize>(
    node: Node,
    entry: &NodeEntry<D>,
) -> Result<(), SceneError> {
    match infinite(entry.position.as_slice()).next() {
        Some((axis, value)) => Err(SceneError::Position { node, axis, value }),
        None => Ok(()),
    }
}

fn check_element(
    element: Element,
    entry: &ElementEntry,
    shape: Shape,
    errors: &mut Vec<SceneError>,
) {
    for &(dashpot, stretch) in &entry.viscous_stretches {
        if let Err(error) = SceneError::expect_dashpot(element, dashpot, shape.dashpots) {
            errors.push(error);
        } else if !stretch.is_finite() {
            let error = StateError::ViscousStretch {
                element,
                dashpot,
                value: stretch,
                unit: shape.viscous_unit,
            };
            errors.push(error.into());
        }
    }
    match (entry.temperature, shape.thermal) {
        (None, true) => errors.push(SceneError::MissingTemperature { element }),
        (Some(_), false) => errors.push(SceneError::NotThermal { element }),
        (Some(temperature), true) if !is_positive(temperature) => {
            let value = temperature;
            errors.push(StateError::Temperature { element, value }.into());
        }
        (None, false) | (Some(_), true) => {}
    }
}

/// An error unless momentum, kinetic energy and weight of a mass are finite.
fn check_products(
    (node, mass): (Node, f64),
    [momentum, gravity]: [&[f64]; 2],
) -> Result<(), SceneError> {
    if let Some((axis, value)) = infinite(momentum).next() {
        return Err(SceneError::Momentum { node, axis, value });
    }
    let components = momentum.iter();
    let energy = components.fold(0.0, |sum, &p| sum + p * p / (mass + mass));
    if !energy.is_finite() {
        let components = momentum.iter();
        return Err(SceneError::KineticEnergy {
            node,
            value: energy,
            momentum: components.fold(0.0, |length, &p| Scalar::hypot(length, p)),
            mass,
        });
    }
    for (axis, acceleration) in gravity.iter().enumerate() {
        let value = mass * acceleration;
        if !value.is_finite() {
            return Err(SceneError::Weight { node, axis, value });
        }
    }
    Ok(())
}

/// An error unless the initial heat flow of each conductance, and the sum of the flows of each element, are finite.
fn check_heat_flows(
    elements: &[ElementEntry],
    conductors: &[Conductor],
    reservoirs: &[f64],
) -> Result<(), SceneError> {
    if conductors.is_empty() {
        return Ok(());
    }
    let temperature = |element: Element| elements[element.index()].temperature;
    let mut received = vec![0.0; elements.len()];
    for conductor in conductors {
        let (element, partner) = (conductor.element, conductor.partner);
        let (there, other) = match partner {
            HeatPartner::Element(other) => (temperature(other), Some(other)),
            HeatPartner::Reservoir(reservoir) => (Some(reservoirs[reservoir.index]), None),
        };
        let (Some(here), Some(there)) = (temperature(element), there) else {
            continue;
        };
        let flow = conductor.conductance * (there - here);
        let mut largest = flow.abs();
        let ends = [Some(element), other];
        for end in ends.into_iter().flatten() {
            received[end.index()] += flow.abs();
            largest = Scalar::maximum(largest, received[end.index()]);
        }
        // The flow of entropy at the colder end, which is the larger one.
        let entropy = flow / Scalar::minimum(here, there);
        let flows = [
            ("heat flow", flow, largest, "W"),
            ("flow of entropy", entropy, entropy, "W/K"),
        ];
        let infinite = flows.iter().find(|(.., largest, _)| !largest.is_finite());
        if let Some(&(quantity, value, _, unit)) = infinite {
            return Err(SceneError::HeatFlow {
                element,
                partner,
                quantity,
                value,
                unit,
            });
        }
    }
    Ok(())
}

/// Whether rounding explains a difference of values of this size. False for NaN.
fn is_rounding(difference: f64, size: f64) -> bool {
    let bound = MOTION_ROUNDINGS * f64::EPSILON * size;
    difference.abs() <= bound
}
