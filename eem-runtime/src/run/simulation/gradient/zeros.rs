//! A gradient of zeros, to which the derivatives of each step are added.

use std::collections::BTreeSet;

use super::derivatives::Outline;
use crate::run::gradient::result::{Gradient, OfElement};
use crate::run::gradient::series::Series;
use crate::run::gradient::timed::Timed;
use crate::run::simulation::Simulation;
use crate::scene::loads::Course;
use crate::step::adjoint::PerVariable;
use nalgebra::SVector;

impl<const D: usize> Simulation<D> {
    /// A gradient of zeros, with the names of all parameters.
    pub(super) fn no_gradient(&self, outline: &Outline) -> Gradient<D> {
        let layout = &outline.layout;
        let coordinates = self.masses.len() * D;
        let mut elements = Vec::with_capacity(self.places.len());
        for (index, &[group, at]) in self.places.iter().enumerate() {
            let of_group = self.stepper.elements(group as usize);
            let element = of_group.handle(at as usize);
            let names = of_group.parameters();
            elements.push(OfElement {
                element,
                slots: layout.elements[index],
                dashpots: self.shapes[group as usize].dashpots,
                names,
                units: of_group.parameter_units(),
                viscous_unit: self.viscous_unit(group as usize),
                values: vec![0.0; names.len()],
            });
        }
        Gradient {
            scene: self.scene.clone(),
            value: 0.0,
            unit: String::new(),
            growth: 1.0,
            start: PerVariable::zero(coordinates, layout, self.conduction.reservoirs.len()),
            moving: (0..self.masses.len())
                .filter(|&node| self.masses.get(node).is_some())
                .collect(),
            masses: vec![0.0; self.masses.len()],
            pairs: outline.pairs.iter().map(|&nodes| (nodes, 0.0)).collect(),
            gravity: SVector::from_element(0.0),
            conductances: vec![0.0; self.conduction.path_ends().len()],
            reservoirs: vec![0.0; self.conduction.reservoirs.len()],
            elements,
            sizes: Vec::new(),
            started: self.time(),
            timed: self.timed(),
            forces: empty(self.loads.forces.iter().map(|(node, _)| node.index)),
            thrusts: self
                .loads
                .rockets
                .iter()
                .map(|rocket| (rocket.line.node.index, Series(Vec::new())))
                .collect(),
            ovens: empty(self.loads.ovens.iter().map(|&(index, _)| index)),
            motions: empty(self.loads.motions.iter().map(|(node, _)| node.index)),
            temperatures: empty(self.loads.temperatures.iter().map(|(own, _)| own.index())),
        }
    }

    /// The loads that are functions of time.
    fn timed(&self) -> Vec<Timed> {
        let loads = &self.loads;
        let forces = loads.forces.iter();
        let forces = forces.filter(|(_, of)| matches!(of, Course::Function(_)));
        let motions = loads.motions.iter();
        let motions = motions.filter(|(_, of)| matches!(of, Course::Function(_)));
        let held = loads.temperatures.iter();
        let held = held.filter(|(_, of)| matches!(of, Course::Function(_)));
        let rockets = loads.rockets.iter().enumerate().map(|(place, rocket)| {
            let node = rocket.line.node;
            let before = loads.rockets[..place].iter();
            let before = before.filter(|other| other.line.node.index == node.index);
            Timed::Thrust(node, before.count())
        });
        let ovens = loads.ovens.iter();
        forces
            .map(|&(node, _)| Timed::Force(node))
            .chain(motions.map(|&(node, _)| Timed::Motion(node)))
            .chain(held.map(|&(element, _)| Timed::Thermostat(element)))
            .chain(rockets)
            .chain(ovens.map(|&(index, _)| Timed::Oven(self.scene.reservoir(index))))
            .collect()
    }
}

/// Empty series for these indices, each once.
fn empty<T>(indices: impl Iterator<Item = usize>) -> Vec<(usize, Series<T>)> {
    let indices: BTreeSet<usize> = indices.collect();
    indices
        .into_iter()
        .map(|index| (index, Series(Vec::new())))
        .collect()
}
