//! From the solution of the global system to the internal variables of the stages.

use super::local::LocalStages;
use super::member::StagePoint;
use super::source::Source;
use crate::element::group::stages::stage_group::StageGroup;
use crate::element::kinematics::{Arms, Kinematics};
use crate::element::tableau::{MOST_SETS, Tableau};
use eem_material::free_energy::{Array, Material};
use eem_material::number::scalar::Real;

impl<S: Real, M: Material<S>, K: Kinematics<S, D>, C: Source<S, M, K, D>, const D: usize>
    StageGroup<S, M, K, C, D>
{
    /// See [`Group::correct`](crate::element::group::Group::correct).
    pub(super) fn correct_all(&mut self, solution: &[[S; 1]]) -> S {
        let (rule, local) = (self.rule, &mut self.local);
        let mut largest = S::zero();
        for stages in &mut self.members {
            let mut motions = [Arms::<K, S, D>::filled([S::zero(); D]); MOST_SETS];
            for (set, motion) in motions.iter_mut().enumerate().take(rule.sets()) {
                *motion = stages.site.sets[set][set].motion_in(solution);
            }
            for point in &mut stages.points {
                point.find_inputs(rule, &motions, solution, local);
                C::hold(point);
                let update = C::correct(point, rule, local);
                C::apply(point, rule, S::one());
                largest = largest.maximum(update);
            }
        }
        largest
    }
}

impl<S: Real, M: Material<S>, K: Kinematics<S, D>, C: Source<S, M, K, D>, const D: usize>
    StagePoint<S, M, K, C, D>
{
    /// The changes of the inputs that go with the global ones.
    fn find_inputs(
        &self,
        rule: &Tableau,
        motions: &[Arms<K, S, D>; MOST_SETS],
        solution: &[[S; 1]],
        local: &mut LocalStages<S>,
    ) {
        let (strains, heat) = local.inputs.split_at_mut(rule.sets() * C::FORCES);
        C::inputs(self, rule, motions, strains);
        for (stage, input) in heat.iter_mut().enumerate() {
            *input = self.heat_change(rule, stage, solution);
        }
    }

    /// The change of Q at a stage that a solution means, W.
    fn heat_change(&self, rule: &Tableau, stage: usize, solution: &[[S; 1]]) -> S {
        let mut change = S::zero();
        let contacts = self.contacts.iter().flatten().enumerate();
        for (set, contacts) in contacts.take(rule.sets()) {
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
