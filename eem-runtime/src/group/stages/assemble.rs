//! From the stages of the elements to the global system.

use super::local::LocalStages;
use super::member::StageMember;
use super::{END, MIDDLE, StageTrial, StageView, ThreeStageGroup, heat};
use crate::free_energy::{Array, FreeEnergy};
use crate::group::arms::{arms, measures_in, scale};
use crate::kinematics::{Arms, Kinematics};
use crate::scalar::Real;
use crate::scheme::variational_4;
use crate::system::LinearSystem;

impl<S, M, K, const D: usize> ThreeStageGroup<S, M, K, D>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S, D>,
{
    /// See [`StageGroup::assemble`](super::StageGroup::assemble).
    pub(super) fn assemble_all(
        &mut self,
        view: &StageView<'_, S>,
        trial: &StageTrial<S, D>,
        system: &mut LinearSystem<S, 1>,
    ) {
        let (values, right) = system.parts();
        let members = self.elements.members.iter().zip(&self.members);
        for (member, stages) in members {
            let mut target = Target {
                view,
                slot: member.slots().thermal,
                local: &mut self.local,
                values,
                right,
            };
            for stage in [0, MIDDLE] {
                for measure in 0..M::MEASURES {
                    stages.assemble_force(stage, measure, &mut target);
                }
            }
            stages.assemble_turn(
                self.elements.kinematics,
                &trial.positions[MIDDLE],
                &mut target,
            );
            stages.assemble_temperatures(trial, &mut target);
        }
    }
}

/// Where an element writes.
struct Target<'a, S: Real> {
    view: &'a StageView<'a, S>,
    slot: Option<usize>,
    local: &'a mut LocalStages<S>,
    values: &'a mut [S],
    right: &'a mut [[S; 1]],
}

impl<S, M, K, const D: usize> StageMember<S, M, K, D>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S, D>,
{
    /// The derivatives of the quantity that has been eliminated last: by the arms of the middle and
    /// of the end, and by `Q_0` and `Q_m`.
    fn slopes(&self, local: &LocalStages<S>) -> ([Arms<K, S, D>; 2], [S; 2]) {
        let by = &local.row[1..];
        let mut by_arm = [Arms::<K, S, D>::filled([S::zero(); D]); 2];
        let (measures, heat) = by.split_at(2 * M::MEASURES);
        for (half, sum) in by_arm.iter_mut().enumerate() {
            let rows = self.gradients[MIDDLE + half].as_ref().iter();
            for (row, &by) in rows.zip(&measures[half * M::MEASURES..]) {
                for (sum, arm) in sum.as_mut().iter_mut().zip(row.as_ref()) {
                    for (sum, &entry) in sum.iter_mut().zip(arm) {
                        *sum += by * entry;
                    }
                }
            }
        }
        let heat = match *heat {
            [start, middle] => [start, middle],
            _ => [S::zero(); 2],
        };
        (by_arm, heat)
    }

    /// The impulses of the force `f ∂π/∂q` of one measure at a stage and their derivatives, with the
    /// direction held.
    fn assemble_force(&self, stage: usize, measure: usize, target: &mut Target<'_, S>) {
        let point = &self.points[stage];
        self.eliminate(target.local, stage, &point.hessian[measure]);
        let value = point.gradient[measure] + target.local.row[0];
        let (by_arm, by_heat) = self.slopes(target.local);
        let along = &self.gradients[stage][measure];
        for (half, weights) in variational_4::MIDDLE_AND_END.iter().enumerate() {
            let impulse = target.view.step * S::from_f64(weights[stage]);
            let mut pull = *along;
            scale::<K, S, D>(&mut pull, impulse * value);
            let site = &self.site.quarters[half][0];
            site.subtract_arms(&pull, &site.rows, target.right.as_flattened_mut());
            for (site, by_arm) in self.site.quarters[half].iter().zip(&by_arm) {
                for (i, along) in along.as_ref().iter().enumerate() {
                    for (j, by) in by_arm.as_ref().iter().enumerate() {
                        let block = along.map(|entry| by.map(|by| impulse * entry * by));
                        site.add_block([i + 1, j + 1], &block, target.values);
                    }
                }
            }
            let heat = by_heat.map(|by| impulse * by);
            self.assemble_heat(half, heat, along, target);
        }
    }

    /// What `start Q_0 + middle Q_m` does to the rows of the nodes, each with its direction.
    fn assemble_heat(
        &self,
        half: usize,
        factors: [S; 2],
        along: &Arms<K, S, D>,
        target: &mut Target<'_, S>,
    ) {
        let (Some(slot), Some(contacts)) = (target.slot, &self.site.contacts) else {
            return;
        };
        let site = &self.site.quarters[half][0];
        for (column, contact) in contacts[half].iter().enumerate() {
            let (own, partners) = heat::slopes(target.view, slot, contact, column, factors);
            let times = |factor: S| {
                let mut arms = *along;
                scale::<K, S, D>(&mut arms, factor);
                arms
            };
            site.add_column(&contact.column, &times(own), target.values);
            for (by, partner) in partners {
                site.add_column(&partner.column, &times(by), target.values);
            }
        }
    }

    /// What the forces of the middle do when their directions turn.
    fn assemble_turn(&self, kinematics: K, positions: &[[S; D]], target: &mut Target<'_, S>) {
        let r = arms::<K, S, D>(&self.site.common().nodes, positions);
        let measures = measures_in::<K, S, D>(&self.x[MIDDLE]);
        let forces = measures_in::<K, S, D>(&self.points[MIDDLE].gradient);
        let blocks = kinematics.curvature(&r, &measures, &forces);
        for (half, weights) in variational_4::MIDDLE_AND_END.iter().enumerate() {
            let impulse = target.view.step * S::from_f64(weights[MIDDLE]);
            let site = &self.site.quarters[half][0];
            for (i, row) in blocks.as_ref().iter().enumerate() {
                for (j, block) in row.as_ref().iter().enumerate() {
                    let block = block.map(|row| row.map(|entry| impulse * entry));
                    site.add_block([i + 1, j + 1], &block, target.values);
                }
            }
        }
    }

    /// The equations `Θ_i − θ_i = 0` of an element whose temperatures neighbours see.
    fn assemble_temperatures(&self, trial: &StageTrial<S, D>, target: &mut Target<'_, S>) {
        let (Some(slot), Some(contacts)) = (target.slot, &self.site.contacts) else {
            return;
        };
        let mut by = M::Variables::filled(S::zero());
        by[M::Variables::LEN - 1] = S::one();
        for (half, stage) in [0, END].into_iter().enumerate() {
            self.eliminate(target.local, stage, &by);
            let theta = self.temperature(stage) + target.local.row[0];
            let (by_arm, by_heat) = self.slopes(target.local);
            let own = &contacts[half][half];
            let seen = trial.seen_temperatures[stage][slot];
            target.right[own.unknown as usize][0] += theta - seen;
            target.values[own.diagonal as usize] += S::one();
            for (column, contact) in contacts[half].iter().enumerate() {
                let site = &self.site.quarters[half][column];
                site.subtract_arms(&by_arm[column], &contact.row, target.values);
                let (own, partners) = heat::slopes(target.view, slot, contact, column, by_heat);
                target.values[contact.diagonal as usize] -= own;
                for (by, partner) in partners {
                    target.values[partner.entry as usize] -= by;
                }
            }
        }
    }
}
