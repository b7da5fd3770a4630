//! The global system at a trial state of choice.

use core::array;

use super::iteration::correct_locally;
use super::{Iteration, Look, Solver};
use crate::error::StepFailure;
use crate::group::{Group, StepView};
use crate::scalar::Real;

impl<S: Real, const D: usize> Solver<S, D> {
    /// Residual and tangent at given global unknowns, with the local ones solved for.
    pub(crate) fn linearize(
        &mut self,
        groups: &mut [Box<dyn Group<S, D>>],
        view: &StepView<'_, S>,
        unknowns: &[S],
    ) -> Result<(Vec<S>, Vec<S>), StepFailure> {
        self.begin(groups, view)?;
        for mass in &self.masses {
            self.correction.0[mass.node] = array::from_fn(|axis| unknowns[mass.row + axis]);
        }
        for seen in &self.seen {
            self.correction.1[seen.slot] = unknowns[seen.row] - self.previous.1[seen.slot];
        }
        let no_change = vec![[S::zero()]; self.tangent.right().len()];
        let mut before = None;
        loop {
            self.advance(groups, view, Look::On)?;
            let residual = self.balance(view);
            if before.is_some_and(|update| update <= S::EPSILON) {
                break;
            }
            self.remember();
            self.correction.0.fill([S::zero(); D]);
            self.correction.1.fill(S::zero());
            let update = correct_locally(groups, &no_change);
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
        let right = &self.tangent.right()[..unknowns.len()];
        let residual = right.iter().map(|&[entry]| -entry).collect();
        Ok((residual, self.tangent.dense()))
    }
}
