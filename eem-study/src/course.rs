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

/// The most steps of a run.
const MOST_STEPS: u32 = u32::MAX;

/// Roundings, in ε times the end time, by which a whole number of steps may miss the end: half a unit each from the
/// step and the end as doubles and from their product, and more to be safe.
const ROUNDINGS: f64 = 4.0;

/// A scene that is built anew for every run.
pub(crate) type Build<'a, const D: usize, S> = dyn Fn() -> Scene<D, S> + 'a;

/// A setting with its steps up to a common end time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Course {
    setting: Setting,
    /// s.
    end: f64,
    /// The number of equal steps, or a typical number of controlled ones.
    pub(crate) planned: u32,
}

impl Course {
    /// The course of a setting up to the time `end`, s.
    pub(crate) fn of(setting: Setting, end: f64) -> Result<Self, StudyError> {
        let planned = match setting.steps {
            StepChoice::Fixed(step) => whole_steps(step, end)?,
            StepChoice::Tolerance(_) => TYPICAL_STEPS,
        };
        Ok(Self {
            setting,
            end,
            planned,
        })
    }

    /// The course of a scheme with this number of equal steps up to the time `end`, s.
    pub(crate) fn equal(scheme: Scheme, steps: u32, end: f64) -> Self {
        Self {
            setting: Setting::fixed(scheme, end / f64::from(steps)),
            end,
            planned: steps,
        }
    }

    /// A simulation at the start.
    pub(crate) fn start<const D: usize, S: Real>(
        &self,
        build: &Build<'_, D, S>,
    ) -> Result<Simulation<D, S>, SceneError> {
        let (scheme, step) = (self.setting.scheme, self.setting.step());
        let first = S::from_f64(step.unwrap_or(FIRST * self.end));
        let mut run = Simulation::new(build(), scheme, first)?;
        match self.setting.tolerance() {
            Some(relative) => run.control_steps(Tolerance::new(S::from_f64(relative)))?,
            None => run.fix_steps(),
        }
        Ok(run)
    }

    /// All steps, or those up to the first that fails.
    pub(crate) fn go<const D: usize, S: Real>(
        &self,
        run: &mut Simulation<D, S>,
        mut watch: impl FnMut(&Simulation<D, S>, &StepReport<S>),
    ) -> Result<(), StepError> {
        match self.setting.steps {
            StepChoice::Fixed(_) => {
                for _ in 0..self.planned {
                    let report = run.step()?;
                    watch(run, &report);
                }
            }
            StepChoice::Tolerance(_) => {
                run.run_until_with(S::from_f64(self.end), |run, report| {
                    watch(run, report);
                    ControlFlow::Continue(())
                })?;
            }
        }
        Ok(())
    }
}

/// The number of steps of this size up to the time `end`, s; an error unless it is whole.
fn whole_steps(step: f64, end: f64) -> Result<u32, StudyError> {
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
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a whole number from 1 to MOST_STEPS"
        )]
        return Ok(steps as u32);
    }
    let steps = (end / step).floor();
    Err(StudyError::NoWholeSteps {
        step,
        end,
        shorter: end / (steps + 1.0),
        longer: end / steps.max(1.0),
    })
}
