//! The internal variables of one element over one step: their equations, and their elimination.
//!
//! ```text
//! r_γi = γ_i − γ⁰ − h Σ_j a_ij γ̇_j                              for every dashpot and set
//! r_sk = Σ_i e_ki s_i − e_k s⁰ − h Σ_i w_ki Φ_i                    for every set
//! ```
//!
//! with the numbers of the [`Tableau`]. The unknowns `u = (γ…, Θ)` of all sets depend on the rest of the scene
//! through the inputs `y = (π…, Q…)`, measures and heat from other elements, so that
//! `δu = −(constant + Σ_j by_j δy_j)`.

use super::member::{StageMember, inputs, unknowns};
use crate::algebra::lu;
use crate::element::error::StateError;
use crate::element::handle::Element;
use crate::element::kinematics::Kinematics;
use crate::element::tableau::{EntropyBalance, Tableau};
use crate::material::free_energy::{Array, FreeEnergy};
use crate::number::scalar::Real;

/// Working memory for the local systems of one group.
#[derive(Clone, Debug)]
pub(super) struct LocalStages<S> {
    /// `∂r/∂u`, row-major.
    matrix: Vec<S>,
    pivots: Vec<usize>,
    /// The derivative of one quantity by the local unknowns.
    by_unknown: Vec<S>,
    /// One quantity as `constant + Σ_j by_j δy_j` relative to its present value, the constant first.
    pub(super) row: Vec<S>,
    /// Changes of the inputs.
    pub(super) inputs: Vec<S>,
}

/// On what a quantity of an element depends.
#[derive(Clone, Copy, Debug)]
enum Column {
    Input(usize),
    Unknown(usize),
}

impl<S: Real> LocalStages<S> {
    /// Memory for elements of a model.
    pub(super) fn new<M: FreeEnergy<S>>(rule: &Tableau) -> Self {
        let (unknowns, inputs) = (unknowns::<S, M>(rule), inputs::<S, M>(rule));
        let zeros = |length: usize| vec![S::zero(); length];
        Self {
            matrix: zeros(unknowns * unknowns),
            pivots: vec![0; unknowns],
            by_unknown: zeros(unknowns),
            row: zeros(1 + inputs),
            inputs: zeros(inputs),
        }
    }

    /// Number of local unknowns.
    pub(super) fn unknowns(&self) -> usize {
        self.pivots.len()
    }
}

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

impl<S, M, K, const D: usize> StageMember<S, M, K, D>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S, D>,
{
    /// Eliminates the internal variables of an element whose stages have been evaluated.
    pub(super) fn condense(
        &mut self,
        rule: &Tableau,
        local: &mut LocalStages<S>,
        h: S,
        element: Element,
    ) -> Result<(), StateError> {
        let unknowns = local.unknowns();
        if unknowns == 0 {
            return Ok(());
        }
        local.matrix.fill(S::zero());
        self.solved.fill(S::zero());
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
        if lu::factor(&mut local.matrix, &mut local.pivots).is_err() {
            // A finite local system is singular only where the model has no derivative.
            return Err(StateError::NotFinite {
                element,
                quantity: "inverse of the local tangent",
                value: f64::INFINITY,
            });
        }
        for column in self.solved.chunks_exact_mut(unknowns) {
            lu::solve::<S, 1>(&local.matrix, &local.pivots, column.as_chunks_mut().0);
        }
        Ok(())
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
                let mut rest = self.x[rule.stage_of(set)][index] - self.old_viscous[k];
                let diagonal = equation * (local.unknowns() + 1);
                local.matrix[diagonal] = S::one();
                for (stage, &weight) in weights.iter().enumerate() {
                    let weight = -h * S::from_f64(weight);
                    rest += weight * self.points[stage].rates[index];
                    let by = self.points[stage].rates_by[index];
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
                rest += weight * self.points[stage].entropy();
                let by = self.points[stage].entropy_by();
                self.add(rule, local, equation, (stage, &by), weight);
            }
        }
        for (stage, &weight) in balance.rates.iter().enumerate() {
            if weight != 0.0 {
                let weight = -h * S::from_f64(weight);
                rest += weight * self.points[stage].rates[last];
                let by = self.points[stage].rates_by[last];
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
        if local.by_unknown.is_empty() {
            return;
        }
        let solved = self.solved.chunks_exact(local.by_unknown.len());
        for (entry, solved) in local.row.iter_mut().zip(solved) {
            let pairs = local.by_unknown.iter().zip(solved);
            *entry -= pairs.fold(S::zero(), |sum, (&a, &b)| sum + a * b);
        }
    }
}
