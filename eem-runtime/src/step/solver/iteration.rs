//! The global system of an iteration, and what its solution means.

use super::Solver;
use super::places::Seen;
use crate::element::group::{Group, StepView};
use crate::step::newton::Largest;
use eem_material::number::compensated::correct;
use eem_material::number::scalar::{Real, unless};

impl<S: Real, const D: usize> Solver<S, D> {
    /// Starts the system of an iteration at the trial state.
    pub(super) fn balance(&mut self, view: &StepView<'_, S>) {
        let (moving, per_set) = (self.moving(), self.rows_per_set());
        let inertia = self.inertias(view);
        let (values, right, _) = self.tangent.renew();
        for seen in &self.seen {
            right[seen.row] = [S::zero()];
        }
        for (set, nodes) in self.nodes.chunks(moving).enumerate() {
            let rows = right[set * per_set..].as_flattened_mut();
            for (node, rows) in nodes.iter().zip(rows.as_chunks_mut::<D>().0) {
                let at = node.place.in_trial();
                node.balance(
                    [&self.trial.displacements[at], &self.trial.rests[at]],
                    inertia[set],
                    values,
                    rows,
                );
            }
        }
        self.couple(view);
    }

    /// The largest entry of R.
    pub(super) fn residual(&self) -> S {
        let mut largest = Largest::none();
        let (moving, per_set) = (self.moving(), self.rows_per_set());
        for (set, nodes) in self.nodes.chunks(moving).enumerate() {
            for &[row] in &self.tangent.right()[set * per_set..][..nodes.len() * D] {
                largest.see(row);
            }
        }
        largest.found()
    }

    /// Applies the solution to the trial state, where it starts the next system, and finds the local
    /// corrections that go with it; the largest scaled update.
    pub(super) fn correct(
        &mut self,
        groups: &mut [Box<dyn Group<S, D>>],
        view: &StepView<'_, S>,
    ) -> S {
        let (moving, per_set) = (self.moving(), self.rows_per_set());
        let inertia = self.inertias(view);
        let (values, right, solution) = self.tangent.renew();
        let trial = &mut self.trial;
        let settled = trial.settled;
        let mut largest = Largest::none();
        for (set, nodes) in self.nodes.chunks(moving).enumerate() {
            let first = set * per_set;
            let changes = solution[first..].as_flattened().as_chunks::<D>().0;
            let rows = right[first..].as_flattened_mut().as_chunks_mut::<D>().0;
            for ((node, change), rows) in nodes.iter().zip(changes).zip(rows) {
                let at = node.place.in_trial();
                let (mut displacement, mut rest) = (trial.displacements[at], trial.rests[at]);
                let per_length = self.per_length[node.place.node()];
                // One by one, as the solution has been stored: a wider load would stall.
                for axis in 0..D {
                    let change = change[axis];
                    let applied = unless(settled, S::zero(), change);
                    correct(&mut displacement[axis], &mut rest[axis], applied);
                    largest.see(change * per_length);
                }
                (trial.displacements[at], trial.rests[at]) = (displacement, rest);
                node.balance([&displacement, &rest], inertia[set], values, rows);
            }
        }
        for &Seen { in_trial, row, .. } in &self.seen {
            let change = solution[row][0];
            right[row] = [S::zero()];
            largest.see(change / trial.seen.values()[in_trial]);
            trial.seen.add(in_trial, unless(settled, S::zero(), change));
        }
        self.couple(view);
        for group in groups.iter_mut() {
            largest.see(group.correct(self.tangent.solution(), settled));
        }
        unless(settled, S::zero(), largest.found())
    }

    /// Takes a share of the last correction back, and starts the next system there.
    pub(super) fn take_back(&mut self, view: &StepView<'_, S>, share: S) {
        let (moving, per_set) = (self.moving(), self.rows_per_set());
        let trial = &mut self.trial;
        let solution = self.tangent.solution();
        for (set, nodes) in self.nodes.chunks(moving).enumerate() {
            let changes = solution[set * per_set..].as_flattened();
            for (node, change) in nodes.iter().zip(changes.as_chunks::<D>().0) {
                let at = node.place.in_trial();
                for (axis, &change) in change.iter().enumerate() {
                    let displacement = &mut trial.displacements[at][axis];
                    correct(displacement, &mut trial.rests[at][axis], -share * change);
                }
            }
        }
        for &Seen { in_trial, row, .. } in &self.seen {
            trial.seen.add(in_trial, -share * solution[row][0]);
        }
        self.balance(view);
    }

    /// Makes displacements larger by a factor, as a correction, and leaves everything else.
    pub(super) fn extrapolate(
        &mut self,
        groups: &mut [Box<dyn Group<S, D>>],
        view: &StepView<'_, S>,
        factor: S,
    ) {
        self.weigh(view);
        let growth = factor - S::one();
        let (moving, per_set) = (self.moving(), self.rows_per_set());
        let solution = self.tangent.solution_mut();
        for (set, nodes) in self.nodes.chunks(moving).enumerate() {
            let changes = solution[set * per_set..].as_flattened_mut();
            for (node, change) in nodes.iter().zip(changes.as_chunks_mut::<D>().0) {
                let at = node.place.in_trial();
                for (axis, change) in change.iter_mut().enumerate() {
                    let displacement = &mut self.trial.displacements[at][axis];
                    *change = growth * *displacement;
                    correct(displacement, &mut self.trial.rests[at][axis], *change);
                }
            }
        }
        for seen in &self.seen {
            solution[seen.row] = [S::zero()];
        }
        for group in groups {
            group.hold();
        }
        self.balance(view);
    }
}
