//! From the solution of the global system to the internal variables of the stages.

use super::local::LocalStages;
use super::member::StageMember;
use crate::element::group::arms::along;
use crate::element::group::stages::stage_group::StageGroup;
use crate::element::kinematics::Kinematics;
use crate::element::tableau::Tableau;
use crate::material::free_energy::{Array, FreeEnergy};
use crate::number::scalar::Real;

impl<S, M, K, const D: usize> StageGroup<S, M, K, D>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S, D>,
{
    /// See [`Group::correct`](crate::element::group::Group::correct).
    pub(super) fn correct_all(&mut self, solution: &[[S; 1]]) -> S {
        let mut largest = S::zero();
        for stages in &mut self.members {
            stages.find_inputs(self.rule, solution, &mut self.local);
            let update = stages.correct(self.rule, &self.local);
            stages.apply(self.rule, S::one());
            largest = largest.maximum(update);
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
    fn find_inputs(&self, rule: &Tableau, solution: &[[S; 1]], local: &mut LocalStages<S>) {
        let (measures, heat) = local.inputs.split_at_mut(rule.sets() * M::MEASURES);
        for (set, measures) in measures.chunks_exact_mut(M::MEASURES).enumerate() {
            let motion = self.site.sets[set][set].motion_in(solution);
            let rows = self.gradients[rule.stage_of(set)].as_ref().iter();
            for (input, row) in measures.iter_mut().zip(rows) {
                *input = along::<K, S, D>(row, &motion);
            }
        }
        for (stage, input) in heat.iter_mut().enumerate() {
            *input = self.heat_change(rule, stage, solution);
        }
    }

    /// Finds the corrections of the local unknowns for given inputs; the largest in their units.
    fn correct(&mut self, rule: &Tableau, local: &LocalStages<S>) -> S {
        self.hold();
        let (unknowns, last) = (local.unknowns(), M::Variables::LEN - 1);
        let mut largest = S::zero();
        for u in 0..unknowns {
            let mut change = -self.solved[u];
            for (j, &input) in local.inputs.iter().enumerate() {
                change -= self.solved[(1 + j) * unknowns + u] * input;
            }
            let creeping = rule.sets() * M::DASHPOTS;
            let (stage, index, scale) = if u < creeping {
                let stage = rule.stage_of(u / M::DASHPOTS);
                (stage, M::MEASURES + u % M::DASHPOTS, self.length)
            } else {
                let stage = rule.entropies[u - creeping].unknown;
                (stage, last, self.temperature(stage))
            };
            self.correction[stage][index] = change;
            largest = largest.maximum((change / scale).abs());
        }
        largest
    }

    /// The change of Q at a stage that a solution means, W.
    fn heat_change(&self, rule: &Tableau, stage: usize, solution: &[[S; 1]]) -> S {
        let mut change = S::zero();
        for (set, contacts) in self.site.contacts.iter().flatten().enumerate() {
            let share = S::from_f64(rule.share(stage, set));
            let contact = &contacts[set];
            let near = solution[contact.unknown as usize][0];
            for partner in &contact.partners {
                let far = solution[partner.unknown as usize][0];
                change += share * partner.conductance * (far - near);
            }
        }
        change
    }
}
