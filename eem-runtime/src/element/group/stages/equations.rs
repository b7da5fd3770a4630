//! The internal variables of a point at the stages: their equations, and the conjugates as functions of them.

use super::point::{LocalStages, Outside, StagePoint};
use crate::element::error::StateError;
use crate::element::group::point::Point;
use crate::element::group::view::StepView;
use crate::element::kinematics::{MeasureSet, Numbers};
use crate::element::state::State;
use crate::element::tableau::Tableau;
use crate::element::tally::Tally;
use eem_material::arrays::Arrays;

/// A point at the stages without its nodes: the same in any number of dimensions.
pub(crate) trait StageEquations<A: Arrays, Q: MeasureSet>:
    Sized + Send + Sync + 'static
{
    /// Number of forces of a stage.
    const FORCES: usize;

    /// Number of local unknowns: the viscous stretches, set after set, then a temperature or entropy per set.
    fn unknowns_of(rule: &Tableau, (dashpots, is_thermal): (usize, bool)) -> usize {
        rule.sets() * (dashpots + usize::from(is_thermal))
    }

    /// Number of inputs: one per force, set after set, and the heat Q from other elements, stage after stage.
    fn inputs_of(rule: &Tableau, is_thermal: bool) -> usize {
        rule.sets() * Self::FORCES + rule.stages() * usize::from(is_thermal)
    }

    fn point_mut(&mut self) -> &mut StagePoint;

    /// Starts the trial at the old variables `(π, γ, θ)⁰`, and the old strain of a path.
    fn begin(&mut self, in_state: &Point<A, Q>, x0: &A::Variables, strain: &[f64]);

    /// Writes the local equations at an evaluated trial: residuals and their derivatives with respect to
    /// local unknowns and inputs.
    fn write_equations(
        &mut self,
        in_state: &Point<A, Q>,
        local: &mut LocalStages,
        view: &StepView<'_>,
    ) -> Result<(), StateError>;

    /// Eliminates the internal variables at an evaluated trial.
    fn condense(
        &mut self,
        in_state: &Point<A, Q>,
        local: &mut LocalStages,
        view: &StepView<'_>,
    ) -> Result<(), StateError> {
        if local.unknowns() == 0 {
            return Ok(());
        }
        local.matrix.fill(0.0);
        self.point_mut().solved.fill(0.0);
        self.write_equations(in_state, local, view)?;
        // A finite local system is singular only where the model has no derivative.
        let solved = self.point_mut().solve(local);
        solved.map_err(|_| StateError::NotFinite {
            element: in_state.element,
            quantity: "inverse of the local tangent",
            value: f64::INFINITY,
        })
    }

    /// One of the forces of a stage; its derivatives, with the local unknowns eliminated, are written to the row of the
    /// workspace.
    fn force(&self, local: &mut LocalStages, stage_and_force: [usize; 2]) -> f64;

    /// The temperature of a set, K; its derivatives are written like those of a [force](Self::force).
    fn temperature(&self, local: &mut LocalStages, set: usize) -> f64;

    /// Starts the next correction, of zero, from the present trial.
    fn hold(&mut self);

    /// Takes the correction from the solved local system; returns the largest in its unit.
    fn correct(&mut self, local: &LocalStages) -> f64;

    /// Applies a fraction of the correction.
    fn apply(&mut self, fraction: f64);

    /// Books the increments of the internal variables and of the reservoirs, and finds the temperature of the new state,
    /// whose measures are given.
    fn close(
        &mut self,
        in_state: &mut Point<A, Q>,
        measures: &Numbers<Q>,
        view_and_outside: (&StepView<'_>, Outside<'_>),
        next_and_tally: (&mut State, &mut Tally),
    ) -> Result<(), StateError>;

    /// The change of energy in the step, J; `None` if the scheme is not certified.
    fn change_of_energy(&self) -> Option<f64> {
        None
    }
}
