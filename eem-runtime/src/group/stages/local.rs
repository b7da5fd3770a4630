//! The internal variables of one element over one step: their equations, and their elimination.
//!
//! ```text
//! r_γm = γ_m − γ⁰ − (h/24)(5γ̇_0 + 8γ̇_m − γ̇_1)          for every dashpot
//! r_γ1 = γ_1 − γ⁰ − (h/6)(γ̇_0 + 4γ̇_m + γ̇_1)             for every dashpot
//! r_s0 = ½s_0 + ⅔s_m − ⅙s_1 − s⁰ − (h/6)Φ_0
//! r_s1 = s_1 − s_0 − hΦ_m
//! ```
//!
//! The unknowns `u = (γ_m…, γ_1…, θ_0, θ_1)` depend on the rest of the scene through the inputs
//! `y = (π_m…, π_1…, Q_0, Q_m)`, measures and heat from other elements, so that
//! `δu = −(constant + Σ_j by_j δy_j)`.

use super::member::StageMember;
use super::point::Point;
use super::{END, MIDDLE};
use crate::error::StateError;
use crate::free_energy::{Array, FreeEnergy};
use crate::handle::Element;
use crate::kinematics::Kinematics;
use crate::lu;
use crate::scalar::Real;
use crate::scheme::variational_4;

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
    /// Memory for elements with so many local unknowns and inputs.
    pub(super) fn new(unknowns: usize, inputs: usize) -> Self {
        let zeros = |length: usize| vec![S::zero(); length];
        Self {
            matrix: zeros(unknowns * unknowns),
            pivots: vec![0; unknowns],
            by_unknown: zeros(unknowns),
            row: zeros(1 + inputs),
            inputs: zeros(inputs),
        }
    }
}

