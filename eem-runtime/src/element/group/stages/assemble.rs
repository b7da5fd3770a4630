//! From the stages of the elements to the global system.

use super::geometry::Geometry;
use super::models::StageModels;
use super::point::{LocalStages, StagedPoint};
use super::site::{PerPair, StageContact, StageSite};
use crate::element::group::arms::add_scaled;
use crate::element::group::view::Trial;
use crate::element::kinematics::{Arms, Blocks, Kinematics};
use crate::element::tableau::{MOST_SETS, MOST_STAGES, Tableau};
use eem_material::free_energy::Array;

/// The forces of an element at the stages, as functions of the arms of each set.
pub(super) struct StageForces<K: Kinematics<D>, const D: usize> {
    /// With the internal variables eliminated, N.
    pulls: [Arms<K, D>; MOST_STAGES],
    /// Their derivatives with respect to the arms of each set.
    pub(super) blocks: PerPair<Blocks<K, D>>,
}

impl<K: Kinematics<D>, const D: usize> StageForces<K, D> {
    pub(super) fn zero() -> Self {
        let blocks = Blocks::<K, D>::filled(K::PerArm::filled([[0.0; D]; D]));
        Self {
            pulls: [Arms::<K, D>::filled([0.0; D]); MOST_STAGES],
            blocks: [[blocks; MOST_SETS]; MOST_SETS],
        }
    }

    pub(super) fn clear(&mut self, rule: &Tableau) {
        self.pulls = [Arms::<K, D>::filled([0.0; D]); MOST_STAGES];
        for row in &mut self.blocks[..rule.stages()] {
            row[..rule.sets()].fill(Blocks::<K, D>::filled(K::PerArm::filled([[0.0; D]; D])));
        }
    }

    /// Adds a force with this value and direction, given the derivatives of the value with respect to the arms of each set.
    fn add(&mut self, stage: usize, (value, along): (f64, &Arms<K, D>), by: &[Arms<K, D>]) {
        add_scaled::<K, D>(&mut self.pulls[stage], value, along);
        for (blocks, by) in self.blocks[stage].iter_mut().zip(by) {
            for (row, along) in blocks.as_mut().iter_mut().zip(along.as_ref()) {
                for (block, by) in row.as_mut().iter_mut().zip(by.as_ref()) {
                    for (entries, &along) in block.iter_mut().zip(along) {
                        for (entry, &by) in entries.iter_mut().zip(by) {
                            *entry += along * by;
                        }
                    }
                }
            }
        }
    }
}

/// The workspace of the assembly of an element, and the global system.
pub(super) struct Target<'a, K: Kinematics<D>, const D: usize> {
    pub(super) rule: &'static Tableau,
    pub(super) step: f64,
    pub(super) site: &'a StageSite<K, D>,
    pub(super) local: &'a mut LocalStages,
    pub(super) forces: &'a mut StageForces<K, D>,
    pub(super) values: &'a mut [f64],
    pub(super) right: &'a mut [[f64; 1]],
}

