//! The global system at a trial state of choice.

use super::Solver;
use super::begin::Start;
use crate::element::group::{Group, StepView};
use crate::step::error::StepFailure;
use crate::step::solver::converge::Purpose;
use crate::step::solver::effort::{Effort, Iteration};
use eem_material::number::scalar::{Mask, Real};

impl<S: Real, const D: usize> Solver<S, D> {
    /// Residual and tangent at given global unknowns, with the local ones solved for.
    pub(crate) fn linearize(
        &mut self,
        groups: &mut [Box<dyn Group<S, D>>],
        view: &StepView<'_, S>,
        unknowns: &[S],
        effort: &mut Effort<S>,
    ) -> Result<(Vec<S>, Vec<S>), StepFailure> {
        self.begin(groups, view, Start::Foretold)?;
        let (moving, per_set) = (self.moving(), self.rows_per_set());
        for (set, nodes) in self.nodes.chunks(moving).enumerate() {
            let displacements = unknowns[set * per_set..].as_chunks::<D>().0;
            for (node, &displacement) in nodes.iter().zip(displacements) {
                self.trial.rests[node.place.in_trial()] = [S::zero(); D];
                self.trial.displacements[node.place.in_trial()] = displacement;
            }
        }
        for seen in &self.seen {
            self.trial.seen.set(seen.in_trial, unknowns[seen.row]);
        }
        // Whatever fails, the global unknowns stay.
        self.tangent.solution_mut().fill([S::zero()]);
        let mut before = S::MAX;
        loop {
            self.balance(view);
            self.advance(groups, view, Purpose::Iterate)?;
            let residual = self.residual();
            if before.at_most(S::EPSILON).decide()? {
                break;
            }
            let updates = groups.iter_mut();
            let updates =
                updates.map(|group| group.correct(self.tangent.solution(), S::Mask::none()));
            let update = updates.fold(S::zero(), S::maximum);
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
}
