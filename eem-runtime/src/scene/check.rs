//! The rules that a scene must satisfy, one function per rule.

use std::collections::BTreeSet;

use super::Scene;
use crate::element::error::StateError;
use crate::element::handle::{Element, HeatPartner, Node, Reservoir};
use crate::element::layout::Shape;
use crate::number::scalar::{Mask, Real, is_positive};
use crate::scene::entry::{ElementEntry, NodeEntry};
use crate::scene::error::SceneError;

impl<const D: usize, S: Real> Scene<D, S> {
    /// The first thing that is wrong with the description.
    pub(crate) fn check(&self) -> Result<(), SceneError> {
        if let Some(misuse) = self.misuse.first() {
            return Err(misuse.clone());
        }
        for (index, entry) in self.nodes.iter().enumerate() {
            let node = Node {
                scene: self.id,
                index,
            };
            check_node(node, entry)?;
        }
        self.check_solids()?;
        for (index, &temperature) in self.reservoirs.iter().enumerate() {
            let reservoir = Reservoir {
                scene: self.id,
                index,
            };
            check_reservoir(reservoir, temperature)?;
        }
        for (index, entry) in self.elements.iter().enumerate() {
            let element = Element {
                scene: self.id,
                index,
            };
            let group = &self.groups[entry.group];
            group.check_parameters(entry.place, element)?;
            check_element(element, entry, group.shape())?;
        }
        self.check_loads()?;
        self.check_conductors()?;
        self.check_start()
    }

    /// Nodes of solids have velocities, and are not moved.
    fn check_solids(&self) -> Result<(), SceneError> {
        let coupled: BTreeSet<_> = self.pairs.iter().flat_map(|&(nodes, _)| nodes).collect();
        for &index in &coupled {
            let node = Node {
                scene: self.id,
                index,
            };
            if self.nodes[index].momentum.is_some() {
                return Err(SceneError::NodeOfSolid {
                    node,
                    quantity: "a momentum",
                    instead: "give its velocity",
                });
            }
        }
        let mut moved = self.loads.motions.iter().map(|(anchor, _)| *anchor);
        match moved.find(|anchor| coupled.contains(&anchor.index)) {
            None => Ok(()),
            Some(node) => Err(SceneError::NodeOfSolid {
                node,
                quantity: "a prescribed motion",
                instead: "join it to a moved anchor by a stiff spring",
            }),
        }
    }

    fn check_loads(&self) -> Result<(), SceneError> {
        let gravity = &self.loads.gravity;
        if let Some(axis) = (0..D).find(|&axis| !gravity[axis].is_finite()) {
            let value = gravity[axis].to_f64();
            return Err(SceneError::Gravity { axis, value });
        }
        let elements: Vec<_> = self
            .loads
            .temperatures
            .iter()
            .map(|(element, _)| *element)
            .collect();
        for (at, element) in elements.iter().enumerate() {
            self.check_thermal(*element)?;
            if elements[..at].contains(element) {
                return Err(prescribed_twice(element, "the temperature"));
            }
        }
        let anchors: Vec<_> = self
            .loads
            .motions
            .iter()
            .map(|(anchor, _)| *anchor)
            .collect();
        for (at, anchor) in anchors.iter().enumerate() {
            if anchors[..at].contains(anchor) {
                return Err(prescribed_twice(anchor, "the motion"));
            }
        }
        Ok(())
    }

    fn check_conductors(&self) -> Result<(), SceneError> {
        for conductor in &self.conductors {
            let (element, partner) = (conductor.element, conductor.partner);
            self.check_thermal(element)?;
            if let HeatPartner::Element(other) = partner {
                self.check_thermal(other)?;
                if other == element {
                    return Err(SceneError::SelfConduction { element });
                }
            }
            let value = conductor.conductance;
            if !value.is_finite() || value.less(S::zero()).any() {
                return Err(SceneError::Conductance {
                    element,
                    partner,
                    value: value.to_f64(),
                });
            }
        }
        Ok(())
    }

    fn check_thermal(&self, element: Element) -> Result<(), SceneError> {
        let group = self.elements[element.index].group;
        if self.groups[group].shape().thermal {
            Ok(())
        } else {
            Err(SceneError::NotThermal { element })
        }
    }
}

fn prescribed_twice(handle: &dyn core::fmt::Display, quantity: &'static str) -> SceneError {
    let handle = handle.to_string();
    SceneError::PrescribedTwice { handle, quantity }
}

fn check_node<S: Real, const D: usize>(
    node: Node,
    entry: &NodeEntry<S, D>,
) -> Result<(), SceneError> {
    check_position(node, entry)?;
    for axis in 0..D {
        let velocity = entry.velocity[axis];
        if entry.momentum.is_none() && !velocity.is_finite() {
            let value = velocity.to_f64();
            return Err(SceneError::Velocity { node, axis, value });
        }
    }
    match entry.mass {
        Some(mass) if !is_positive(mass) => Err(SceneError::Mass {
            node,
            value: mass.to_f64(),
        }),
        _ => Ok(()),
    }
}

/// An error unless a node is somewhere.
pub(super) fn check_position<S: Real, const D: usize>(
    node: Node,
    entry: &NodeEntry<S, D>,
) -> Result<(), SceneError> {
    for axis in 0..D {
        let position = entry.position[axis];
        if !position.is_finite() {
            let value = position.to_f64();
            return Err(SceneError::Position { node, axis, value });
        }
    }
    Ok(())
}

fn check_reservoir<S: Real>(reservoir: Reservoir, temperature: S) -> Result<(), SceneError> {
    if is_positive(temperature) {
        return Ok(());
    }
    Err(SceneError::ReservoirTemperature {
        reservoir,
        value: temperature.to_f64(),
    })
}

fn check_element<S: Real>(
    element: Element,
    entry: &ElementEntry<S>,
    shape: Shape,
) -> Result<(), SceneError> {
    for &(dashpot, stretch) in &entry.viscous_stretches {
        if dashpot >= shape.dashpots {
            return Err(SceneError::NoSuchDashpot {
                element,
                dashpot,
                dashpots: shape.dashpots,
            });
        }
        if !stretch.is_finite() {
            let value = stretch.to_f64();
            return Err(StateError::ViscousStretch {
                element,
                dashpot,
                value,
                unit: shape.viscous_unit,
            }
            .into());
        }
    }
    match (entry.temperature, shape.thermal) {
        (None, true) => Err(SceneError::MissingTemperature { element }),
        (Some(_), false) => Err(SceneError::NotThermal { element }),
        (Some(temperature), true) if !is_positive(temperature) => {
            let value = temperature.to_f64();
            Err(StateError::Temperature { element, value }.into())
        }
        (None, false) | (Some(_), true) => Ok(()),
    }
}

impl From<StateError> for SceneError {
    fn from(error: StateError) -> Self {
        Self::State(error)
    }
}
