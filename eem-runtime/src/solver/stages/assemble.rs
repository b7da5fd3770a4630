//! The global system of an iteration over the stages, and what its solution means.

use super::StageSolver;
use crate::group::{StageGroup, StageView};
use crate::scalar::Real;
use crate::scheme::variational_4;

impl<S: Real> StageSolver<S> {
    /// Residual and tangent of the motions to the middle and to the end,
    ///
    /// ```text
    /// R_m = (2m/h)(q_m − q⁰) − p⁰ + (h/12)(2F_0 + F_m)
    /// R_1 = (m/h)(q¹ − q⁰) − p⁰ + (h/6)(F_0 + 2F_m)
    /// ```
    ///
    /// and of `Θ_i − θ_i = 0` for the temperatures that neighbours see. Returns the largest entry of R.
    pub(super) fn assemble<const D: usize>(
        &mut self,
        groups: &mut [Box<dyn StageGroup<S, D>>],
        view: &StageView<'_, S>,
    ) -> S {
        self.system.clear();
        for group in groups.iter_mut() {
            group.assemble(view, &self.trial, &mut self.system);
        }
        let mut largest = S::zero();
        let momenta = view.state.momenta.values();
        for half in 0..2 {
            for (node, first) in view.layout.nodes.iter().enumerate() {
                let (Some(mass), Some(first)) = (self.masses[node], *first) else {
                    continue;
                };
                let inertia = inertia(mass, half, view.step);
                for axis in 0..self.dimension {
                    let at = node * self.dimension + axis;
                    let row = half * view.layout.unknowns + first + axis;
                    let rest = momenta[at] + loads(view, half, at);
                    let displacement = self.trial.displacements[half][at];
                    self.system.add(row, row, inertia);
                    self.system.add_right(row, rest - inertia * displacement);
                    largest = largest.maximum(self.system.right()[row].abs());
                }
            }
        }
        largest
    }

    /// Makes the corrections of Θ those that rounding to `Θ + δΘ` leaves of them.
    ///
    /// With a large conductance a rounding of Θ is a large heat; the local unknowns
    /// must answer to the Θ that will be used.
    fn round_seen_temperatures(&mut self, view: &StageView<'_, S>) {
        let solution = self.system.right_mut();
        for half in 0..2 {
            let seen = &self.trial.seen_temperatures[2 * half];
            for (unknown, &seen) in view.layout.coupled.iter().zip(seen) {
                if let Some(at) = *unknown {
                    let at = half * view.layout.unknowns + at;
                    solution[at] = (seen + solution[at]) - seen;
                }
            }
        }
    }

    /// Distributes the solution; the largest scaled update.
    pub(super) fn correct<const D: usize>(
        &mut self,
        groups: &mut [Box<dyn StageGroup<S, D>>],
        view: &StageView<'_, S>,
    ) -> S {
        self.remember();
        self.round_seen_temperatures(view);
        let mut largest = S::zero();
        for half in 0..2 {
            let solution = &self.system.right()[half * view.layout.unknowns..];
            for (node, first) in view.layout.nodes.iter().enumerate() {
                let Some(first) = *first else { continue };
                for axis in 0..self.dimension {
                    let change = solution[first + axis];
                    self.correction[0][half][node * self.dimension + axis] = change;
                    largest = largest.maximum((change / self.lengths[node]).abs());
                }
            }
            let seen = &self.trial.seen_temperatures[2 * half];
            for (slot, unknown) in view.layout.coupled.iter().enumerate() {
                let change = unknown.map_or(S::zero(), |at| solution[at]);
                self.correction[1][half][slot] = change;
                largest = largest.maximum((change / seen[slot]).abs());
            }
        }
        largest.maximum(correct_locally(groups, view, self.system.right()))
    }
}

/// Corrects the local unknowns for given global corrections; the largest scaled update.
pub(super) fn correct_locally<S: Real, const D: usize>(
    groups: &mut [Box<dyn StageGroup<S, D>>],
    view: &StageView<'_, S>,
    solution: &[S],
) -> S {
    let updates = groups.iter_mut().map(|group| group.correct(view, solution));
    updates.fold(S::zero(), S::maximum)
}

/// `2m/h` for the motion to the middle, `m/h` for that to the end.
pub(super) fn inertia<S: Real>(mass: S, half: usize, step: S) -> S {
    let inertia = mass / step;
    if half == 0 {
        inertia + inertia
    } else {
        inertia
    }
}

/// The impulse of the loads on a coordinate in the equation of one half, N s.
pub(super) fn loads<S: Real>(view: &StageView<'_, S>, half: usize, at: usize) -> S {
    let weights = variational_4::MIDDLE_AND_END[half].iter().zip(view.loads);
    weights.fold(S::zero(), |sum, (&weight, loads)| {
        sum + view.step * S::from_f64(weight) * loads.total_force[at]
    })
}
