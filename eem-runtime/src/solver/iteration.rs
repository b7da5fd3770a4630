//! The global system of an iteration, and what its solution means.

use super::Solver;
use crate::group::{Group, StepView};
use crate::newton::Largest;
use crate::scalar::Real;

impl<S: Real, const D: usize> Solver<S, D> {
    /// Starts the system of an iteration at the trial state.
    pub(super) fn balance(&mut self) {
        let (values, right, _) = self.tangent.renew();
        for seen in &self.seen {
            right[seen.place.row] = [S::zero()];
        }
        let rows = right.as_flattened_mut().as_chunks_mut::<D>().0;
        for (node, rows) in self.nodes.iter().zip(rows) {
            node.balance(
                &self.trial.displacements[node.place.node()],
                self.twice_per_step,
                values,
                rows,
            );
        }
    }

    /// The largest entry of R.
    pub(super) fn residual(&self) -> S {
        let mut largest = Largest::none();
        for &[row] in &self.tangent.right()[..self.nodes.len() * D] {
            largest.see(row);
        }
        largest.found()
    }

    /// Applies the solution to the trial state, where it starts the next system, and finds the local
    /// corrections that go with it; the largest scaled update.
    pub(super) fn correct(&mut self, groups: &mut [Box<dyn Group<S, D>>]) -> S {
        let (values, right, solution) = self.tangent.renew();
        let trial = &mut self.trial;
        let mut largest = Largest::none();
        let changes = solution.as_flattened().as_chunks::<D>().0;
        let rows = right.as_flattened_mut().as_chunks_mut::<D>().0;
        for ((node, change), rows) in self.nodes.iter_mut().zip(changes).zip(rows) {
            let at = node.place.node();
            let mut displacement = trial.displacements[at];
            let per_length = self.per_length[at];
            node.previous = displacement;
            // One by one, as they have been found: a copy of all would have to wait for them.
            for axis in 0..D {
                let change = change[axis];
                displacement[axis] += change;
                largest.see(change * per_length);
            }
            trial.displacements[at] = displacement;
            node.balance(&displacement, self.twice_per_step, values, rows);
        }
        for seen in &mut self.seen {
            let row = seen.place.row;
            // What rounding to Θ + δΘ leaves of δΘ: with a large conductance a rounding of Θ is a
            // large heat; the local unknowns must answer to the Θ that will be used.
            let theta = trial.seen_temperatures[seen.place.slot];
            let change = (theta + solution[row][0]) - theta;
            solution[row][0] = change;
            right[row] = [S::zero()];
            seen.previous = theta;
            trial.seen_temperatures[seen.place.slot] = theta + change;
            largest.see(change / theta);
        }
        for group in groups.iter_mut() {
            largest.see(group.correct(self.tangent.solution()));
        }
        largest.found()
    }

    /// Halves the way of the trial from where it was before the last correction, and starts the next
    /// system there.
    pub(super) fn halve(&mut self) {
        let halved = |from: S, to: S| from + S::from_f64(0.5) * (to - from);
        let trial = &mut self.trial;
        for node in &self.nodes {
            let displacement = &mut trial.displacements[node.place.node()];
            for (to, &from) in displacement.iter_mut().zip(&node.previous) {
                *to = halved(from, *to);
            }
        }
        for seen in &self.seen {
            let theta = &mut trial.seen_temperatures[seen.place.slot];
            *theta = halved(seen.previous, *theta);
        }
        self.balance();
    }

    /// The present trial is where the next correction starts.
    pub(super) fn hold(&mut self) {
        for node in &mut self.nodes {
            node.previous = self.trial.displacements[node.place.node()];
        }
        for seen in &mut self.seen {
            seen.previous = self.trial.seen_temperatures[seen.place.slot];
        }
    }

    /// Makes displacements larger by a factor and leaves everything else.
    pub(super) fn extrapolate(
        &mut self,
        groups: &mut [Box<dyn Group<S, D>>],
        view: &StepView<'_, S>,
        factor: S,
    ) {
        self.weigh(view);
        self.hold();
        let growth = factor - S::one();
        for node in &self.nodes {
            self.trial.displacements[node.place.node()] = node
                .previous
                .map(|component| component + growth * component);
        }
        for group in groups {
            group.hold();
        }
        self.balance();
    }
}
