//! From the stages of the elements to the global system.

use super::heat;
use super::local::LocalStages;
use super::member::{StageArms, StagePoint};
use super::site::StageSite;
use super::source::Source;
use crate::algebra::system::LinearSystem;
use crate::element::error::StateError;
use crate::element::group::arms::scale;
use crate::element::group::stages::stage_group::StageGroup;
use crate::element::group::view::{StepView, Trial};
use crate::element::kinematics::{Arms, Kinematics};
use crate::element::tableau::Tableau;
use crate::material::free_energy::FreeEnergy;
use crate::number::scalar::Real;

impl<S, M, K, C, const D: usize> StageGroup<S, M, K, C, D>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S, D>,
    C: Source<S, M, K, D>,
{
    /// Eliminates the local unknowns at a trial that has been evaluated, and adds residual and tangent.
    pub(super) fn assemble_all(
        &mut self,
        view: &StepView<'_, S>,
        trial: &Trial<S, D>,
        system: &mut LinearSystem<S, 1>,
    ) -> Result<(), StateError> {
        let rule = self.rule;
        let (values, right) = system.parts();
        let members = self.elements.members.iter().zip(&mut self.members);
        for (member, stages) in members {
            let arms = stages.arms(rule, trial);
            let mut target = Target {
                rule,
                step: view.step,
                site: &stages.site,
                local: &mut self.local,
                values: &mut *values,
                right: &mut *right,
            };
            let points = stages.points.iter_mut();
            for (point, in_state) in points.zip(member.points.as_ref()) {
                point.condense(in_state, rule, target.local, view)?;
                for stage in 0..rule.stages() {
                    for force in 0..C::FORCES {
                        point.assemble_force([stage, force], &mut target);
                    }
                    point.assemble_turn(stage, &arms, &mut target);
                }
                if let Some(slot) = in_state.slots().thermal {
                    point.assemble_temperatures(slot, trial, &mut target);
                }
            }
        }
        Ok(())
    }
}

/// Where an element writes.
struct Target<'a, K: Kinematics<S, D>, S: Real, const D: usize> {
    rule: &'static Tableau,
    step: S,
    site: &'a StageSite<K, S, D>,
    local: &'a mut LocalStages<S>,
    values: &'a mut [S],
    right: &'a mut [[S; 1]],
}

impl<K: Kinematics<S, D>, S: Real, const D: usize> Target<'_, K, S, D> {
    /// The weight `h w` of the forces of a stage in the rows of each set on which they act.
    fn impulses(&self, stage: usize) -> impl Iterator<Item = (usize, S)> + use<K, S, D> {
        let (step, sets) = (self.step, self.rule.positions.iter().enumerate());
        let acting = sets.filter(move |(_, weights)| weights[stage] != 0.0);
        acting.map(move |(set, weights)| (set, step * S::from_f64(weights[stage])))
    }
}

impl<S, M, K, C, const D: usize> StagePoint<S, M, K, C, D>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S, D>,
    C: Source<S, M, K, D>,
{
    /// The impulses of a force at a stage and their derivatives, with its direction held.
    fn assemble_force(&self, [stage, force]: [usize; 2], target: &mut Target<'_, K, S, D>) {
        let rule = target.rule;
        let at = [stage, force];
        let value = C::force(self, rule, target.local, at) + target.local.row[0];
        let by_arms = C::by_arms(self, rule, target.local);
        let along = C::direction(self, at);
        for (set, impulse) in target.impulses(stage) {
            let mut pull = along;
            scale::<K, S, D>(&mut pull, impulse * value);
            let site = &target.site.sets[set][set];
            site.subtract_arms(&pull, &site.rows, target.right.as_flattened_mut());
            for (site, by_arm) in target.site.sets[set].iter().zip(&by_arms).take(rule.sets()) {
                for (i, along) in along.as_ref().iter().enumerate() {
                    for (j, by) in by_arm.as_ref().iter().enumerate() {
                        let block = along.map(|entry| by.map(|by| impulse * entry * by));
                        site.add_block([i + 1, j + 1], &block, target.values);
                    }
                }
            }
            self.assemble_heat(set, impulse, &along, target);
        }
    }

    /// What heat from other elements does by way of the quantity that has been eliminated last to the
    /// rows of the nodes, each with its direction.
    fn assemble_heat(
        &self,
        set: usize,
        impulse: S,
        along: &Arms<K, S, D>,
        target: &mut Target<'_, K, S, D>,
    ) {
        let Some(contacts) = &self.contacts else {
            return;
        };
        let rule = target.rule;
        let by_heat = &target.local.row[1 + rule.sets() * C::FORCES..];
        let site = &target.site.sets[set][set];
        for (column, contact) in contacts[set].iter().enumerate().take(rule.sets()) {
            let by = impulse * heat::by_seen(rule, column, by_heat);
            let times = |factor: S| {
                let mut arms = *along;
                scale::<K, S, D>(&mut arms, factor);
                arms
            };
            let own = times(-by * contact.conductance());
            site.add_column(&contact.column, &own, target.values);
            for partner in &contact.partners {
                let by_partner = times(by * partner.conductance);
                site.add_column(&partner.column, &by_partner, target.values);
            }
        }
    }

    /// What the forces of a stage do when their directions turn.
    fn assemble_turn(
        &self,
        stage: usize,
        arms: &StageArms<K, S, D>,
        target: &mut Target<'_, K, S, D>,
    ) {
        let Some(own) = target.rule.set_of(stage) else {
            return;
        };
        for (set, impulse) in target.impulses(stage) {
            let blocks = C::turn(self, target.rule, own, arms);
            let site = &target.site.sets[set][own];
            for (i, row) in blocks.as_ref().iter().enumerate() {
                for (j, block) in row.as_ref().iter().enumerate() {
                    let block = block.map(|row| row.map(|entry| impulse * entry));
                    site.add_block([i + 1, j + 1], &block, target.values);
                }
            }
        }
    }

    /// The equations `Θ − θ = 0` of an element whose temperatures neighbours see.
    fn assemble_temperatures(
        &self,
        slot: usize,
        trial: &Trial<S, D>,
        target: &mut Target<'_, K, S, D>,
    ) {
        let Some(contacts) = &self.contacts else {
            return;
        };
        let rule = target.rule;
        for (set, contacts) in contacts.iter().enumerate().take(rule.sets()) {
            let theta = C::temperature(self, rule, target.local, set) + target.local.row[0];
            let by_arms = C::by_arms(self, rule, target.local);
            let by_heat = &target.local.row[1 + rule.sets() * C::FORCES..];
            let own = &contacts[set];
            let seen = trial.seen.values()[trial.seen_of_set(set, slot)];
            target.right[own.unknown as usize][0] += theta - seen;
            target.values[own.diagonal as usize] += S::one();
            for (column, contact) in contacts.iter().enumerate().take(rule.sets()) {
                let site = &target.site.sets[set][column];
                site.subtract_arms(&by_arms[column], &contact.row, target.values);
                let by = heat::by_seen(rule, column, by_heat);
                target.values[contact.diagonal as usize] += by * contact.conductance();
                for partner in &contact.partners {
                    target.values[partner.entry as usize] -= by * partner.conductance;
                }
            }
        }
    }
}
