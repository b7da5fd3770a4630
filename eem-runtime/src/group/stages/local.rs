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
use super::{END, MIDDLE, ThreeStageGroup};
use crate::error::StateError;
use crate::free_energy::{Array, FreeEnergy};
use crate::kinematics::Kinematics;
use crate::lu;
use crate::scalar::Real;
use crate::scheme::variational_4;

/// Working memory for the local systems of one group.
#[derive(Clone, Debug)]
pub(crate) struct LocalStages<S> {
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
    pub(crate) fn new<M: FreeEnergy<S>>() -> Self {
        let unknowns = StageMember::<S, M>::UNKNOWNS;
        let inputs = StageMember::<S, M>::INPUTS;
        let zeros = |length: usize| vec![S::zero(); length];
        Self {
            matrix: zeros(unknowns * unknowns),
            pivots: vec![0; unknowns],
            by_unknown: zeros(unknowns),
            row: zeros(1 + inputs),
            inputs: zeros(inputs),
        }
    }

    /// Adds `weight` times a quantity of a stage, of which the derivative by `x` is given, to equation
    /// `equation`.
    fn add<M: FreeEnergy<S>>(
        &mut self,
        stages: &mut StageMember<S, M>,
        equation: usize,
        stage: usize,
        by: &M::Variables,
        weight: S,
    ) {
        let unknowns = self.pivots.len();
        let free = stages.prescribed.is_none();
        spread::<S, M>(stage, by, free, |column, entry| match column {
            Column::Input(j) => stages.solved[(1 + j) * unknowns + equation] += weight * entry,
            Column::Unknown(u) => self.matrix[equation * unknowns + u] += weight * entry,
        });
    }

    /// The equations of the viscous stretches.
    fn creep<M: FreeEnergy<S>>(&mut self, h: S, stages: &mut StageMember<S, M>) {
        let schedule = [variational_4::TO_MIDDLE, variational_4::STEP];
        for (half, weights) in schedule.into_iter().enumerate() {
            for k in 0..M::DASHPOTS {
                let (equation, index) = (half * M::DASHPOTS + k, M::MEASURES + k);
                let [old, new] = [0, 1 + half].map(|stage| stages.x[stage].as_ref()[index]);
                let mut rest = new - old;
                self.matrix[equation * self.pivots.len() + equation] = S::one();
                for (stage, weight) in weights.map(S::from_f64).into_iter().enumerate() {
                    rest -= h * weight * stages.points[stage].rates.as_ref()[index];
                    let by = stages.points[stage].rates_by.as_ref()[index];
                    self.add(stages, equation, stage, &by, -h * weight);
                }
                stages.solved[equation] = rest;
            }
        }
    }

    /// The equations of the entropies, of an element whose temperature is free.
    fn warm<M: FreeEnergy<S>>(&mut self, h: S, stages: &mut StageMember<S, M>) {
        let (unknowns, last) = (self.pivots.len(), M::Variables::LEN - 1);
        let (start, end) = (unknowns - 2, unknowns - 1);
        let entropies = stages.points.each_ref().map(Point::entropy);
        let slopes = stages.points.each_ref().map(Point::entropy_by);
        let [rate, middle_rate] = [0, MIDDLE].map(|i| stages.points[i].rates.as_ref()[last]);
        let [rate_by, middle_rate_by] =
            [0, MIDDLE].map(|i| stages.points[i].rates_by.as_ref()[last]);
        let sixth = h * S::from_f64(variational_4::STEP[0]);

        let mut rest = -stages.entropy - sixth * rate;
        for stage in 0..=END {
            let weight = S::from_f64(variational_4::START[stage]);
            rest += weight * entropies[stage];
            self.add(stages, start, stage, &slopes[stage], weight);
        }
        self.add(stages, start, 0, &rate_by, -sixth);
        stages.solved[start] = rest;

        stages.solved[end] = entropies[END] - entropies[0] - h * middle_rate;
        self.add(stages, end, END, &slopes[END], S::one());
        self.add(stages, end, 0, &slopes[0], -S::one());
        self.add(stages, end, MIDDLE, &middle_rate_by, -h);

        let [theta, middle] = [0, MIDDLE].map(|stage| stages.temperature(stage));
        stages.solved[(1 + 2 * M::MEASURES) * unknowns + start] = -sixth / theta;
        stages.solved[(2 + 2 * M::MEASURES) * unknowns + end] = -h / middle;
        self.scale_heat(stages, [theta, middle]);
    }

    /// Makes it Newton's method on `θ_0 r_s0` and `θ_m r_s1`, which are far less curved than `r`
    /// where conduction is stiff, and zero where it is.
    fn scale_heat<M: FreeEnergy<S>>(&mut self, stages: &StageMember<S, M>, theta: [S; 2]) {
        let unknowns = self.pivots.len();
        let (start, end) = (unknowns - 2, unknowns - 1);
        self.matrix[start * unknowns + start] += stages.solved[start] / theta[0];
        let half = S::from_f64(0.5) * stages.solved[end] / theta[1];
        self.matrix[end * unknowns + start] += half;
        self.matrix[end * unknowns + end] += half;
    }

    /// A quantity of a stage, of which the derivative by `x` is given, with the local unknowns
    /// eliminated, into `row`.
    pub(super) fn eliminate<M: FreeEnergy<S>>(
        &mut self,
        stages: &StageMember<S, M>,
        stage: usize,
        by: &M::Variables,
    ) {
        self.by_unknown.fill(S::zero());
        self.row.fill(S::zero());
        let free = stages.prescribed.is_none();
        spread::<S, M>(stage, by, free, |column, entry| match column {
            Column::Input(j) => self.row[1 + j] += entry,
            Column::Unknown(u) => self.by_unknown[u] += entry,
        });
        if self.by_unknown.is_empty() {
            return;
        }
        let solved = stages.solved.chunks_exact(self.by_unknown.len());
        for (entry, solved) in self.row.iter_mut().zip(solved) {
            let pairs = self.by_unknown.iter().zip(solved);
            *entry -= pairs.fold(S::zero(), |sum, (&a, &b)| sum + a * b);
        }
    }
}

/// The derivative by inputs and unknowns of a quantity of a stage, from that by `x`.
fn spread<S: Real, M: FreeEnergy<S>>(
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

impl<S, M, K> ThreeStageGroup<S, M, K>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S>,
{
    /// Eliminates the internal variables of element `i`, whose stages have been evaluated.
    pub(super) fn condense(&mut self, h: S, i: usize) -> Result<(), StateError> {
        let (local, stages) = (&mut self.local, &mut self.members[i]);
        let unknowns = local.pivots.len();
        if unknowns == 0 {
            return Ok(());
        }
        local.matrix.fill(S::zero());
        stages.solved.fill(S::zero());
        local.creep(h, stages);
        if M::THERMAL && stages.prescribed.is_none() {
            local.warm(h, stages);
        } else if M::THERMAL {
            // δθ = 0
            for row in [unknowns - 2, unknowns - 1] {
                local.matrix[row * unknowns + row] = S::one();
            }
        }
        if lu::factor(&mut local.matrix, &mut local.pivots).is_err() {
            // A finite local system is singular only where the model has no derivative.
            return Err(StateError::NotFinite {
                element: self.elements.members[i].element,
                quantity: "inverse of the local tangent",
                value: f64::INFINITY,
            });
        }
        for column in stages.solved.chunks_exact_mut(unknowns) {
            lu::solve(&local.matrix, &local.pivots, column);
        }
        Ok(())
    }
}
