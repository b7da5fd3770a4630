//! One step of a given size by the scheme in use, and the system that it solves.

use core::mem;

use super::start::SHORTEST;
use super::stepper::Stepper;
use super::{Run, Simulation, Stepped, Tried};
use crate::step::error::{StepError, StepFailure};
use crate::step::explicit::Demand;
use crate::step::newton::StepReport;
use crate::step::outcome::{Attempt, Outcome};
use eem_material::number::scalar::is_positive;

/// How often a step is halved in search of a size that succeeds.
const HALVINGS: usize = 10;

/// The start of a step of a size; borrows only the fields that it names.
macro_rules! start {
    ($run:expr, $step:expr) => {
        crate::step::explicit::View {
            step: $step,
            state: &$run.state,
            conduction: &$run.conduction,
            loads: &$run.loads,
            masses: &$run.masses,
            least: &$run.least,
        }
    };
}
pub(super) use start;

impl Run {
    /// One step of this size. It is rejected if the scheme estimates its error and that is not within the demand.
    pub(super) fn try_step(&mut self, size: f64, demand: Demand) -> Result<Tried, StepError> {
        let found = self.find_next(size, demand);
        let Attempt { error, outcome } = found.map_err(|failure| self.failed(size, failure))?;
        let Some(outcome) = outcome else {
            return Ok(Tried::Rejected(error));
        };
        self.go_to_next(size, error, &outcome);
        Ok(Tried::Made)
    }

    /// One step of this size, whatever its error.
    pub(super) fn step_by(&mut self, size: f64) -> Stepped {
        self.make_step(size)
    }

    /// The same, without a call.
    #[inline(always)]
    #[expect(
        clippy::inline_always,
        reason = "a step of one spring copies nothing twice"
    )]
    pub(super) fn make_step(&mut self, size: f64) -> Stepped {
        match self.find_next(size, Demand::None) {
            Ok(Attempt {
                error,
                outcome: Some(outcome),
            }) => self.go_to_next(size, error, &outcome),
            Ok(_) => unreachable!("a step without a tolerance is not rejected"),
            Err(failure) => return Err(self.failed(size, failure)),
        }
        Ok(())
    }

    /// Makes the next state the present one, and its report.
    #[inline]
    fn go_to_next(&mut self, size: f64, error: f64, outcome: &Outcome) {
        mem::swap(&mut self.state, &mut self.next);
        self.has_stepped = true;
        if self.has_loads && !self.loads.ovens.is_empty() {
            self.book_ovens();
        }
        #[cfg(feature = "gradients")]
        self.keep_step(size);
        self.report = StepReport {
            time: self.time(),
            step: size,
            iterations: self.effort.history.len(),
            update: self.effort.end.update,
            residual: self.effort.end.residual,
            defect: outcome.defect,
            bound: outcome.bound,
            is_bound_wide: outcome.is_bound_wide,
            production: outcome.production,
            least_production: outcome.least_production,
            unresolved: outcome.unresolved,
            correction: outcome.correction.abs(),
            error,
        };
        if outcome.correction != 0.0 {
            self.corrections.note(outcome.correction);
        }
        let is_worse = self.worst.is_none_or(|worst| {
            let (own, other) = (outcome.defect.abs(), worst.defect.abs());
            other * outcome.bound < own * worst.bound
        });
        if is_worse {
            self.worst = Some(self.report);
        }
    }

    /// Writes the next state.
    #[inline]
    fn find_next(&mut self, size: f64, demand: Demand) -> Result<Attempt, StepFailure> {
        self.has_stepped = false;
        self.effort.restart();
        let end = self.time() + size;
        if !end.is_finite() {
            let value = end;
            return Err(StepFailure::Time { value });
        }
        if size < SHORTEST {
            return Err(StepFailure::TooShort { value: size });
        }
        if self.has_loads {
            self.heat_ovens(size)?;
            self.evaluate_loads(size)?;
        }
        let (effort, next) = (&mut self.effort, &mut *self.next);
        self.stepper.step(&start!(self, size), demand, effort, next)
    }

    /// The loads of a step of this size.
    pub(super) fn evaluate_loads(&mut self, size: f64) -> Result<(), StepFailure> {
        if self.has_loads {
            let start = start!(self, size);
            self.stepper.evaluate_loads(&start, self.in_use)?;
        }
        Ok(())
    }

    /// The error with a shorter step that can be made instead, if trying finds one; the simulation is unchanged.
    #[cold]
    pub(super) fn with_shorter(&mut self, mut error: StepError, size: f64) -> StepError {
        if self.control.is_some() || !error.failure.depends_on_step() {
            return error;
        }
        let before = self.snapshot();
        let mut shorter = size;
        for _ in 0..HALVINGS {
            shorter *= 0.5;
            if self.step_by(shorter).is_ok() {
                error.shorter = Some(shorter);
                break;
            }
        }
        self.return_to_snapshot(&before);
        error
    }

    /// Sets the temperatures of ovens to those in the middle of a step of this size.
    #[cold]
    pub(super) fn heat_ovens(&mut self, size: f64) -> Result<(), StepFailure> {
        for (index, temperature) in &self.loads.ovens {
            let time = self.state.time.value + 0.5 * size;
            let theta = temperature(time);
            if !is_positive(theta) {
                return Err(StepFailure::Oven {
                    reservoir: *index,
                    value: theta,
                    time,
                });
            }
            self.conduction.reservoirs[*index] = theta;
        }
        Ok(())
    }

    /// Books what ovens have given in the last step: the heat `−θ Δσ` and the entropy `−Δσ`.
    #[cold]
    pub(super) fn book_ovens(&mut self) {
        let state = &mut self.state;
        for &(index, _) in &self.loads.ovens {
            let received = state.reservoir_entropies.sum(index);
            state.reservoir_entropies.set(index, 0.0);
            let theta = self.conduction.reservoirs[index];
            state.heat.add(-theta * received.value);
            state.heat.add(-theta * received.carry);
            state.thermostat_entropy.add(received.value);
            state.thermostat_entropy.add(received.carry);
        }
        // The explicit scheme has stored energies of reservoirs, and rates at their old temperatures.
        self.forget_loads();
    }

    /// The temperature of a reservoir now, K.
    pub(super) fn reservoir_now(&self, index: usize) -> f64 {
        let mut ovens = self.loads.ovens.iter();
        let oven = ovens.find(|(own, _)| *own == index);
        oven.map_or(self.conduction.reservoirs[index], |(_, temperature)| {
            temperature(self.state.time.value)
        })
    }
}

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
        self.run.has_stepped = false;
        self.run.effort.restart();
        let found = self.find_tangent(unknowns);
        found.map_err(|failure| self.run.failed(self.run.step, failure))
    }

    fn find_tangent(&mut self, unknowns: &[f64]) -> Result<StepTangent, StepFailure> {
        let (given, expected) = (unknowns.len(), self.unknowns());
        if given != expected {
            return Err(StepFailure::Unknowns { given, expected });
        }
        let run = &mut self.run;
        run.evaluate_loads(run.step)?;
        let Stepper::Newton(newton) = run.stepper.of_mut::<D>() else {
            // An explicit scheme solves no system.
            let (residual, tangent) = (Vec::new(), Vec::new());
            return Ok(StepTangent { residual, tangent });
        };
        let start = start!(run, run.step);
        let (residual, tangent) = newton.linearize(&start, unknowns, &mut run.effort)?;
        Ok(StepTangent { residual, tangent })
    }
}
