//! What the points of an element add to the system of the stages, before it is written there.

use super::site::{PerPair, StageSite};
use crate::element::group::arms::add_scaled;
use crate::element::kinematics::{Arms, Blocks, Kinematics};
use crate::element::tableau::{MOST_SETS, MOST_STAGES, Tableau};
use eem_material::free_energy::Array;
use eem_material::number::scalar::Real;

/// The forces of an element at the stages, as functions of the arms of each set.
pub(super) struct StageForces<K: Kinematics<S, D>, S: Real, const D: usize> {
    /// Those at a stage, with the internal variables eliminated, N.
    pub(super) pulls: [Arms<K, S, D>; MOST_STAGES],
    /// Their derivatives by the arms of each set.
    pub(super) blocks: PerPair<Blocks<K, S, D>>,
}

impl<K: Kinematics<S, D>, S: Real, const D: usize> StageForces<K, S, D> {
    /// None.
    pub(super) fn zero() -> Self {
        let nowhere = Arms::<K, S, D>::filled([S::zero(); D]);
        let blocks = Blocks::<K, S, D>::filled(K::PerArm::filled([[S::zero(); D]; D]));
        Self {
            pulls: [nowhere; MOST_STAGES],
            blocks: [[blocks; MOST_SETS]; MOST_SETS],
        }
    }

    /// Forgets those of the last element.
    pub(super) fn clear(&mut self, rule: &Tableau) {
        let nowhere = Arms::<K, S, D>::filled([S::zero(); D]);
        self.pulls = [nowhere; MOST_STAGES];
        for row in &mut self.blocks[..rule.stages()] {
            for blocks in &mut row[..rule.sets()] {
                *blocks = Blocks::<K, S, D>::filled(K::PerArm::filled([[S::zero(); D]; D]));
            }
        }
    }

    /// Adds a force along an arm, of which the derivatives by the arms of each set are given.
    pub(super) fn add(
        &mut self,
        (rule, stage): (&Tableau, usize),
        (value, along): (S, &Arms<K, S, D>),
        by_arms: &[Arms<K, S, D>; MOST_SETS],
    ) {
        add_scaled::<K, S, D>(&mut self.pulls[stage], value, along);
        for (blocks, by) in self.blocks[stage].iter_mut().zip(by_arms).take(rule.sets()) {
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

    /// Writes the impulses to the rows of each set.
    pub(super) fn scatter(
        &self,
        (rule, step): (&Tableau, S),
        site: &StageSite<K, S, D>,
        (values, right): (&mut [S], &mut [[S; 1]]),
    ) {
        for (set, weights) in rule.positions.iter().enumerate() {
            let own = &site.sets[set][set];
            let mut pull = Arms::<K, S, D>::filled([S::zero(); D]);
            for (&weight, stage) in weights.iter().zip(&self.pulls) {
                add_scaled::<K, S, D>(&mut pull, step * S::from_f64(weight), stage);
            }
            own.subtract_arms(&pull, &own.rows, right.as_flattened_mut());
            for (column, site) in site.sets[set].iter().enumerate().take(rule.sets()) {
                for i in 0..K::PerArm::<()>::LEN {
                    for j in 0..K::PerArm::<()>::LEN {
                        let mut block = [[S::zero(); D]; D];
                        for (&weight, stage) in weights.iter().zip(&self.blocks) {
                            let impulse = step * S::from_f64(weight);
                            let entries = stage[column][i][j].as_flattened();
                            for (sum, &entry) in block.as_flattened_mut().iter_mut().zip(entries) {
                                *sum += impulse * entry;
                            }
                        }
                        site.add_block([i + 1, j + 1], &block, values);
                    }
                }
            }
        }
    }
}
