//! The energy changes of elements between two states, evaluated again where differences of values are too inaccurate.

use super::arms::{along, arms_in};
use super::placed::PlacedPoint;
use super::point::{Point, variables};
use crate::element::kinematics::{Arms, Ends, Kinematics, MeasureSet, Measures, Numbers};
use crate::element::state::State;
use eem_material::arrays::Arrays;
use eem_material::free_energy::Array;

/// The change of the energy of a point between two states.
pub(super) struct EnergyChange<A: Arrays> {
    /// From values of the energy, with the magnitude of the terms of ψ, J.
    pub(super) by_values: [f64; 2],
    /// From discrete derivatives, J.
    pub(super) by_differences: f64,
    /// `(Δλ, Δγ, Δs)`.
    pub(super) increments: A::Variables,
}

/// The change of the arms of an element between two stored states.
fn change_between<K: Kinematics<D>, const D: usize>(
    nodes: &K::PerNode<u32>,
    [old, new]: [&State; 2],
) -> Arms<K, D> {
    let mut change = Arms::<K, D>::filled([0.0; D]);
    let nodes = nodes.as_ref();
    for (arm, &node) in change.as_mut().iter_mut().zip(&nodes[1..]) {
        for (axis, component) in arm.iter_mut().enumerate() {
            let moved = |node: u32| {
                new.positions
                    .change(node as usize * D + axis, &old.positions)
            };
            *component = moved(node) - moved(nodes[0]);
        }
    }
    change
}

impl<K: Kinematics<D>, const D: usize> PlacedPoint<K, D> {
    /// The measures in two stored states, and their increments.
    pub(super) fn increments_between(
        &self,
        nodes: &K::PerNode<u32>,
        ends: [&State; 2],
    ) -> ([Measures<K, D>; 2], Measures<K, D>) {
        let arms = ends.map(|state| arms_in::<K, D>(nodes, &state.positions));
        let change = change_between::<K, D>(nodes, ends);
        let measures = arms.map(|r| self.kinematics.measure(&r));
        let ends = Ends::new(&self.kinematics, arms, measures);
        let gradient = self.kinematics.discrete_gradient(&ends);
        let mut increments = Measures::<K, D>::filled(0.0);
        for (increment, row) in increments.as_mut().iter_mut().zip(gradient.as_ref()) {
            *increment = along::<K, D>(row, &change);
        }
        (measures, increments)
    }
}

impl<A: Arrays, Q: MeasureSet> Point<A, Q> {
    /// The change of its energy between two states, given the measures there and their increments.
    pub(super) fn balance_between(
        &self,
        (measures, of_measures): ([&Numbers<Q>; 2], &Numbers<Q>),
        [old, new]: [&State; 2],
    ) -> EnergyChange<A> {
        let slots = self.slots();
        let x =
            |measures: &Numbers<Q>, state| variables(&self.model, measures.as_ref(), slots, state);
        let x = [x(measures[0], old), x(measures[1], new)];
        let mut increments = A::Variables::filled(0.0);
        for a in 0..A::MEASURES {
            increments[a] = of_measures[a];
        }
        for k in 0..self.dashpots() {
            increments[A::MEASURES + k] = new.viscous.change(slots.viscous + k, &old.viscous);
        }
        if let Some(slot) = slots.thermal {
            increments[Self::TEMPERATURE] = new.entropies.change(slot, &old.entropies);
        }
        let at = self.element.index();
        let by_values = new.energies[at].value - old.energies[at].value;
        let magnitude = |x| self.model.energy_magnitude(x);
        EnergyChange {
            by_values: [by_values, magnitude(&x[0]) + magnitude(&x[1])],
            by_differences: self.energy_change(&x, &increments),
            increments,
        }
    }

    /// `f*Δλ − Σ g*Δγ + θ*Δs`, J.
    pub(super) fn change_of(response: &A::Response, increments: &A::Variables) -> f64 {
        let mut sum = 0.0;
        for row in 0..Self::VARIABLES {
            let is_dashpot = (A::MEASURES..Self::TEMPERATURE).contains(&row);
            let term = response[row] * increments[row];
            sum += if is_dashpot { -term } else { term };
        }
        sum
    }

    /// `Δe` between two states by discrete derivatives that are evaluated again: if the terms of a free energy cancel,
    /// its values have more rounding than its differences.
    fn energy_change(&self, [x0, x1]: &[A::Variables; 2], increments: &A::Variables) -> f64 {
        let mut old = A::Kept::filled(0.0);
        self.model.keep_for_temperature_form(x0, &mut old);
        let response = self.model.temperature_form_response(&old, x1);
        Self::change_of(&response, increments)
    }
}
