//! From the stages of the elements to the global system.

use super::forces::StageForces;
use super::heat;
use super::local::LocalStages;
use super::member::StagePoint;
use super::site::StageSite;
use super::source::Source;
use crate::algebra::system::LinearSystem;
use crate::element::error::StateError;
use crate::element::group::arms::{add_scaled, scale};
use crate::element::group::stages::stage_group::StageGroup;
use crate::element::group::view::{StepView, Trial};
use crate::element::kinematics::{Arms, Kinematics, add_blocks};
use crate::element::tableau::{MOST_STAGES, Tableau};
use eem_material::free_energy::{Array, Material};
use eem_material::number::scalar::Real;

impl<S: Real, M: Material<S>, K: Kinematics<S, D>, C: Source<S, M, K, D>, const D: usize>
    StageGroup<S, M, K, C, D>
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
        let forces = &mut self.forces;
        let members = self.elements.members.iter().zip(&mut self.members);
        for (member, stages) in members {
            let arms = stages.arms(rule, trial);
            forces.clear(rule);
            for (point, in_state) in stages.points.iter_mut().zip(member.points.as_ref()) {
                point.condense(in_state, rule, &mut self.local, view)?;
                let mut target = Target {
                    rule,
                    step: view.step,
                    site: &stages.site,
                    local: &mut self.local,
                    values: &mut *values,
                    right: &mut *right,
                };
                let bases = C::bases(point, rule);
                point.assemble_forces(&bases, forces, &mut target);
                for set in 0..rule.sets() {
                    let stage = rule.stage_of(set);
                    let turn = C::turn(point, rule, set, &arms);
                    add_blocks::<K, S, D>(&mut forces.blocks[stage][set], &turn);
                }
                if let Some(slot) = in_state.slots().thermal {
                    point.assemble_temperatures(slot, &bases, trial, &mut target);
                }
            }
            let target = (&mut *values, &mut *right);
            forces.scatter((rule, view.step), &stages.site, target);
        }
        Ok(())
    }
}

/// Where a point writes what belongs to its temperatures.
struct Target<'a, K: Kinematics<S, D>, S: Real, const D: usize> {
    rule: &'static Tableau,
    step: S,
    site: &'a StageSite<K, S, D>,
    local: &'a mut LocalStages<S>,
    values: &'a mut [S],
    right: &'a mut [[S; 1]],
}

impl<S: Real, M: Material<S>, K: Kinematics<S, D>, C: Source<S, M, K, D>, const D: usize>
    StagePoint<S, M, K, C, D>
{
    /// The forces of all stages and their derivatives, with their directions held, and what heat from other elements
    /// does to them.
    fn assemble_forces(
        &self,
        bases: &C::Bases,
        forces: &mut StageForces<K, S, D>,
        target: &mut Target<'_, K, S, D>,
    ) {
        let rule = target.rule;
        let nowhere = Arms::<K, S, D>::filled([S::zero(); D]);
        // By the heat at each stage.
        let mut by_heat = [[nowhere; MOST_STAGES]; MOST_STAGES];
        for (stage, by_heat) in by_heat.iter_mut().enumerate().take(rule.stages()) {
            for force in 0..C::FORCES {
                let at = [stage, force];
                let value = C::force(self, rule, target.local, at) + target.local.row[0];
                let by_arms = C::by_arms(self, bases, rule, target.local);
                let along = C::direction(self, bases, at);
                forces.add((rule, stage), (value, along), &by_arms);
                if self.contacts.is_some() {
                    let heats = &target.local.row[1 + rule.sets() * C::FORCES..];
                    for (sum, &by) in by_heat.iter_mut().zip(heats) {
                        add_scaled::<K, S, D>(sum, by, along);
                    }
                }
            }
        }
        for (set, weights) in rule.positions.iter().enumerate() {
            let mut impulses = [nowhere; MOST_STAGES];
            for (&weight, by_heat) in weights.iter().zip(&by_heat) {
                for (sum, by) in impulses.iter_mut().zip(by_heat) {
                    add_scaled::<K, S, D>(sum, target.step * S::from_f64(weight), by);
                }
            }
            self.assemble_heat(set, &impulses, target);
        }
    }

    /// What heat from other elements does to the rows of the nodes in a set, given the impulses by the heat at each
    /// stage.
    fn assemble_heat(
        &self,
        set: usize,
        impulses: &[Arms<K, S, D>; MOST_STAGES],
        target: &mut Target<'_, K, S, D>,
    ) {
        let Some(contacts) = &self.contacts else {
            return;
        };
        let rule = target.rule;
        let site = &target.site.sets[set][set];
        for (column, contact) in contacts[set].iter().enumerate().take(rule.sets()) {
            let mut by_seen = Arms::<K, S, D>::filled([S::zero(); D]);
            for (stage, impulse) in impulses.iter().enumerate().take(rule.stages()) {
                let share = S::from_f64(rule.share(stage, column));
                add_scaled::<K, S, D>(&mut by_seen, share, impulse);
            }
            let times = |factor: S| {
                let mut arms = by_seen;
                scale::<K, S, D>(&mut arms, factor);
                arms
            };
            let own = times(-contact.conductance());
            site.add_column(&contact.column, &own, target.values);
            for partner in &contact.partners {
                let by_partner = times(partner.conductance);
                site.add_column(&partner.column, &by_partner, target.values);
            }
        }
    }

    /// The equations `Θ − θ = 0` of a point whose temperatures neighbours see.
    fn assemble_temperatures(
        &self,
        slot: usize,
        bases: &C::Bases,
        trial: &Trial<S, D>,
        target: &mut Target<'_, K, S, D>,
    ) {
        let Some(contacts) = &self.contacts else {
            return;
        };
        let rule = target.rule;
        for (set, contacts) in contacts.iter().enumerate().take(rule.sets()) {
            let theta = C::temperature(self, rule, target.local, set) + target.local.row[0];
            let by_arms = C::by_arms(self, bases, rule, target.local);
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
