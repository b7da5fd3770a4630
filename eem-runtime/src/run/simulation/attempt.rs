//! One step of a given size by the scheme in use.

use core::mem;

use super::check::SHORTEST;
use super::stepper::{Newton, Stepper};
use super::{Simulation, StepResult, Tried};
use crate::element::phase::Phase;
use crate::step::error::{StepError, StepFailure};
use crate::step::explicit::Demand;
use crate::step::newton::StepReport;
use crate::step::outcome::{Attempt, Outcome};

/// How often a step is halved in search of a size that succeeds.
const HALVINGS: usize = 10;

/// The data shared by all elements during a step of a size; borrows only the fields that it names.
macro_rules! view {
    ($simulation:ident, $step:expr, $phase:expr, $state:expr, [$loads:expr, $stages:expr]) => {
        crate::element::group::StepView {
            phase: $phase,
            step: $step,
            per_step: $step.recip(),
            state: $state,
            conduction: &$simulation.conduction,
            loads: $loads,
            stages: $stages,
            masses: &$simulation.masses,
        }
    };
}
pub(super) use view;

/// The start of an explicit step of a size; borrows only the fields that it names.
macro_rules! explicit_view {
    ($simulation:ident, $step:expr) => {
        crate::step::explicit::ExplicitView {
            step: $step,
            state: &$simulation.state,
            conduction: &$simulation.conduction,
            loads: &$simulation.loads,
            masses: &$simulation.masses,
            least: &$simulation.least,
        }
    };
}
pub(super) use explicit_view;

impl<const D: usize> Simulation<D> {
    /// One step of this size. It is rejected if the scheme estimates its error and that is not within the demand.
    pub(super) fn try_step(&mut self, size: f64, demand: Demand) -> Result<Tried, StepError> {
        let found = self.find_next(size, demand);
        let Attempt { error, outcome } = found.map_err(|failure| self.failed(size, failure))?;
        let Some(outcome) = outcome else {
            return Ok(Tried::Rejected(error));
        };
        self.go_to_next(size, error, &outcome);
        Ok(Tried::Made(self.report))
    }

    /// One step of this size, whatever its error.
    pub(super) fn step_by(&mut self, size: f64) -> StepResult {
        self.make_step(size)?;
        Ok(self.report)
    }

    /// The same; the report stays in the simulation.
    #[inline(always)]
    #[expect(
        clippy::inline_always,
        reason = "a step of one spring copies nothing twice"
    )]
    pub(super) fn make_step(&mut self, size: f64) -> Result<(), StepError> {
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
    #[inline(never)]
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
        let newton = match &mut self.stepper {
            Stepper::Newton(newton) => &mut **newton,
            Stepper::Explicit(explicit) => {
                return explicit.step(&explicit_view!(self, size), demand, next);
            }
        };
        let Newton {
            groups,
            solver,
            loads,
            stages,
            intermediate,
        } = newton;
        let Some(intermediate) = intermediate else {
            let view = view!(self, size, Phase::Whole, &self.state, [loads, stages]);
            return Ok(Attempt::made(solver.solve(groups, &view, effort, next)?));
        };
        let view = view!(self, size, Phase::Mechanics, &self.state, [loads, stages]);
        let motion = *solver.solve(groups, &view, effort, intermediate)?;
        let view = view!(self, size, Phase::Heat, intermediate, [loads, stages]);
        let mut whole = motion.and(*solver.solve(groups, &view, effort, next)?);
        if whole.is_bound_wide() {
            whole.find_terms(groups, [&self.state, next]);
        }
        Ok(Attempt::made(&whole))
    }

    /// The loads of a step of this size.
    pub(super) fn evaluate_loads(&mut self, size: f64) -> Result<(), StepFailure> {
        let span = [self.time(), size];
        match &mut self.stepper {
            Stepper::Newton(newton) if self.has_loads => {
                let old = &self.state;
                newton.evaluate_loads(&self.loads, &self.masses, self.in_use, span, old)
            }
            _ => Ok(()),
        }
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
}
