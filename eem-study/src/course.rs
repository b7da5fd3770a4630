//! How a run gets to the end: in equal steps, or in those that an accuracy needs.

use core::ops::ControlFlow;

use crate::error::StudyError;
use crate::grid::Grid;
use crate::setting::{Setting, StepChoice};
use eem_material::number::scalar::Real;
use eem_runtime::Scene;
use eem_runtime::SceneError;
use eem_runtime::Scheme;
use eem_runtime::Simulation;
use eem_runtime::StepError;
use eem_runtime::StepReport;
use eem_runtime::Tolerance;

/// The first step that a run with a tolerance tries, as a share of the end time.
const FIRST: f64 = 1.0 / 64.0;

/// What a run with a tolerance counts for in the progress of a study: nobody knows its steps before.
const TYPICAL_STEPS: u32 = 1000;

/// A scene that is built anew for every run.
pub(crate) type Build<'a, const D: usize, S> = dyn Fn() -> Scene<D, S> + 'a;

/// A scheme on its way to a common end time.
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
    /// That of a setting up to the time `end`, s.
    pub(crate) fn of(setting: &Setting, end: f64) -> Result<Self, StudyError> {
        let steps = match setting.steps {
            StepChoice::Fixed(step) => Steps::Equal(Grid::of(step, end)?),
            StepChoice::Tolerance(relative) => Steps::Controlled(relative),
        };
        Ok(Self {
            scheme: setting.scheme,
            end,
            steps,
        })
    }

    /// That of a scheme on a grid up to the time `end`, s.
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
        let step = match self.steps {
            Steps::Equal(grid) => grid.step,
            Steps::Controlled(_) => FIRST * self.end,
        };
        let mut run = Simulation::new(build(), self.scheme, S::from_f64(step))?;
        match self.steps {
            Steps::Equal(_) => run.fix_steps(),
            Steps::Controlled(relative) => {
                run.control_steps(Tolerance::new(S::from_f64(relative)))?;
            }
        }
        Ok(run)
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
