//! One step of a given size by the scheme in use.

use core::mem;

use super::stepper::{Newton, Stepper};
use super::{Simulation, StepResult, Tried};
use crate::element::phase::Phase;
use crate::step::error::{StepError, StepFailure};
use crate::step::explicit::Demand;
use crate::step::newton::StepReport;
use crate::step::outcome::Attempt;

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
        self.has_stepped = false;
        self.effort.restart();
        let found = self.find_next(size, demand);
        let Attempt { error, outcome } = found.map_err(|failure| self.failed(size, failure))?;
        let Some(outcome) = outcome else {
            return Ok(Tried::Rejected(error));
        };
        mem::swap(&mut self.state, &mut self.next);
        self.has_stepped = true;
        if self.has_loads && !self.loads.ovens.is_empty() {
            self.book_ovens();
        }
        #[cfg(feature = "gradients")]
        self.keep_step(size);
        let report = StepReport {
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
        self.corrections.note(outcome.correction);
        let is_worse = self.worst.is_none_or(|worst| {
            let (own, other) = (report.defect.abs(), worst.defect.abs());
            other * report.bound < own * worst.bound
        });
        if is_worse {
            self.worst = Some(report);
        }
        Ok(Tried::Made(report))
    }

    /// One step of this size, whatever its error.
    pub(super) fn step_by(&mut self, size: f64) -> StepResult {
        match self.try_step(size, Demand::None)? {
            Tried::Made(report) => Ok(report),
            Tried::Rejected(_) | Tried::Unseen(_) => {
                unreachable!("a step without a tolerance is not rejected")
            }
        }
    }

    /// Writes the next state.
    fn find_next(&mut self, size: f64, demand: Demand) -> Result<Attempt, StepFailure> {
        let end = self.time() + size;
        if !end.is_finite() {
            let value = end;
            return Err(StepFailure::Time { value });
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
        let motion = solver.solve(groups, &view, effort, intermediate)?;
        let view = view!(self, size, Phase::Heat, intermediate, [loads, stages]);
        let heat = solver.solve(groups, &view, effort, next)?;
        let whole = motion.and(heat);
        Ok(Attempt::made(
            whole.with_terms_of(groups, [&self.state, next]),
        ))
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
