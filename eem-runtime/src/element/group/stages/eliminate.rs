//! The internal variables of one point over one step: the elimination of their equations.

use super::local::LocalStages;
use super::member::{StagePoint, StatePoint};
use super::source::Source;
use crate::algebra::lu;
use crate::element::error::StateError;
use crate::element::group::view::StepView;
use crate::element::kinematics::Kinematics;
use crate::element::tableau::Tableau;
use eem_material::free_energy::Material;
use eem_material::number::scalar::Real;

impl<S: Real, M: Material<S>, K: Kinematics<S, D>, C: Source<S, M, K, D>, const D: usize>
    StagePoint<S, M, K, C, D>
{
    /// Eliminates the internal variables of a point whose stages have been evaluated.
    pub(super) fn condense(
        &mut self,
        in_state: &StatePoint<S, M, K, D>,
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
        C::write_equations(self, in_state, rule, local, view)?;
        if lu::factor(&mut local.matrix, &mut local.pivots).is_err() {
            // A finite local system is singular only where the model has no derivative.
            return Err(StateError::NotFinite {
                element: in_state.element,
                quantity: "inverse of the local tangent",
                value: f64::INFINITY,
            });
        }
        for column in self.solved.chunks_exact_mut(unknowns) {
            lu::solve::<S, 1>(&local.matrix, &local.pivots, column.as_chunks_mut().0);
        }
        Ok(())
    }
}