/// Sorts the derivative of a quantity of a stage by `x` into those by inputs and by unknowns.
fn sort<S: Real, M: FreeEnergy<S>>(
    stage: usize,
    by: &M::Variables,
    is_free: bool,
    mut add: impl FnMut(Column, S),
) {
    let (measures, rest) = by.as_ref().split_at(M::MEASURES);
    if stage > 0 {
        for (a, &entry) in measures.iter().enumerate() {
            add(Column::Input((stage - 1) * M::MEASURES + a), entry);
        }
        for (k, &entry) in rest[..M::DASHPOTS].iter().enumerate() {
            add(Column::Unknown((stage - 1) * M::DASHPOTS + k), entry);
        }
    }
    if M::THERMAL && is_free {
        let (entry, first) = (rest[M::DASHPOTS], 2 * M::DASHPOTS);
        let half = S::from_f64(0.5) * entry;
        let shares = match stage {
            0 => [entry, S::zero()],
            MIDDLE => [half, half],
            _ => [S::zero(), entry],
        };
        add(Column::Unknown(first), shares[0]);
        add(Column::Unknown(first + 1), shares[1]);
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
        local: &mut LocalStages<S>,
        h: S,
        element: Element,
    ) -> Result<(), StateError> {
        let unknowns = local.pivots.len();
        if unknowns == 0 {
            return Ok(());
        }
        local.matrix.fill(S::zero());
        self.solved.fill(S::zero());
        self.creep(local, h);
        if M::THERMAL && self.prescribed.is_none() {
            self.warm(local, h);
        } else if M::THERMAL {
            // δθ = 0
            for row in [unknowns - 2, unknowns - 1] {
                local.matrix[row * unknowns + row] = S::one();
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

    /// Adds `weight` times a quantity of a stage, of which the derivative by `x` is given, to equation
    /// `equation`.
    fn add(
        &mut self,
        local: &mut LocalStages<S>,
        equation: usize,
        stage: usize,
        by: &M::Variables,
        weight: S,
    ) {
        let unknowns = local.pivots.len();
        let free = self.prescribed.is_none();
        sort::<S, M>(stage, by, free, |column, entry| match column {
            Column::Input(j) => self.solved[(1 + j) * unknowns + equation] += weight * entry,
            Column::Unknown(u) => local.matrix[equation * unknowns + u] += weight * entry,
        });
    }

    /// The equations of the viscous stretches.
    fn creep(&mut self, local: &mut LocalStages<S>, h: S) {
        let schedule = [variational_4::TO_MIDDLE, variational_4::STEP];
        for (half, weights) in schedule.into_iter().enumerate() {
            for k in 0..M::DASHPOTS {
                let (equation, index) = (half * M::DASHPOTS + k, M::MEASURES + k);
                let [old, new] = [0, 1 + half].map(|stage| self.x[stage][index]);
                let mut rest = new - old;
                local.matrix[equation * local.pivots.len() + equation] = S::one();
                for (stage, weight) in weights.map(S::from_f64).into_iter().enumerate() {
                    rest -= h * weight * self.points[stage].rates[index];
                    let by = self.points[stage].rates_by[index];
                    self.add(local, equation, stage, &by, -h * weight);
                }
                self.solved[equation] = rest;
            }
        }
    }

    /// The equations of the entropies, of an element whose temperature is free.
    fn warm(&mut self, local: &mut LocalStages<S>, h: S) {
        let (unknowns, last) = (local.pivots.len(), M::Variables::LEN - 1);
        let (start, end) = (unknowns - 2, unknowns - 1);
        let entropies = self.points.each_ref().map(Point::entropy);
        let slopes = self.points.each_ref().map(Point::entropy_by);
        let [rate, middle_rate] = [0, MIDDLE].map(|i| self.points[i].rates[last]);
        let [rate_by, middle_rate_by] = [0, MIDDLE].map(|i| self.points[i].rates_by[last]);
        let sixth = h * S::from_f64(variational_4::STEP[0]);

        let mut rest = -self.entropy - sixth * rate;
        for stage in 0..=END {
            let weight = S::from_f64(variational_4::START[stage]);
            rest += weight * entropies[stage];
            self.add(local, start, stage, &slopes[stage], weight);
        }
        self.add(local, start, 0, &rate_by, -sixth);
        self.solved[start] = rest;

        self.solved[end] = entropies[END] - entropies[0] - h * middle_rate;
        self.add(local, end, END, &slopes[END], S::one());
        self.add(local, end, 0, &slopes[0], -S::one());
        self.add(local, end, MIDDLE, &middle_rate_by, -h);

        let [theta, middle] = [0, MIDDLE].map(|stage| self.temperature(stage));
        self.solved[(1 + 2 * M::MEASURES) * unknowns + start] = -sixth / theta;
        self.solved[(2 + 2 * M::MEASURES) * unknowns + end] = -h / middle;
        self.scale_heat(local, [theta, middle]);
    }

    /// Makes it Newton's method on `θ_0 r_s0` and `θ_m r_s1`, which are far less curved than `r`
    /// where conduction is stiff, and zero where it is.
    fn scale_heat(&self, local: &mut LocalStages<S>, theta: [S; 2]) {
        let unknowns = local.pivots.len();
        let (start, end) = (unknowns - 2, unknowns - 1);
        local.matrix[start * unknowns + start] += self.solved[start] / theta[0];
        let half = S::from_f64(0.5) * self.solved[end] / theta[1];
        local.matrix[end * unknowns + start] += half;
        local.matrix[end * unknowns + end] += half;
    }

    /// A quantity of a stage, of which the derivative by `x` is given, with the local unknowns
    /// eliminated, into `row`.
    pub(super) fn eliminate(&self, local: &mut LocalStages<S>, stage: usize, by: &M::Variables) {
        local.by_unknown.fill(S::zero());
        local.row.fill(S::zero());
        let free = self.prescribed.is_none();
        sort::<S, M>(stage, by, free, |column, entry| match column {
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
