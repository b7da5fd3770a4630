//! The internal variables of one element over one step: the elimination of their equations.
//!
//! The local unknowns u of all sets depend on the rest of the scene through the inputs y, measures (or their
//! rates) and heat from other elements, so that `δu = −(constant + Σ_j by_j δy_j)`.

use super::member::{StageMember, StatePoint, inputs, unknowns};
use super::source::Source;
use crate::algebra::lu;
use crate::element::error::StateError;
use crate::element::group::view::StepView;
use crate::element::kinematics::Kinematics;
use crate::element::tableau::Tableau;
use crate::material::free_energy::FreeEnergy;
use crate::number::scalar::Real;

/// Working memory for the local systems of one group.
#[derive(Clone, Debug)]
pub(crate) struct LocalStages<S> {
    /// `∂r/∂u`, row-major.
    pub(super) matrix: Vec<S>,
    pivots: Vec<usize>,
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

impl<S, M, K, C, const D: usize> StageMember<S, M, K, C, D>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S, D>,
    C: Source<S, M, K, D>,
{
    /// Eliminates the internal variables of an element whose stages have been evaluated.
    pub(super) fn condense(
        &mut self,
        own: &StatePoint<S, M, K, D>,
        rule: &Tableau,
        local: &mut LocalStages<S>,
        view: &StepView<'_, S>,
    ) -> Result<(), StateError> {
        let unknowns = local.unknowns();
        if unknowns == 0 {
            return Ok(());
        }
        local.matrix.fill(S::zero());
        self.solved.fill(S::zero());
        C::write_equations(self, own, rule, local, view);
        if lu::factor(&mut local.matrix, &mut local.pivots).is_err() {
            // A finite local system is singular only where the model has no derivative.
            return Err(StateError::NotFinite {
                element: own.element,
                quantity: "inverse of the local tangent",
                value: f64::INFINITY,
            });
        }
        for column in self.solved.chunks_exact_mut(unknowns) {
            lu::solve::<S, 1>(&local.matrix, &local.pivots, column.as_chunks_mut().0);
        }
        Ok(())
    }

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
