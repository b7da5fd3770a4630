//! The working memory in which the internal variables of one element are eliminated.
//!
//! The local unknowns u of all sets depend on the rest of the scene through the inputs y, measures (or increments of
//! the strain) and heat from other elements, so that `δu = −(constant + Σ_j by_j δy_j)`.

use super::member::{StagePoint, unknowns};
use crate::element::kinematics::Kinematics;
use crate::element::tableau::Tableau;
use eem_material::free_energy::{FreeEnergy, Material};
use eem_material::number::scalar::Real;

/// Working memory for the local systems of one group.
#[derive(Clone, Debug)]
pub(crate) struct LocalStages<S> {
    /// `∂r/∂u`, row-major.
    pub(super) matrix: Vec<S>,
    pub(super) pivots: Vec<usize>,
    /// The derivative of one quantity by the local unknowns.
    pub(super) by_unknown: Vec<S>,
    /// One quantity as `constant + Σ_j by_j δy_j` relative to its present value, the constant first.
    pub(super) row: Vec<S>,
    /// Changes of the inputs.
    pub(super) inputs: Vec<S>,
}

/// On what a quantity of an element depends.
#[derive(Clone, Copy, Debug)]
pub(super) enum Column {
    Input(usize),
    Unknown(usize),
}

impl<S: Real> LocalStages<S> {
    /// Memory for elements of a model, given the number of inputs.
    pub(super) fn new<M: FreeEnergy<S>>(rule: &Tableau, inputs: usize) -> Self {
        let unknowns = unknowns::<S, M>(rule);
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

    /// The change of a local unknown that the solved local system says, for the changes of the inputs.
    pub(super) fn change(&self, solved: &[S], unknown: usize) -> S {
        let unknowns = self.unknowns();
        let mut change = -solved[unknown];
        for (j, &input) in self.inputs.iter().enumerate() {
            change -= solved[(1 + j) * unknowns + unknown] * input;
        }
        change
    }
}

impl<S: Real, M: Material<S>, K: Kinematics<S, D>, C, const D: usize> StagePoint<S, M, K, C, D> {
    /// Eliminates the local unknowns from a quantity whose derivatives by them and by the inputs are given.
    pub(super) fn substitute(&self, local: &mut LocalStages<S>) {
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
