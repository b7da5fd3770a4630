//! The global system over the stages at a trial state of choice.

use super::assemble::correct_locally;
use super::{Effort, StageSolver};
use crate::error::StepFailure;
use crate::group::{StageGroup, StageView};
use crate::scalar::Real;
use crate::solver::Iteration;

impl<S: Real> StageSolver<S> {
    /// Residual and tangent at given global unknowns, with the local ones solved for.
    pub(crate) fn linearize<const D: usize>(
        &mut self,
        groups: &mut [Box<dyn StageGroup<S, D>>],
        view: &StageView<'_, S>,
        unknowns: &[S],
        effort: &mut Effort<'_, S>,
    ) -> Result<(Vec<S>, Vec<S>), StepFailure> {
        self.begin(groups, view);
        self.distribute(view, unknowns);
        let no_change = vec![S::zero(); unknowns.len()];
        let mut before = None;
        loop {
            self.advance(groups, view)?;
            let residual = self.assemble(groups, view);
            if before.is_some_and(|update| update <= S::EPSILON) {
                break;
            }
            self.remember();
            for correction in self.correction.iter_mut().flatten() {
                correction.fill(S::zero());
            }
            let update = correct_locally(groups, view, &no_change);
            effort.history.push(Iteration { residual, update });
            let stagnated = before.is_some_and(|before| update >= before);
            if !update.is_finite() || effort.history.len() > effort.settings.max_iterations {
                let update = update.to_f64();
                return Err(StepFailure::NotConverged { update });
            }
            if stagnated && update <= effort.settings.tolerance {
                break;
            }
            before = Some(update);
        }
        let residual = self.system.right().iter().map(|&entry| -entry).collect();
        Ok((residual, self.system.matrix().to_vec()))
    }

    /// Makes the correction the one that leads to these unknowns.
    fn distribute(&mut self, view: &StageView<'_, S>, unknowns: &[S]) {
        for half in 0..2 {
            let unknowns = &unknowns[half * view.layout.unknowns..];
            for (node, first) in view.layout.nodes.iter().enumerate() {
                let own = node * self.dimension..(node + 1) * self.dimension;
                for (axis, change) in self.correction[0][half][own].iter_mut().enumerate() {
                    *change = first.map_or(S::zero(), |first| unknowns[first + axis]);
                }
            }
            for (slot, unknown) in view.layout.coupled.iter().enumerate() {
                let old = self.previous[1][half][slot];
                let change = unknown.map_or(S::zero(), |at| unknowns[at] - old);
                self.correction[1][half][slot] = change;
            }
        }
    }
}
