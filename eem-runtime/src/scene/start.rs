//! The rules for the initial state: products of the user's numbers are finite, and prescribed motions and temperatures
//! begin at the initial values.

use super::Scene;
use crate::element::handle::{Element, HeatPartner, Node};
use crate::scene::entry::{NodeEntry, infinite};
use crate::scene::error::SceneError;
use crate::scene::loads::{MOTION_ROUNDINGS, extent};
use eem_material::number::scalar::{Mask, Real};

impl<const D: usize, S: Real> Scene<D, S> {
    /// Products that are not finite, and jumps at t = 0. All numbers are valid by themselves.
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
        if let Some((axis, value)) = infinite(momentum.as_slice()).next() {
            return Err(SceneError::Momentum { node, axis, value });
        }
        let components = momentum.iter();
        let energy = components.fold(S::zero(), |sum, &p| sum + p * p / (mass + mass));
        if !energy.is_finite() {
            let components = momentum.iter();
            let momentum = components.fold(S::zero(), |length, &p| length.hypot(p));
            return Err(SceneError::KineticEnergy {
                node,
                value: energy.to_f64(),
                momentum: momentum.to_f64(),
                mass: mass.to_f64(),
            });
        }
        let weight = self.loads.gravity.map(|component| mass * component);
        match infinite(weight.as_slice()).next() {
            None => Ok(()),
            Some((axis, value)) => Err(SceneError::Weight { node, axis, value }),
        }
    }

    /// The initial heat flow of each conductance, and the sum of all flows to an element.
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
            // The flow of entropy at the colder end, which is the larger one.
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

    /// Motions of anchors begin where the anchors were created.
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

/// Whether rounding explains a difference from a function of this size. False for NaN.
fn is_rounding<S: Real>(difference: S, size: S) -> bool {
    let bound = S::from_f64(MOTION_ROUNDINGS) * S::EPSILON * size;
    difference.abs().at_most(bound).all()
}
