//! The global system of an iteration, and the corrections from its solution.

use super::balance::Interface;
use super::begin::Start;
use super::{Search, Solver};
use crate::algebra::scaled;
use crate::element::group::{Group, StepView};
use crate::step::error::StepFailure;
use crate::step::newton::{Effort, Largest};
use eem_material::number::compensated::correct;
use eem_material::number::scalar::Scalar;

impl<const D: usize> Search<'_, D> {
    /// Applies the solution and the local corrections that follow from it to the trial state, and starts the next system
    /// there. Finds the largest entry of R before, and returns the largest scaled update.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "see `Search::begin`")]
    pub(super) fn correct(&mut self) -> f64 {
        let (values, right, solution) = self.solver.tangent.renew();
        let trial = &mut self.solver.trial;
        let (mut largest, mut residual) = (Largest::default(), Largest::default());
        for node in &self.solver.nodes {
            let at = node.in_trial;
            residual.see_all(node.rows(right));
            let change = node.rows(solution);
            let (mut displacement, mut rest) = (trial.displacements[at], trial.carries[at]);
            // Entry by entry, as the solution was stored: a wider load would stall.
            for axis in 0..D {
                let change = change[axis];
                correct(&mut displacement[axis], &mut rest[axis], change);
                largest.see(change * node.per_length);
            }
            (trial.displacements[at], trial.carries[at]) = (displacement, rest);
            node.balance([&displacement, &rest], values, right);
        }
        for &Interface { in_trial, row, .. } in &self.solver.interfaces {
            let change = solution[row][0];
            right[row] = [0.0];
            largest.see(change / trial.interface.values()[in_trial]);
            trial.interface.add(in_trial, change);
        }
        self.solver.final_residual = residual.found();
        self.solver.couple(self.view);
        for group in &mut *self.groups {
            largest.see(group.correct(self.solver.tangent.solution()));
        }
        largest.found()
    }

    /// Multiplies displacements by a factor, as a correction; all other unknowns stay.
    pub(super) fn extrapolate(&mut self, factor: f64) {
        self.solver.weigh(self.view);
        let growth = factor - 1.0;
        let solution = self.solver.tangent.solution_mut();
        let trial = &mut self.solver.trial;
        for node in &self.solver.nodes {
            let displacement = &mut trial.displacements[node.in_trial];
            let change = scaled(growth, displacement);
            correct_all(displacement, &mut trial.carries[node.in_trial], &change);
            *node.rows_mut(solution) = change;
        }
        for interface in &self.solver.interfaces {
            solution[interface.row] = [0.0];
        }
        for group in &mut *self.groups {
            group.hold();
        }
        self.solver.balance(self.view);
    }
}

impl<const D: usize> Solver<D> {
    /// Starts the system of an iteration at the trial state.
    pub(super) fn balance(&mut self, view: &StepView<'_>) {
        let (values, right, _) = self.tangent.renew();
        for interface in &self.interfaces {
            right[interface.row] = [0.0];
        }
        for node in &self.nodes {
            node.balance(node.moved(&self.trial), values, right);
        }
        self.couple(view);
    }

    /// The largest entry of R.
    #[inline]
    pub(super) fn residual(&self) -> f64 {
        let mut largest = Largest::default();
        for node in &self.nodes {
            largest.see_all(node.rows(self.tangent.right()));
        }
        largest.found()
    }

    /// Takes a fraction of the last correction back, and starts the next system there.
    pub(super) fn take_back(&mut self, view: &StepView<'_>, share: f64) {
        let trial = &mut self.trial;
        let solution = self.tangent.solution();
        for node in &self.nodes {
            let displacement = &mut trial.displacements[node.in_trial];
            let change = scaled(-share, node.rows(solution));
            correct_all(displacement, &mut trial.carries[node.in_trial], &change);
        }
        for &Interface { in_trial, row, .. } in &self.interfaces {
            trial.interface.add(in_trial, -share * solution[row][0]);
        }
        self.balance(view);
    }

    /// Residual and tangent at given global unknowns, with the local ones solved for.
    pub(crate) fn linearize(
        &mut self,
        groups: &mut [Box<dyn Group<D>>],
        view: &StepView<'_>,
        unknowns: &[f64],
        effort: &mut Effort,
    ) -> Result<(Vec<f64>, Vec<f64>), StepFailure> {
        self.search(groups, view).begin(Start::Predicted)?;
        let given = unknowns.as_chunks::<1>().0;
        for node in &self.nodes {
            self.trial.carries[node.in_trial] = [0.0; D];
            self.trial.displacements[node.in_trial] = *node.rows(given);
        }
        for &Interface { in_trial, row, .. } in &self.interfaces {
            self.trial.interface.set(in_trial, unknowns[row]);
        }
        // With a zero solution, a correction that is taken back does not change the global unknowns.
        self.tangent.solution_mut().fill([0.0]);
        let mut before = f64::MAX;
        loop {
            self.balance(view);
            self.search(groups, view).advance(true)?;
            let residual = self.residual();
            if before <= f64::EPSILON {
                break;
            }
            let updates = groups.iter_mut();
            let updates = updates.map(|group| group.correct(self.tangent.solution()));
            let update = updates.fold(0.0, Scalar::maximum);
            effort.note(residual, update);
            let stagnated = before <= update;
            if !update.is_finite() || effort.history.len() > effort.settings.max_iterations {
                return Err(StepFailure::NotConverged { update });
            }
            if stagnated && update <= effort.settings.tolerance {
                break;
            }
            before = update;
        }
        let right = &self.tangent.right()[..unknowns.len()];
        let residual = right.iter().map(|&[entry]| -entry).collect();
        Ok((residual, self.tangent.dense()))
    }
}

/// Adds a change to a vector that is stored with its rest.
fn correct_all<const D: usize>(sum: &mut [f64; D], rest: &mut [f64; D], change: &[f64; D]) {
    for axis in 0..D {
        correct(&mut sum[axis], &mut rest[axis], change[axis]);
    }
}
