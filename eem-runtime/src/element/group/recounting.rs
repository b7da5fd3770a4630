//! The energy changes of elements between two states, evaluated again where differences of values are too inaccurate.

use super::arms::{along, arms_in, measures_in};
use super::placed::PlacedPoint;
use super::point::Point;
use crate::element::kinematics::{Arms, Ends, Kinematics, MeasureSet};
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

impl<A: Arrays, K: Kinematics<D>, const D: usize> PlacedPoint<A, K, D> {
    /// The change of its energy between two states, given its nodes.
    pub(super) fn balance_between(
        &self,
        nodes: &K::PerNode<u32>,
        ends: [&State; 2],
    ) -> EnergyChange<A> {
        let [r0, r1] = [
            arms_in::<K, D>(nodes, &ends[0].positions),
            arms_in::<K, D>(nodes, &ends[1].positions),
        ];
        let change = change_between::<K, D>(nodes, ends);
        let at = self.element.index();
        let by_values = ends[1].energies[at].value - ends[0].energies[at].value;
        let x = [
            self.variables_in(&r0, ends[0]),
            self.variables_in(&r1, ends[1]),
        ];
        let increments = self.increments_between([&r0, &r1], &change, &x, ends);
        let magnitude = |x| self.model.energy_magnitude(x);
        EnergyChange {
            by_values: [by_values, magnitude(&x[0]) + magnitude(&x[1])],
            by_differences: self.energy_change(&x, &increments),
            increments,
        }
    }

    /// `(Δλ, Δγ, Δs)` between two stored states.
    fn increments_between(
        &self,
        [r0, r1]: [&Arms<K, D>; 2],
        change: &Arms<K, D>,
        [x0, x1]: &[A::Variables; 2],
        [old, new]: [&State; 2],
    ) -> A::Variables {
        let mut increments = A::Variables::filled(0.0);
        let measures = [
            measures_in::<K::Measures>(x0),
            measures_in::<K::Measures>(x1),
        ];
        let ends = Ends::new(&self.kinematics, [*r0, *r1], measures);
        let gradient = self.kinematics.discrete_gradient(&ends);
        for (a, row) in gradient.as_ref().iter().enumerate() {
            increments[a] = along::<K, D>(row, change);
        }
        let slots = self.slots();
        for k in 0..self.dashpots() {
            increments[A::MEASURES + k] = new.viscous.change(slots.viscous + k, &old.viscous);
        }
        if let Some(slot) = slots.thermal {
            increments[A::MEASURES + A::DASHPOTS] = new.entropies.change(slot, &old.entropies);
        }
        increments
    }
}

impl<A: Arrays, Q: MeasureSet> Point<A, Q> {
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
