//! The global system of an iteration, and what its solution means.

use core::array;

use super::Solver;
use crate::group::{Group, StepView, points};
use crate::newton::Largest;
use crate::scalar::{Real, unless};

impl<S: Real, const D: usize> Solver<S, D> {
    /// Starts residual and tangent of the momentum balances, with `p¹` eliminated,
    ///
    /// ```text
    /// R = (2m/h)(q¹ − q⁰) − 2p⁰ + h F
    /// ```
    ///
    /// to which the elements will add their share.
    pub(super) fn balance(&mut self) {
        self.tangent.clear_matrix();
        let (values, right) = self.tangent.parts();
        for seen in &self.seen {
            right[seen.place.row] = [S::zero()];
        }
        let rows = right.as_flattened_mut().as_chunks_mut::<D>().0;
        for (node, rows) in self.nodes.iter().zip(rows) {
            for place in node.place.diagonal {
                values[place] = node.inertia;
            }
            let displacement = &self.trial.displacements[node.place.node];
            *rows = array::from_fn(|axis| node.rest[axis] - node.inertia * displacement[axis]);
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

    /// Applies the solution to the trial state, and finds the local corrections that go with it; the
    /// largest scaled update.
    pub(super) fn correct(
        &mut self,
        groups: &mut [Box<dyn Group<S, D>>],
        view: &StepView<'_, S>,
    ) -> S {
        self.tangent.clear_rest::<D>();
        let solution = self.tangent.right_mut();
        let old = points::<S, D>(view.state.positions.values());
        let trial = &mut self.trial;
        let settled = trial.settled;
        let mut largest = Largest::none();
        let changes = solution.as_flattened().as_chunks::<D>().0;
        for (node, change) in self.nodes.iter_mut().zip(changes) {
            let at = node.place.node;
            let displacement = &mut trial.displacements[at];
            // One by one, as they have been found: a copy of all would have to wait for them.
            for axis in 0..D {
                let (from, change) = (displacement[axis], change[axis]);
                (node.previous[axis], node.correction[axis]) = (from, change);
                displacement[axis] = unless(settled, from, from + change);
                largest.see(change * node.per_length);
            }
            trial.positions[at] = array::from_fn(|axis| old[at][axis] + displacement[axis]);
        }
        for seen in &mut self.seen {
            // What rounding to Θ + δΘ leaves of δΘ: with a large conductance a rounding of Θ is a
            // large heat; the local unknowns must answer to the Θ that will be used.
            let theta = trial.seen_temperatures[seen.place.slot];
            let change = (theta + solution[seen.place.row][0]) - theta;
            solution[seen.place.row][0] = change;
            (seen.previous, seen.correction) = (theta, change);
            trial.seen_temperatures[seen.place.slot] = unless(settled, theta, theta + change);
            largest.see(change / theta);
        }
        for group in groups.iter_mut() {
            largest.see(group.correct(self.tangent.right()));
        }
        unless(settled, S::zero(), largest.found())
    }

    /// Moves the trial to a share of the correction from where it was.
    pub(super) fn apply(&mut self, share: S, view: &StepView<'_, S>) {
        let trial = &mut self.trial;
        let old = points::<S, D>(view.state.positions.values());
        for node in &self.nodes {
            let at = node.place.node;
            let moved = |axis: usize| node.previous[axis] + share * node.correction[axis];
            trial.displacements[at] = array::from_fn(moved);
            trial.positions[at] = array::from_fn(|axis| old[at][axis] + moved(axis));
        }
        for seen in &self.seen {
            let theta = seen.previous + share * seen.correction;
            trial.seen_temperatures[seen.place.slot] = theta;
        }
    }

    /// The present trial is where the next correction starts; no correction.
    pub(super) fn hold(&mut self) {
        for node in &mut self.nodes {
            node.previous = self.trial.displacements[node.place.node];
            node.correction = [S::zero(); D];
        }
        for seen in &mut self.seen {
            seen.previous = self.trial.seen_temperatures[seen.place.slot];
            seen.correction = S::zero();
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
        for node in &mut self.nodes {
            node.correction = node.previous.map(|component| growth * component);
        }
        for group in groups {
            group.hold();
        }
        self.apply(S::one(), view);
    }
}
