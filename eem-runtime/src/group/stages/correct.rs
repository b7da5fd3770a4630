//! From the solution of the global system to the internal variables of the stages.

use super::local::LocalStages;
use super::member::StageMember;
use super::{END, MIDDLE, StageView, ThreeStageGroup};
use crate::free_energy::{Array, FreeEnergy};
use crate::group::arms::along;
use crate::kinematics::Kinematics;
use crate::scalar::Real;

impl<S, M, K, const D: usize> ThreeStageGroup<S, M, K, D>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S, D>,
{
    /// See [`StageGroup::correct`](super::StageGroup::correct).
    pub(super) fn correct_all(&mut self, view: &StageView<'_, S>, solution: &[[S; 1]]) -> S {
        let mut largest = S::zero();
        for (member, stages) in self.elements.members.iter().zip(&mut self.members) {
            let heat = stages.heat_change(view, member.slots().thermal, solution);
            stages.find_inputs(heat, solution, &mut self.local);
            largest = largest.maximum(stages.correct(&self.local));
        }
        largest
    }
}

impl<S, M, K, const D: usize> StageMember<S, M, K, D>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S, D>,
{
    /// The changes of the inputs that go with the global ones.
    fn find_inputs(&self, heat: [S; 2], solution: &[[S; 1]], local: &mut LocalStages<S>) {
        let (measures, rest) = local.inputs.split_at_mut(2 * M::MEASURES);
        for (half, measures) in measures.chunks_exact_mut(M::MEASURES).enumerate() {
            let motion = self.site.quarters[half][0].motion_in(solution);
            let rows = self.gradients[MIDDLE + half].as_ref().iter();
            for (input, row) in measures.iter_mut().zip(rows) {
                *input = along::<K, S, D>(row, &motion);
            }
        }
        for (input, change) in rest.iter_mut().zip(heat) {
            *input = change;
        }
    }

    /// Finds the corrections of the local unknowns for given inputs; the largest in their units.
    fn correct(&mut self, local: &LocalStages<S>) -> S {
        self.hold();
        let unknowns = Self::UNKNOWNS;
        let mut largest = S::zero();
        for u in 0..unknowns {
            let mut change = -self.solved[u];
            for (j, &input) in local.inputs.iter().enumerate() {
                change -= self.solved[(1 + j) * unknowns + u] * input;
            }
            let (stage, index, scale) = if u < 2 * M::DASHPOTS {
                let stage = MIDDLE + u / M::DASHPOTS;
                // The first measure of the old state.
                (stage, M::MEASURES + u % M::DASHPOTS, self.x[0][0])
            } else {
                let stage = if u == 2 * M::DASHPOTS { 0 } else { END };
                (stage, M::Variables::LEN - 1, self.temperature(stage))
            };
            self.correction[stage][index] = change;
            largest = largest.maximum((change / scale).abs());
        }
        largest
    }
}
