//! A run in the memory of an earlier one: members of an ensemble take it over one from another.
//!
//! Numbers are written anew, so that the bits are those of a run in memory of its own.

use super::Simulation;
use super::stepper::Stepper;
use crate::element::conduction::Conduction;
use crate::scene::Scene;
use crate::step::scheme::Scheme;
use eem_material::number::compact::compact;

impl<const D: usize> Simulation<D> {
    /// Whether another run can begin in the memory of this one: its scene is small and has neither solids nor loads but gravity.
    pub(crate) fn is_reusable(&self) -> bool {
        let Stepper::Newton(newton) = &self.stepper else {
            return false;
        };
        let is_small = newton.solver.is_renewable() && !self.masses.are_coupled();
        is_small && self.loads.are_at_most_weight()
    }

    /// Whether a scene with these paths of heat, stepped by this scheme, differs from that of this run in numbers only.
    pub(super) fn fits(&self, scene: &Scene<D>, scheme: Scheme, conduction: &Conduction) -> bool {
        let masses = scene.nodes.iter().map(|node| node.mass.is_some());
        let shapes = scene.groups.iter().map(|group| group.shape());
        let mut elements = scene.elements.iter().zip(&self.places);
        scheme == self.in_use
            && scene.pairs.is_empty()
            && scene.loads.are_at_most_weight()
            && scene.loads.have_weight() == self.loads.have_weight()
            && masses.eq(self.masses.iter().map(|mass| mass.is_some()))
            && shapes.eq(self.shapes.iter().copied())
            && scene.elements.len() == self.places.len()
            && elements.all(|(entry, &[group, place])| {
                let nodes = self.stepper.elements(group as usize).nodes(place as usize);
                [entry.group, entry.place].map(compact) == [group, place]
                    && nodes
                        .iter()
                        .copied()
                        .eq(entry.nodes.iter().map(|&node| compact(node)))
            })
            && conduction.joins_like(&self.conduction)
    }
}
