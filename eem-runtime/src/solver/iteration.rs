//! The global system of an iteration, and what its solution means.

use super::Solver;
use crate::group::{Group, StepView, points};
use crate::scalar::Real;

impl<S: Real, const D: usize> Solver<S, D> {
    /// Completes residual and tangent of the momentum balances, with `p¹` eliminated,
    ///
    /// ```text
    /// R = (2m/h)(q¹ − q⁰) − 2p⁰ + h F
    /// ```
    ///
    /// to which the elements have given their share. Returns the largest entry of R.
    pub(super) fn balance(&mut self, view: &StepView<'_, S>) -> S {
        let (values, right) = self.tangent.parts();
        let mut largest = S::zero();
        let per_step = view.step.recip();
        let momenta = points::<S, D>(view.state.momenta.values());
        for mass in &self.masses {
            if !view.phase.moves() {
                for place in mass.diagonal {
                    values[place] += S::one();
                }
                continue;
            }
            let inertia = (mass.mass + mass.mass) * per_step;
            let (momentum, force) = (&momenta[mass.node], &self.old_force[mass.node]);
            let displacement = &self.trial.displacements[mass.node];
            for &place in &mass.diagonal {
                values[place] += inertia;
            }
            let rows = right[mass.row..].iter_mut().take(D);
            for (axis, [residual]) in rows.enumerate() {
                let rest = momentum[axis] + momentum[axis] - view.step * force[axis];
                *residual += rest - inertia * displacement[axis];
                largest = largest.maximum(residual.abs());
            }
        }
        largest
    }

    /// Distributes the solution; the largest scaled update.
    pub(super) fn correct(&mut self, groups: &mut [Box<dyn Group<S, D>>]) -> S {
        let solution = self.tangent.right_mut();
        let mut largest = S::zero();
        for mass in &self.masses {
            let per_length = self.per_length[mass.node];
            self.previous.0[mass.node] = self.trial.displacements[mass.node];
            let correction = &mut self.correction.0[mass.node];
            for (correction, &[change]) in correction.iter_mut().zip(&solution[mass.row..]) {
                *correction = change;
                largest = largest.maximum((change * per_length).abs());
            }
        }
        for seen in &self.seen {
            // What rounding to Θ + δΘ leaves of δΘ: with a large conductance a rounding of Θ is a
            // large heat; the local unknowns must answer to the Θ that will be used.
            let theta = self.trial.seen_temperatures[seen.slot];
            let change = (theta + solution[seen.row][0]) - theta;
            solution[seen.row][0] = change;
            self.previous.1[seen.slot] = theta;
            self.correction.1[seen.slot] = change;
            largest = largest.maximum((change / theta).abs());
        }
        correct_locally(groups, self.tangent.right()).maximum(largest)
    }
}

/// Corrects the local unknowns for given global corrections; the largest scaled update.
pub(super) fn correct_locally<S: Real, const D: usize>(
    groups: &mut [Box<dyn Group<S, D>>],
    solution: &[[S; 1]],
) -> S {
    let updates = groups.iter_mut().map(|group| group.correct(solution));
    updates.fold(S::zero(), S::maximum)
}