impl<K: Kinematics<D>, const D: usize> Target<'_, K, D> {
    /// Adds the forces of a point at all stages with their derivatives for constant directions, and the effect of heat
    /// from other elements on them.
    pub(super) fn add_forces<G: Geometry<K, D>>(
        &mut self,
        models: &G::Models,
        point: &StagedPoint<K, G, D>,
        bases: &G::Bases,
    ) {
        let (rule, geometry) = (self.rule, &point.geometry);
        let nowhere = Arms::<K, D>::filled([0.0; D]);
        // The derivatives of the forces at each stage with respect to the heat at each stage.
        let mut by_heat = [[nowhere; MOST_STAGES]; MOST_STAGES];
        for (stage, by_heat) in by_heat.iter_mut().enumerate().take(rule.stages()) {
            for force in 0..G::FORCES {
                let at = [stage, force];
                let value = models.force(point.place, self.local, at) + self.local.row[0];
                let by_arms = geometry.by_arms(bases, self.local);
                let along = geometry.direction(bases, at);
                self.forces
                    .add(stage, (value, along), &by_arms[..rule.sets()]);
                if point.contacts.is_some() {
                    let heats = &self.local.row[1 + rule.sets() * G::FORCES..];
                    for (sum, &by) in by_heat.iter_mut().zip(heats) {
                        add_scaled::<K, D>(sum, by, along);
                    }
                }
            }
        }
        let Some(contacts) = &point.contacts else {
            return;
        };
        for (set, weights) in rule.positions.iter().enumerate() {
            let mut impulses = [nowhere; MOST_STAGES];
            for (&weight, by_heat) in weights.iter().zip(&by_heat) {
                for (sum, by) in impulses.iter_mut().zip(by_heat) {
                    add_scaled::<K, D>(sum, self.step * weight, by);
                }
            }
            self.add_heat(set, &contacts[set], &impulses);
        }
    }

    /// Adds the effect of heat from other elements to the rows of the nodes in a set, given the derivatives of the impulses
    /// by the heat at each stage.
    fn add_heat(
        &mut self,
        set: usize,
        contacts: &[StageContact<K, D>],
        impulses: &[Arms<K, D>; MOST_STAGES],
    ) {
        let (rule, site) = (self.rule, &self.site.sets[set][set]);
        for (column, (heat, own)) in contacts.iter().enumerate().take(rule.sets()) {
            let mut by_interface = Arms::<K, D>::filled([0.0; D]);
            for (stage, impulse) in impulses.iter().enumerate().take(rule.stages()) {
                let share = rule.share(stage, column);
                add_scaled::<K, D>(&mut by_interface, share, impulse);
            }
            own.add_pull(heat, site, &by_interface, self.values);
        }
    }

    /// Adds the equations `Θ − θ = 0` of the coupled interface temperatures of a point.
    pub(super) fn add_temperatures<G: Geometry<K, D>>(
        &mut self,
        models: &G::Models,
        point: &StagedPoint<K, G, D>,
        bases: &G::Bases,
        (slot, trial): (usize, &Trial<D>),
    ) {
        let rule = self.rule;
        let contacts = point.contacts.iter().flatten();
        for (set, contacts) in contacts.enumerate().take(rule.sets()) {
            let theta = models.temperature(point.place, self.local, set) + self.local.row[0];
            let by_arms = point.geometry.by_arms(bases, self.local);
            let by_heat = &self.local.row[1 + rule.sets() * G::FORCES..];
            let (own, _) = &contacts[set];
            let interface = trial.interface.values()[trial.interface.of_set(rule, set, slot)];
            self.right[own.unknown as usize][0] += theta - interface;
            self.values[own.diagonal as usize] += 1.0;
            for (column, (contact, nodes)) in contacts.iter().enumerate().take(rule.sets()) {
                let site = &self.site.sets[set][column];
                site.subtract_arms(&by_arms[column], &nodes.row, self.values);
                // ∂θ/∂Θ of the set of the column
                let by = by_heat.iter().enumerate();
                let by = by.fold(0.0, |sum, (stage, &by)| {
                    sum + rule.share(stage, column) * by
                });
                self.values[contact.diagonal as usize] += by * contact.conductance();
                for path in &contact.paths {
                    self.values[path.entry as usize] -= by * path.conductance;
                }
            }
        }
    }

    /// Adds the impulses of the forces and their derivatives to the rows of each set.
    pub(super) fn add_impulses(self) {
        for (set, weights) in self.rule.positions.iter().enumerate() {
            let own = &self.site.sets[set][set];
            let mut pull = Arms::<K, D>::filled([0.0; D]);
            for (&weight, stage) in weights.iter().zip(&self.forces.pulls) {
                add_scaled::<K, D>(&mut pull, self.step * weight, stage);
            }
            own.subtract_arms(&pull, &own.rows, self.right.as_flattened_mut());
            let sites = self.site.sets[set].iter().take(self.rule.sets());
            for (column, site) in sites.enumerate() {
                for i in 0..K::PerArm::<()>::LEN {
                    for j in 0..K::PerArm::<()>::LEN {
                        let mut block = [[0.0; D]; D];
                        for (&weight, stage) in weights.iter().zip(&self.forces.blocks) {
                            let impulse = self.step * weight;
                            let entries = stage[column][i][j].as_flattened();
                            for (sum, &entry) in block.as_flattened_mut().iter_mut().zip(entries) {
                                *sum += impulse * entry;
                            }
                        }
                        site.add_block([i + 1, j + 1], &block, self.values);
                    }
                }
            }
        }
    }
}
