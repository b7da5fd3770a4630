//! The rules of the initial state: products of the user's numbers are finite, and what is
//! prescribed begins where the scene does.

use super::Scene;
use crate::element::handle::{Element, HeatPartner, Node};
use crate::scene::entry::NodeEntry;
use crate::scene::error::SceneError;
use crate::scene::loads::{MOTION_ROUNDINGS, extent};
use eem_material::number::scalar::{Mask, Real};

impl<const D: usize, S: Real> Scene<D, S> {
    /// Products that are not finite, and jumps at t = 0. All single numbers have been checked.
    pub(super) fn check_start(&self, errors: &mut Vec<SceneError>) {
        for (index, entry) in self.nodes.iter().enumerate() {
            errors.extend(self.check_products(self.node_at(index), entry).err());
        }
        errors.extend(self.check_heat_flows().err());
        self.check_motions(errors);
        self.check_thermostats(errors);
    }

    /// Momentum, kinetic energy and weight of a mass.
    fn check_products(&self, node: Node, entry: &NodeEntry<S, D>) -> Result<(), SceneError> {
        let Some(mass) = entry.mass else {
            return Ok(());
        };
        let momentum = entry.start_momentum(mass);
        if let Some(axis) = (0..D).find(|&axis| !momentum[axis].is_finite()) {
            let value = momentum[axis].to_f64();
            return Err(SceneError::Momentum { node, axis, value });
        }
        let components = momentum.iter();
        let energy = components.fold(S::zero(), |sum, &p| sum + p * p / (mass + mass));
        if !energy.is_finite() {
            let momentum = momentum
                .iter()
                .fold(S::zero(), |length, &p| length.hypot(p));
            return Err(SceneError::KineticEnergy {
                node,
                value: energy.to_f64(),
                momentum: momentum.to_f64(),
                mass: mass.to_f64(),
            });
        }
        let weight = self.loads.gravity.map(|component| mass * component);
        match (0..D).find(|&axis| !weight[axis].is_finite()) {
            None => Ok(()),
            Some(axis) => Err(SceneError::Weight {
                node,
                axis,
                value: weight[axis].to_f64(),
            }),
        }
    }

    /// What flows along each path of heat, and along all paths to an element together.
    fn check_heat_flows(&self) -> Result<(), SceneError> {
        let temperature = |element: Element| self.elements[element.index()].temperature;
        let mut received = vec![S::zero(); self.elements.len()];
        for conductor in &self.conductors {
            let (element, partner) = (conductor.element, conductor.partner);
            let (there, other) = match partner {
                HeatPartner::Element(other) => (temperature(other), Some(other)),
                HeatPartner::Reservoir(reservoir) => (Some(self.reservoirs[reservoir.index]), None),
            };
            let (Some(here), Some(there)) = (temperature(element), there) else {
                continue;
            };
            let flow = conductor.conductance * (there - here);
            let mut largest = flow.abs();
            for end in [Some(element), other].into_iter().flatten() {
                received[end.index()] += flow.abs();
                largest = largest.maximum(received[end.index()]);
            }
            // The entropy is that of the colder end, the larger of the two.
            let entropy = flow / here.minimum(there);
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
                    value: value.to_f64(),
                    unit,
                });
            }
        }
        Ok(())
    }

    /// Moved anchors are where they were created.
    fn check_motions(&self, errors: &mut Vec<SceneError>) {
        let positions = self.nodes.iter().map(|node| &node.position);
        let scale = extent(positions.flat_map(|position| position.iter()));
        for (anchor, motion) in &self.loads.motions {
            let created = self.nodes[anchor.index].position;
            let prescribed = motion(S::zero());
            for axis in 0..D {
                if !is_rounding(prescribed[axis] - created[axis], scale) {
                    errors.push(SceneError::AnchorJump {
                        node: *anchor,
                        axis,
                        created: created[axis].to_f64(),
                        prescribed: prescribed[axis].to_f64(),
                    });
                }
            }
        }
    }

    /// Thermostats begin at the initial temperature.
    fn check_thermostats(&self, errors: &mut Vec<SceneError>) {
        for (element, temperature) in &self.loads.temperatures {
            let Some(initial) = self.elements[element.index()].temperature else {
                continue;
            };
            let prescribed = temperature(S::zero());
            if !is_rounding(prescribed - initial, initial) {
                errors.push(SceneError::TemperatureJump {
                    element: *element,
                    initial: initial.to_f64(),
                    prescribed: prescribed.to_f64(),
                });
            }
        }
    }
}

/// Whether a difference is a number and not more than rounding does to a function of this size.
fn is_rounding<S: Real>(difference: S, size: S) -> bool {
    let bound = S::from_f64(MOTION_ROUNDINGS) * S::EPSILON * size;
    difference.abs().at_most(bound).all()
}
