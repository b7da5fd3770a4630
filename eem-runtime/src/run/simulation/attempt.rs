//! One step of the present size by the scheme in use.

use core::mem;

use super::check::check_end;
use super::stepper::{Newton, Stepper};
use super::{Simulation, Tried};
use crate::element::phase::Phase;
use crate::step::error::{StepError, StepFailure};
use crate::step::explicit::Demand;
use crate::step::newton::StepReport;
use crate::step::outcome::Attempt;
use eem_material::number::scalar::{Discord, Mask, Real};

/// What the elements share during the next step; borrows only the fields that it names.
macro_rules! view {
    ($simulation:ident, $phase:expr, $state:expr, [$loads:expr, $stages:expr]) => {
        crate::element::group::StepView {
            phase: $phase,
            step: $simulation.step,
            per_step: $simulation.step.recip(),
            state: $state,
            conduction: &$simulation.conduction,
            loads: $loads,
            stages: $stages,
            masses: &$simulation.masses,
        }
    };
}
pub(super) use view;

/// What an explicit step starts from; borrows only the fields that it names.
macro_rules! explicit_view {
    ($simulation:ident) => {
        crate::step::explicit::ExplicitView {
            step: $simulation.step,
            state: &$simulation.state,
            conduction: &$simulation.conduction,
            loads: &$simulation.loads,
            masses: &$simulation.masses,
        }
    };
}
pub(super) use explicit_view;

impl<const D: usize, S: Real> Simulation<D, S> {
    /// One step of this size, which later steps do not have, unless it estimates its own error and that is not within
    /// what is demanded.
    pub(super) fn try_step(&mut self, size: S, demand: Demand<S>) -> Result<Tried<S>, StepError> {
        let usual = mem::replace(&mut self.step, size);
        OtherSize { run: self, usual }
            .run
            .try_step_of_its_size(demand)
    }

    /// One step of this size, whatever its error.
    pub(super) fn step_by(&mut self, size: S) -> Result<StepReport<S>, StepError> {
        match self.try_step(size, Demand::None)? {
            Tried::Made(report) => Ok(report),
            Tried::Refused(_) => unreachable!("a step without a tolerance has no error"),
        }
    }

    fn try_step_of_its_size(&mut self, demand: Demand<S>) -> Result<Tried<S>, StepError> {
        self.has_stepped = false;
        self.effort.restart();
        let Attempt { error, outcome } = match self.find_next(demand) {
            Ok(attempt) => attempt,
            Err(failure) => return Err(self.failed(failure)),
        };
        let Some(outcome) = outcome else {
            return Ok(Tried::Refused(error));
        };
        mem::swap(&mut self.state, &mut self.next);
        self.has_stepped = true;
        let report = StepReport {
            time: self.time(),
            step: self.step,
            iterations: self.effort.history.len(),
            update: self.effort.end.update,
            residual: self.effort.end.residual,
            defect: outcome.defect,
            bound: outcome.bound,
            is_bound_wide: outcome.is_bound_wide,
            production: outcome.production,
            least_production: outcome.least_production,
            correction: outcome.correction.abs(),
            error,
        };
        self.corrections.note(outcome.correction);
        self.note_worst(&report);
        Ok(Tried::Made(report))
    }

    /// Writes the next state.
    fn find_next(&mut self, demand: Demand<S>) -> Result<Attempt<S>, StepFailure> {
        if self.has_parted() {
            // An experiment that ignores failed steps and waits for something would loop forever.
            return Err(Discord.into());
        }
        check_end(self.time() + self.step)?;
        self.evaluate_loads()?;
        let (effort, next) = (&mut self.effort, &mut *self.next);
        let newton = match &mut self.stepper {
            Stepper::Newton(newton) => newton,
            Stepper::Explicit(explicit) => {
                return explicit.step(&explicit_view!(self), demand, next);
            }
        };
        let Newton {
            groups,
            solver,
            loads,
            stages,
            between,
        } = &mut **newton;
        let Some(between) = between else {
            let view = view!(self, Phase::Whole, &self.state, [loads, stages]);
            return Ok(Attempt::made(solver.solve(groups, &view, effort, next)?));
        };
        let view = view!(self, Phase::Mechanics, &self.state, [loads, stages]);
        let motion = solver.solve(groups, &view, effort, between)?;
        let view = view!(self, Phase::Heat, between, [loads, stages]);
        let heat = solver.solve(groups, &view, effort, next)?;
        Ok(Attempt::made(motion.and(heat)))
    }

    /// Keeps a report if it comes closer to its bound than all before.
    fn note_worst(&mut self, report: &StepReport<S>) {
        let is_worse = self.worst.is_none_or(|worst| {
            let (own, other) = (report.defect.abs(), worst.defect.abs());
            (other * report.bound).less(own * worst.bound).any()
        });
        if is_worse {
            self.worst = Some(*report);
        }
    }

    /// The loads of the next step.
    pub(super) fn evaluate_loads(&mut self) -> Result<(), StepFailure> {
        if self.loads.are_none() {
            return Ok(());
        }
        let span = [self.time(), self.step];
        let Stepper::Newton(newton) = &mut self.stepper else {
            return Ok(());
        };
        newton.evaluate_loads(
            &self.loads,
            &self.masses,
            self.in_use,
            span,
            self.state.positions.values(),
        )
    }
}

/// A simulation that makes one step of another size. It gets its own size back even where a load
/// panics.
struct OtherSize<'a, const D: usize, S: Real> {
    run: &'a mut Simulation<D, S>,
    usual: S,
}

impl<const D: usize, S: Real> Drop for OtherSize<'_, D, S> {
    fn drop(&mut self) {
        self.run.step = self.usual;
    }
}
