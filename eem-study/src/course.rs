//! The steps of a run up to the end time: equal ones, or controlled ones.

use core::ops::ControlFlow;

use crate::error::StudyError;
use crate::setting::{Setting, StepChoice};
use eem_material::number::scalar::Real;
use eem_runtime::{Scene, SceneError, Scheme, Simulation, StepError, StepReport, Tolerance};

/// The first step of a run with a tolerance, in units of the end time.
const FIRST: f64 = 1.0 / 64.0;

/// The steps of a run with a tolerance in the progress of a study, as they are not known before.
const TYPICAL_STEPS: u32 = 1000;

/// A scene that is built anew for every run.
pub(crate) type Build<'a, const D: usize, S> = dyn Fn() -> Scene<D, S> + 'a;

/// A scheme with its steps up to a common end time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Course {
    scheme: Scheme,
    /// s.
    end: f64,
    steps: Steps,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Steps {
    Equal(Grid),
    Controlled(f64),
}

impl Course {
    /// The course of a setting up to the time `end`, s.
    pub(crate) fn of(setting: &Setting, end: f64) -> Result<Self, StudyError> {
        let scheme = setting.scheme;
        match setting.steps {
            StepChoice::Fixed(step) => Ok(Self::on_grid(scheme, Grid::of(step, end)?, end)),
            StepChoice::Tolerance(relative) => Ok(Self {
                scheme,
                end,
                steps: Steps::Controlled(relative),
            }),
        }
    }

    /// The course of a scheme with equal steps up to the time `end`, s.
    pub(crate) const fn on_grid(scheme: Scheme, grid: Grid, end: f64) -> Self {
        Self {
            scheme,
            end,
            steps: Steps::Equal(grid),
        }
    }

    /// How many steps it is likely to take.
    pub(crate) const fn planned(&self) -> u32 {
        match self.steps {
            Steps::Equal(grid) => grid.steps,
            Steps::Controlled(_) => TYPICAL_STEPS,
        }
    }

    /// A simulation at the start.
    pub(crate) fn start<const D: usize, S: Real>(
        &self,
        build: &Build<'_, D, S>,
    ) -> Result<Simulation<D, S>, SceneError> {
        let start = |step| Simulation::new(build(), self.scheme, S::from_f64(step));
        match self.steps {
            Steps::Equal(grid) => {
                let mut run = start(grid.step)?;
                run.fix_steps();
                Ok(run)
            }
            Steps::Controlled(relative) => {
                let mut run = start(FIRST * self.end)?;
                run.control_steps(Tolerance::new(S::from_f64(relative)))?;
                Ok(run)
            }
        }
    }

    /// All steps, or those up to the first that fails.
    pub(crate) fn go<const D: usize, S: Real>(
        &self,
        run: &mut Simulation<D, S>,
        mut watch: impl FnMut(&Simulation<D, S>, &StepReport<S>),
    ) -> Result<(), StepError> {
        match self.steps {
            Steps::Equal(grid) => {
                for _ in 0..grid.steps {
                    let report = run.step()?;
                    watch(run, &report);
                }
            }
            Steps::Controlled(_) => {
                run.run_until_with(S::from_f64(self.end), |run, report| {
                    watch(run, report);
                    ControlFlow::Continue(())
                })?;
            }
        }
        Ok(())
    }
}

/// The most steps of a run.
pub(crate) const MOST_STEPS: u32 = u32::MAX;

/// Roundings, in ε times the end time, by which a whole number of steps may miss the end: half a unit each from the
/// step and the end as doubles and from their product, and more to be safe.
const ROUNDINGS: f64 = 4.0;

/// Equal steps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Grid {
    /// s.
    pub(crate) step: f64,
    pub(crate) steps: u32,
}

impl Grid {
    /// Steps of this size up to the time `end`, s.
    pub(crate) fn of(step: f64, end: f64) -> Result<Self, StudyError> {
        if !(step > 0.0 && step.is_finite()) {
            return Err(StudyError::Step { step });
        }
        let steps = (end / step).round();
        if steps > f64::from(MOST_STEPS) {
            let most = MOST_STEPS;
            return Err(StudyError::TooManySteps { step, end, most });
        }
        let is_hit = (steps * step - end).abs() <= ROUNDINGS * f64::EPSILON * end;
        if steps >= 1.0 && is_hit {
            let steps = whole(steps);
            return Ok(Self { step, steps });
        }
        let steps = (end / step).floor();
        Err(StudyError::NoWholeSteps {
            step,
            end,
            shorter: end / (steps + 1.0),
            longer: end / steps.max(1.0),
        })
    }

    /// This number of equal steps up to the time `end`, s; `None` if there are too many.
    pub(crate) fn divided(end: f64, steps: u64) -> Option<Self> {
        let steps = u32::try_from(steps).ok()?;
        let step = end / f64::from(steps);
        Some(Self { step, steps })
    }
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a whole number from 1 to MOST_STEPS"
)]
fn whole(number: f64) -> u32 {
    number as u32
}
