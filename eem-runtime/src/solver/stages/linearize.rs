//! The global system over the stages at a trial state of choice.

use super::StageSolver;
use super::assemble::correct_locally;
use crate::error::StepFailure;
use crate::group::{StageGroup, StageView};
use crate::scalar::{Mask, Real};
use crate::solver::places::Seen;
use crate::solver::{Effort, Iteration};

impl<S: Real, const D: usize> StageSolver<S, D> {
    /// Residual and tangent at given global unknowns, with the local ones solved for.
    pub(crate) fn linearize(
        &mut self,
        groups: &mut [Box<dyn StageGroup<S, D>>],
        view: &StageView<'_, S>,
        unknowns: &[S],
        effort: &mut Effort<S>,
    ) -> Result<(Vec<S>, Vec<S>), StepFailure> {
        self.begin(groups, view);
        self.distribute(unknowns);
        let no_change = vec![[S::zero()]; self.tangent.right().len()];
        let mut before = S::MAX;
        loop {
            self.advance(groups, view)?;
            let residual = self.assemble(groups, view);
            if before.at_most(S::EPSILON).decide()? {
                break;
            }
            self.remember();
            for (displacements, seen) in &mut self.correction {
                displacements.fill([S::zero(); D]);
                seen.fill(S::zero());
            }
            let update = correct_locally(groups, view, &no_change);
            effort.history.push(Iteration { residual, update });
            let stagnated = before.at_most(update);
            if !update.is_finite() || effort.history.len() > effort.settings.max_iterations {
                let update = update.to_f64();
                return Err(StepFailure::NotConverged { update });
            }
            if (stagnated & update.at_most(effort.settings.tolerance)).decide()? {
                break;
            }
            before = update;
        }
        let right = &self.tangent.right()[..unknowns.len()];
        let residual = right.iter().map(|&[entry]| -entry).collect();
        Ok((residual, self.tangent.dense()))
    }

    /// Makes the correction the one that leads to these unknowns.
    fn distribute(&mut self, unknowns: &[S]) {
        for (half, (displacements, seen)) in self.correction.iter_mut().enumerate() {
            let own = unknowns[half * self.half..].as_chunks().0;
            for (mass, &displacement) in self.masses[half].iter().zip(own) {
                displacements[mass.node()] = displacement;
            }
            for &Seen { slot, row } in &self.seen[half] {
                seen[slot] = unknowns[row] - self.previous[half].1[slot];
            }
        }
    }
}
