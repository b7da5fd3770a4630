//! The local equations of an element with values at the stages.
//!
//! ```text
//! r_γi = γ_i − γ⁰ − h Σ_j a_ij γ̇_j                              for every dashpot and set
//! r_sk = Σ_i e_ki s_i − e_k s⁰ − h Σ_i w_ki Φ_i                    for every set
//! ```
//!
//! with the numbers of the [`Tableau`]. The unknowns are `u = (γ…, Θ)` of all sets, the inputs `y = (π…, Q…)`.

use super::ValuesPoint;
use crate::element::group::stages::local::{Column, LocalStages};
use crate::element::kinematics::Kinematics;
use crate::element::tableau::{EntropyBalance, Tableau};
use eem_material::free_energy::{Array, FreeEnergy, Material};
use eem_material::number::scalar::Real;

/// Sorts the derivative of a quantity of a stage by `x` into those by inputs and by unknowns.
fn sort<S: Real, M: FreeEnergy<S>>(
    rule: &Tableau,
    stage: usize,
    by: &M::Variables,
    is_free: bool,
    mut add: impl FnMut(Column, S),
) {
    let (measures, rest) = by.as_ref().split_at(M::MEASURES);
    if let Some(set) = rule.set_of(stage) {
        for (a, &entry) in measures.iter().enumerate() {
            add(Column::Input(set * M::MEASURES + a), entry);
        }
        for (k, &entry) in rest[..M::DASHPOTS].iter().enumerate() {
            add(Column::Unknown(set * M::DASHPOTS + k), entry);
        }
    }
    if M::THERMAL && is_free {
        let (entry, first) = (rest[M::DASHPOTS], rule.sets() * M::DASHPOTS);
        for (set, &share) in rule.temperatures[stage].iter().enumerate() {
            add(Column::Unknown(first + set), S::from_f64(share) * entry);
        }
    }
}

impl<S: Real, M: Material<S>, K: Kinematics<S, D>, const D: usize> ValuesPoint<S, M, K, D> {
    /// Writes the equations of stages that have been evaluated.
    pub(super) fn write_stages(&mut self, rule: &Tableau, local: &mut LocalStages<S>, h: S) {
        let unknowns = local.unknowns();
        self.creep(rule, local, h);
        let first = rule.sets() * M::DASHPOTS;
        for (set, balance) in rule.entropies.iter().enumerate() {
            if M::THERMAL && self.prescribed.is_none() {
                self.warm(rule, first + set, balance, local, h);
            } else if M::THERMAL {
                // δθ = 0
                local.matrix[(first + set) * (unknowns + 1)] = S::one();
            }
        }
    }

    /// Adds `weight` times a quantity of a stage, of which the derivative by `x` is given, to an equation.
    fn add(
        &mut self,
        rule: &Tableau,
        local: &mut LocalStages<S>,
        equation: usize,
        (stage, by): (usize, &M::Variables),
        weight: S,
    ) {
        let unknowns = local.unknowns();
        let free = self.prescribed.is_none();
        sort::<S, M>(rule, stage, by, free, |column, entry| match column {
            Column::Input(j) => self.solved[(1 + j) * unknowns + equation] += weight * entry,
            Column::Unknown(u) => local.matrix[equation * unknowns + u] += weight * entry,
        });
    }

    /// The equations of the viscous stretches.
    fn creep(&mut self, rule: &Tableau, local: &mut LocalStages<S>, h: S) {
        for (set, weights) in rule.rates.iter().enumerate() {
            for k in 0..M::DASHPOTS {
                let (equation, index) = (set * M::DASHPOTS + k, M::MEASURES + k);
                let mut rest = self.own.x[rule.stage_of(set)][index] - self.old_viscous[k];
                let diagonal = equation * (local.unknowns() + 1);
                local.matrix[diagonal] = S::one();
                for (stage, &weight) in weights.iter().enumerate() {
                    let weight = -h * S::from_f64(weight);
                    rest += weight * self.own.points[stage].rates[index];
                    let by = self.own.points[stage].rates_by[index];
                    self.add(rule, local, equation, (stage, &by), weight);
                }
                self.solved[equation] = rest;
            }
        }
    }

    /// An equation of the entropies, of an element whose temperature is free.
    fn warm(
        &mut self,
        rule: &Tableau,
        equation: usize,
        balance: &EntropyBalance,
        local: &mut LocalStages<S>,
        h: S,
    ) {
        let (unknowns, last) = (local.unknowns(), M::Variables::LEN - 1);
        let mut rest = -S::from_f64(balance.old) * self.entropy;
        for (stage, &weight) in balance.entropies.iter().enumerate() {
            if weight != 0.0 {
                let weight = S::from_f64(weight);
                rest += weight * self.own.points[stage].entropy();
                let by = self.own.points[stage].entropy_by();
                self.add(rule, local, equation, (stage, &by), weight);
            }
        }
        for (stage, &weight) in balance.rates.iter().enumerate() {
            if weight != 0.0 {
                let weight = -h * S::from_f64(weight);
                rest += weight * self.own.points[stage].rates[last];
                let by = self.own.points[stage].rates_by[last];
                self.add(rule, local, equation, (stage, &by), weight);
                let heat = 1 + rule.sets() * M::MEASURES + stage;
                self.solved[heat * unknowns + equation] = weight / self.temperature(stage);
            }
        }
        self.solved[equation] = rest;
        // Newton's method on θ r, which is far less curved than r where conduction is stiff, and zero
        // where it is.
        let scaled = rest / self.temperature(balance.stage);
        let first = rule.sets() * M::DASHPOTS;
        for (set, &share) in rule.temperatures[balance.stage].iter().enumerate() {
            local.matrix[equation * unknowns + first + set] += S::from_f64(share) * scaled;
        }
    }

    /// A quantity of a stage, of which the derivative by `x` is given, with the local unknowns
    /// eliminated, into `row`.
    pub(super) fn eliminate(
        &self,
        rule: &Tableau,
        local: &mut LocalStages<S>,
        stage: usize,
        by: &M::Variables,
    ) {
        local.by_unknown.fill(S::zero());
        local.row.fill(S::zero());
        let free = self.prescribed.is_none();
        sort::<S, M>(rule, stage, by, free, |column, entry| match column {
            Column::Input(j) => local.row[1 + j] += entry,
            Column::Unknown(u) => local.by_unknown[u] += entry,
        });
        self.substitute(local);
    }
}
