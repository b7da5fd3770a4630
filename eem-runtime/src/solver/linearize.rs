//! The global system at a trial state of choice.

use super::assemble::correct_locally;
use super::{Iteration, Solver};
use crate::error::StepFailure;
use crate::group::{Group, StepView};
use crate::scalar::Real;

impl<S: Real> Solver<S> {
    /// Residual and tangent at given global unknowns, with the local ones solved for.
    pub(crate) fn linearize<const D: usize>(
        &mut self,
        groups: &mut [Box<dyn Group<S, D>>],
        view: &StepView<'_, S>,
        unknowns: &[S],
    ) -> Result<(Vec<S>, Vec<S>), StepFailure> {
        self.begin(groups, view)?;
        self.distribute(view, unknowns);
        for (slot, unknown) in view.layout.coupled.iter().enumerate() {
            let change = unknown.map_or(S::zero(), |at| unknowns[at] - self.previous[1][slot]);
            self.correction[1][slot] = change;
        }
        let no_change = vec![S::zero(); unknowns.len()];
        let mut before = None;
        loop {
            self.advance(groups, view)?;
            let residual = self.assemble(groups, view);
            if before.is_some_and(|update| update <= S::EPSILON) {
                break;
            }
            self.remember();
            self.distribute(view, &no_change);
            self.correction[1].fill(S::zero());
            let update = correct_locally(groups, view, &no_change);
            self.history.push(Iteration { residual, update });
            let stagnated = before.is_some_and(|before| update >= before);
            if !update.is_finite() || self.history.len() > self.settings.max_iterations {
                let update = update.to_f64();
                return Err(StepFailure::NotConverged { update });
            }
            if stagnated && update <= self.settings.tolerance {
                break;
            }
            before = Some(update);
        }
        let residual = self.system.right().iter().map(|&entry| -entry).collect();
        Ok((residual, self.system.matrix().to_vec()))
    }

    /// Writes the displacements among global unknowns to the correction.
    fn distribute(&mut self, view: &StepView<'_, S>, unknowns: &[S]) {
        for (node, first) in view.layout.nodes.iter().enumerate() {
            let own = node * self.dimension..(node + 1) * self.dimension;
            for (axis, change) in self.correction[0][own].iter_mut().enumerate() {
                *change = first.map_or(S::zero(), |first| unknowns[first + axis]);
            }
        }
    }
}
