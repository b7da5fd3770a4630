//! The global system of an iteration, and what its solution means.

use super::Solver;
use crate::group::{Group, StepView};
use crate::scalar::Real;

impl<S: Real> Solver<S> {
    /// Residual and tangent of the momentum balances, with `p¹` eliminated,
    ///
    /// ```text
    /// R = (2m/h)(q¹ − q⁰) − 2p⁰ + h F
    /// ```
    ///
    /// and of `Θ − θ* = 0` for the temperatures that neighbours see. Returns the largest entry of R.
    pub(super) fn assemble<const D: usize>(
        &mut self,
        groups: &mut [Box<dyn Group<S, D>>],
        view: &StepView<'_, S>,
    ) -> S {
        self.system.clear();
        for group in groups.iter_mut() {
            group.assemble(view, &self.trial, &mut self.system);
        }
        let mut largest = S::zero();
        let momenta = view.state.momenta.values();
        for (node, mass) in self.masses.iter().enumerate() {
            let (Some(mass), Some(first)) = (*mass, view.layout.nodes[node]) else {
                continue;
            };
            let inertia = (mass + mass) / view.step;
            if !view.phase.moves() {
                for row in first..first + self.dimension {
                    self.system.add(row, row, S::one());
                }
                continue;
            }
            for axis in 0..self.dimension {
                let (at, row) = (node * self.dimension + axis, first + axis);
                let rest = momenta[at] + momenta[at] - view.step * self.old_force[at];
                self.system.add(row, row, inertia);
                self.system
                    .add_right(row, rest - inertia * self.trial.displacements[at]);
                largest = largest.maximum(self.system.right()[row].abs());
            }
        }
        largest
    }

    /// Makes the corrections of Θ those that rounding to `Θ + δΘ` leaves of them.
    ///
    /// With a large conductance a rounding of Θ is a large heat; the local unknowns
    /// must answer to the Θ that will be used.
    fn round_seen_temperatures(&mut self, view: &StepView<'_, S>) {
        let solution = self.system.right_mut();
        for (unknown, &seen) in view
            .layout
            .coupled
            .iter()
            .zip(&self.trial.seen_temperatures)
        {
            if let Some(at) = *unknown {
                solution[at] = (seen + solution[at]) - seen;
            }
        }
    }

    /// Distributes the solution; the largest scaled update.
    pub(super) fn correct<const D: usize>(
        &mut self,
        groups: &mut [Box<dyn Group<S, D>>],
        view: &StepView<'_, S>,
    ) -> S {
        self.remember();
        self.round_seen_temperatures(view);
        let solution = self.system.right();
        let mut largest = S::zero();
        for (node, first) in view.layout.nodes.iter().enumerate() {
            let Some(first) = *first else { continue };
            for axis in 0..self.dimension {
                let change = solution[first + axis];
                self.correction[0][node * self.dimension + axis] = change;
                largest = largest.maximum((change / self.lengths[node]).abs());
            }
        }
        for (slot, unknown) in view.layout.coupled.iter().enumerate() {
            let change = unknown.map_or(S::zero(), |at| solution[at]);
            self.correction[1][slot] = change;
            largest = largest.maximum((change / self.trial.seen_temperatures[slot]).abs());
        }
        largest.maximum(correct_locally(groups, view, solution))
    }
}

/// Corrects the local unknowns for given global corrections; the largest scaled update.
pub(super) fn correct_locally<S: Real, const D: usize>(
    groups: &mut [Box<dyn Group<S, D>>],
    view: &StepView<'_, S>,
    solution: &[S],
) -> S {
    let updates = groups.iter_mut().map(|group| group.correct(view, solution));
    updates.fold(S::zero(), S::maximum)
}
