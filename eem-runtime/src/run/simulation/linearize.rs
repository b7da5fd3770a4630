//! Residual and tangent of the system that Newton's method solves, at given unknowns.

use super::Simulation;
use super::attempt::view;
use super::stepper::{Newton, Stepper};
use crate::element::phase::Phase;
use crate::step::error::{StepError, StepFailure};

/// Residual and tangent of a step at a trial state.
///
/// Internal variables are eliminated: their own equations determine them at the trial state, and the tangent is the
/// total derivative.
#[derive(Clone, Debug, PartialEq)]
pub struct StepTangent {
    /// `R(u)`: momentum balances in N s, then `Θ − θ*` in K for elements that conduct heat to
    /// other elements.
    pub residual: Vec<f64>,
    /// `∂R/∂u`, row-major, square.
    pub tangent: Vec<f64>,
}

impl<const D: usize> Simulation<D> {
    /// Residual and tangent of the next step at given unknowns.
    ///
    /// ```text
    /// R = (2m/h)(q¹ − q⁰) − 2p⁰ + h F(u),      u = (q¹ − q⁰ of the masses, Θ of elements that conduct heat to others)
    /// ```
    ///
    /// in the order of creation; their number is [`unknowns`](Self::unknowns). For [`Scheme::Variational4`] the
    /// unknowns are those of the middle and then those of the end, `(q_m − q⁰, Θ_0, q¹ − q⁰, Θ_1)`, and
    ///
    /// ```text
    /// R_m = (2m/h)(q_m − q⁰) − p⁰ + (h/12)(2F_0 + F_m),   R_1 = (m/h)(q¹ − q⁰) − p⁰ + (h/6)(F_0 + 2F_m)
    /// ```
    ///
    /// The tangent is exact to rounding: it does not come from differences.
    ///
    /// [`Scheme::Variational4`]: crate::Scheme::Variational4
    ///
    /// # Errors
    ///
    /// [`StepError`] if an element has no admissible state there, or if the number of unknowns is wrong
    /// ([`StepFailure::Unknowns`]).
    pub fn linearize(&mut self, unknowns: &[f64]) -> Result<StepTangent, StepError> {
        // The elements are evaluated elsewhere than at the ends of their last step.
        self.has_stepped = false;
        self.effort.restart();
        let found = self.find_tangent(unknowns);
        found.map_err(|failure| self.failed(self.step, failure))
    }

    fn find_tangent(&mut self, unknowns: &[f64]) -> Result<StepTangent, StepFailure> {
        let (given, expected) = (unknowns.len(), self.unknowns());
        if given != expected {
            return Err(StepFailure::Unknowns { given, expected });
        }
        self.evaluate_loads(self.step)?;
        let Stepper::Newton(newton) = &mut self.stepper else {
            // An explicit scheme solves no system.
            let (residual, tangent) = (Vec::new(), Vec::new());
            return Ok(StepTangent { residual, tangent });
        };
        let Newton {
            groups,
            solver,
            loads,
            stages,
            ..
        } = &mut **newton;
        let view = view!(self, self.step, Phase::Whole, &self.state, [loads, stages]);
        let (residual, tangent) = solver.linearize(groups, &view, unknowns, &mut self.effort)?;
        Ok(StepTangent { residual, tangent })
    }
}
