//! The elimination of the internal variables of one point.
//!
//! The local unknowns u, `γ…` and then `Θ` set after set, depend on the rest of the scene through the inputs y: measures
//! (or increments of the strain), and heat from other elements. Solved, their equations are
//! `δu = −(c + Σ_j by_j δy_j)`, stored as the constant c followed by the columns `by_j`.

use super::member::StagePoint;
use crate::algebra::lu::{self, Singular};
use crate::element::kinematics::Kinematics;
use eem_material::number::scalar::Real;

/// Workspace for the local systems of one group.
#[derive(Clone, Debug)]
pub(crate) struct LocalStages<S> {
    /// `∂r/∂u`, row-major.
    pub(super) matrix: Vec<S>,
    pivots: Vec<usize>,
    /// The derivatives of one quantity by the local unknowns, and, behind a zero, by the inputs; once the local unknowns
    /// are eliminated, its change without changes of the inputs in the place of the zero.
    pub(super) by_unknown: Vec<S>,
    pub(super) row: Vec<S>,
    /// Changes of the inputs.
    pub(super) inputs: Vec<S>,
}

impl<S: Real> LocalStages<S> {
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

    /// Number of local unknowns.
    pub(super) fn unknowns(&self) -> usize {
        self.pivots.len()
    }

    /// Starts another quantity.
    pub(super) fn clear_row(&mut self) {
        self.by_unknown.fill(S::zero());
        self.row.fill(S::zero());
    }

    /// The change of a local unknown by the solved local system, for the changes of the inputs.
    pub(super) fn change(&self, solved: &[S], unknown: usize) -> S {
        let columns = solved[self.unknowns()..].chunks_exact(self.unknowns());
        let terms = columns.zip(&self.inputs);
        terms.fold(-solved[unknown], |change, (column, &input)| {
            change - column[unknown] * input
        })
    }
}

impl<K: Kinematics<S, D>, S: Real, const D: usize> StagePoint<K, S, D> {
    /// Adds a multiple of the quantity in the row to an equation.
    pub(super) fn add_row(&mut self, local: &mut LocalStages<S>, equation: usize, factor: S) {
        let unknowns = local.unknowns();
        let columns = self.solved.chunks_exact_mut(unknowns).zip(&local.row);
        for (column, &entry) in columns.skip(1) {
            column[equation] += factor * entry;
        }
        let row = local.matrix[equation * unknowns..].iter_mut();
        for (sum, &entry) in row.zip(&local.by_unknown) {
            *sum += factor * entry;
        }
    }

    /// Solves the local equations.
    pub(super) fn solve(&mut self, local: &mut LocalStages<S>) -> Result<(), Singular> {
        lu::factor(&mut local.matrix, &mut local.pivots)?;
        for column in self.solved.chunks_exact_mut(local.unknowns()) {
            lu::solve::<S, 1>(&local.matrix, &local.pivots, column.as_chunks_mut().0);
        }
        Ok(())
    }

    /// Eliminates the local unknowns from the quantity in the row.
    pub(super) fn eliminate(&self, local: &mut LocalStages<S>) {
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
