//! The rules for a scene, and for its initial state: products of the user's numbers are finite, and prescribed motions
//! and temperatures begin at the initial values.

use core::mem;

use super::plan::{Groups, Plan};
use crate::element::conduction::Conductor;
use crate::element::error::StateError;
use crate::element::handle::{Element, HeatPartner, Node};
use crate::element::layout::Shape;
use crate::element::loads::PushLine;
use crate::scene::entry::{ElementEntry, INVALID, infinite};
use crate::scene::error::{RocketError, SceneError};
use crate::scene::loads::{MOTION_ROUNDINGS, extent};
use eem_material::number::scalar::{Scalar, is_positive};

impl Plan {
    /// All errors; those of the initial state only if all numbers are valid by themselves.
    pub(crate) fn check(&self, groups: &dyn Groups) -> Vec<SceneError> {
        let mut errors = self.errors.clone();
        // Nodes of an invalid solid are not checked: their errors would follow from its own.
        let invalid = self.entries.elements.iter();
        let invalid = invalid.filter(|entry| entry.group == INVALID);
        let is_invalid = self.marked(invalid.flat_map(|entry| &entry.nodes));
        for index in 0..self.entries.nodes.len() {
            if is_invalid.get(index) != Some(&true) {
                self.check_node(self.node_at(index), &mut errors);
            }
        }
        let nodes = self.entries.nodes.iter().enumerate();
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
        for (index, entry) in self.entries.elements.iter().enumerate() {
            let Some(shape) = groups.shape(entry.group) else {
                continue;
            };
            let element = self.element_at(index, groups);
            let infinite = groups.infinite_parameter(entry.group, entry.place);
            if let Some((parameter, value)) = infinite {
                errors.push(SceneError::Parameter {
                    element,
                    parameter,
                    value,
                });
            }
            check_element(element, entry, shape, &mut errors);
        }
        self.check_loads(groups, &mut errors);
        self.check_rockets(&mut errors);
        self.check_conductors(groups, &mut errors);
        if !self.start.is_finite() {
            let value = self.start;
            errors.push(SceneError::StartTime { value });
        }
        if errors.is_empty() {
            let mut momentum = vec![0.0; self.dimension()];
            for (index, entry) in self.entries.nodes.iter().enumerate() {
                if let Some(mass) = entry.mass {
                    self.find_momentum(index, mass, &mut momentum);
                    let (node, vectors) =
                        (self.node_at(index), [&momentum[..], &self.loads.gravity]);
                    errors.extend(check_products((node, mass), vectors).err());
                }
            }
            let flows = check_heat_flows(&self.entries.elements, &self.conductors, &reservoirs);
            errors.extend(flows.err());
            self.check_motions(&mut errors);
            self.check_thermostats(&mut errors);
        }
        errors
    }

    fn check_node(&self, node: Node, errors: &mut Vec<SceneError>) {
        errors.extend(self.check_position(node).err());
        let entry = &self.entries.nodes[node.index];
        if entry.momentum.is_none() {
            for (axis, value) in infinite(self.velocity(node.index)) {
                errors.push(SceneError::Velocity { node, axis, value });
            }
        }
        if let Some(mass) = entry.mass.filter(|&mass| !is_positive(mass)) {
            let value = mass;
            errors.push(SceneError::Mass { node, value });
        }
    }

    /// An error unless the position of a node is finite.
    pub(super) fn check_position(&self, node: Node) -> Result<(), SceneError> {
        match infinite(self.position(node.index)).next() {
            Some((axis, value)) => Err(SceneError::Position { node, axis, value }),
            None => Ok(()),
        }
    }

    fn check_loads(&self, groups: &dyn Groups, errors: &mut Vec<SceneError>) {
        let gravity = infinite(&self.loads.gravity);
        errors.extend(gravity.map(|(axis, value)| SceneError::Gravity { axis, value }));
        let twice = |handle: &dyn core::fmt::Display, quantity| SceneError::PrescribedTwice {
            handle: handle.to_string(),
            quantity,
        };
        let mut are_prescribed = Vec::new();
        for (element, _) in &self.loads.temperatures {
            self.check_thermal(*element, groups, errors);
            are_prescribed.resize(self.entries.elements.len(), false);
            if mem::replace(&mut are_prescribed[element.index()], true) {
                errors.push(twice(element, "the temperature"));
            }
        }
        let mut are_moved = Vec::new();
        for (anchor, _) in &self.loads.motions {
            are_moved.resize(self.entries.nodes.len(), false);
            if mem::replace(&mut are_moved[anchor.index], true) {
                errors.push(twice(anchor, "the motion"));
            }
        }
    }

    fn check_rockets(&self, errors: &mut Vec<SceneError>) {
        let moves = |node: Node| {
            let mut motions = self.loads.motions.iter();
            self.entries.nodes[node.index].mass.is_some()
                || motions.any(|&(moved, _)| moved == node)
        };
        for rocket in &self.loads.rockets {
            let PushLine { node, tail, head } = rocket.line;
            let [from, to] = [tail, head].map(|end| self.position(end.index));
            if from == to && !moves(tail) && !moves(head) {
                errors.push(RocketError::NoLength { node, tail, head }.into());
            }
        }
    }

    fn check_conductors(&self, groups: &dyn Groups, errors: &mut Vec<SceneError>) {
        for conductor in &self.conductors {
            let (element, partner) = (conductor.element, conductor.partner);
            self.check_thermal(element, groups, errors);
            if let HeatPartner::Element(other) = partner {
                if other == element {
                    errors.push(SceneError::SelfConduction { element });
                } else {
                    self.check_thermal(other, groups, errors);
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

    fn check_thermal(&self, element: Element, groups: &dyn Groups, errors: &mut Vec<SceneError>) {
        let shape = groups.shape(self.entries.elements[element.index()].group);
        let error = SceneError::NotThermal { element };
        if shape.is_some_and(|shape| !shape.thermal) && !errors.contains(&error) {
            errors.push(error);
        }
    }

    /// Motions of anchors must begin where the anchors were created.
    fn check_motions(&self, errors: &mut Vec<SceneError>) {
        let scale = extent(&self.entries.positions);
        let mut place = vec![0.0; self.dimension()];
        for (anchor, motion) in &self.loads.motions {
            let created = self.position(anchor.index);
            motion.find_position(self.start, created, 0.0, &mut place);
            for (axis, (&prescribed, &created)) in place.iter().zip(created).enumerate() {
                if !is_rounding(prescribed - created, scale) {
                    errors.push(SceneError::AnchorJump {
                        node: *anchor,
                        axis,
                        created,
                        prescribed,
                    });
                }
            }
        }
    }

    /// Thermostats must begin at the initial temperature.
    fn check_thermostats(&self, errors: &mut Vec<SceneError>) {
        for (element, temperature) in &self.loads.temperatures {
            let Some(initial) = self.entries.elements[element.index()].temperature else {
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
