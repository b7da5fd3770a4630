//! Runs of a study: their steps up to the end time, equal or controlled, how well they keep the laws, and wall times.

use core::ops::ControlFlow;
use std::time::Instant;

use crate::error::StudyError;
use crate::progress::Progress;
use crate::quantity::{EndState, larger, share};
use crate::row::StudyRow;
use crate::setting::{Setting, StepChoice};
use eem_runtime::{Scene, SceneError, Scheme, Simulation, StepError, StepReport, Tolerance};

/// The first step of a run with a tolerance, in units of the end time.
const FIRST: f64 = 1.0 / 64.0;

/// The steps that are planned for a run with a tolerance, as their number is not known before.
const TYPICAL_STEPS: u32 = 1000;

/// The most steps of a run.
const MOST_STEPS: u32 = u32::MAX;

/// Roundings, in ε times the end time, by which a whole number of steps may miss the end: half a unit each from the
/// step and the end as doubles and from their product, and more to be safe.
const ROUNDINGS: f64 = 4.0;

/// A scene that is built anew for every run.
pub(crate) type Build<'a, const D: usize> = dyn Fn() -> Scene<D> + 'a;

/// A setting with its steps up to a common end time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Course {
    pub(crate) setting: Setting,
    /// The end time, s.
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
    pub(crate) fn start<const D: usize>(
        &self,
        build: &Build<'_, D>,
    ) -> Result<Simulation<D>, SceneError> {
        let (scheme, step) = (self.setting.scheme, self.setting.step());
        let first = step.unwrap_or(FIRST * self.end);
        let mut run = Simulation::new(build(), scheme, first)?;
        match self.setting.tolerance() {
            Some(relative) => run.control_steps(Tolerance::new(relative))?,
            None => run.fix_steps(),
        }
        Ok(run)
    }

    /// Makes all steps, up to the first that fails or after which `watch` breaks.
    pub(crate) fn go<const D: usize>(
        &self,
        run: &mut Simulation<D>,
        mut watch: impl FnMut(&Simulation<D>, &StepReport) -> ControlFlow<()>,
    ) -> Result<(), StepError> {
        match self.setting.steps {
            StepChoice::Fixed(_) => {
                for _ in 0..self.planned {
                    let report = run.step()?;
                    if watch(run, &report).is_break() {
                        break;
                    }
                }
            }
            StepChoice::Tolerance(_) => {
                let end = run.time() + self.end;
                run.run_until_with(end, watch)?;
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

/// A run to the end time, or to its first failed step.
#[derive(Clone, Debug)]
pub(crate) struct Finished {
    pub(crate) end: Result<EndState, StepError>,
    /// The time of building the scene and the simulation, s.
    pub(crate) setup: f64,
    /// The time of the steps alone, s.
    pub(crate) seconds: f64,
}

/// Why a run has no end.
#[derive(Debug)]
pub(crate) enum NoEnd {
    /// The scene is rejected.
    Scene(SceneError),
    /// The function that watches the study has ended it.
    Stopped,
}

impl NoEnd {
    /// The error of a study, from a run of this setting.
    pub(crate) fn of(self, setting: Setting) -> StudyError {
        match self {
            Self::Scene(source) => StudyError::Scene { setting, source },
            Self::Stopped => StudyError::Stopped,
        }
    }
}

/// What is watched in every step, which takes time.
#[derive(Debug)]
pub(crate) enum Watched<'a> {
    /// Nothing: the run is timed.
    Nothing,
    /// The momenta, for the scale of their errors.
    Momenta,
    /// The laws, which fill in a row.
    Laws(&'a mut StudyRow),
}

/// Runs a setting.
pub(crate) fn run<const D: usize>(
    build: &Build<'_, D>,
    course: &Course,
    watched: Watched<'_>,
    progress: &mut Progress<'_>,
) -> Result<Finished, NoEnd> {
    progress.begin(u64::from(course.planned));
    let start = Instant::now();
    let mut run = course.start(build).map_err(NoEnd::Scene)?;
    let setup = start.elapsed().as_secs_f64();
    let watches_momenta = matches!(watched, Watched::Momenta);
    let mut largest_momentum = run.largest_momentum();
    let mut laws = match watched {
        Watched::Laws(row) => Some(Laws::new(&run, row)),
        Watched::Nothing | Watched::Momenta => None,
    };
    let mut outcome = ControlFlow::Continue(());
    let start = Instant::now();
    let end = course.go(&mut run, |run, report| {
        if watches_momenta {
            largest_momentum = largest_momentum.max(run.largest_momentum());
        }
        if let Some(laws) = &mut laws {
            laws.watch(run, report);
        }
        outcome = progress.step();
        outcome
    });
    let seconds = start.elapsed().as_secs_f64();
    if outcome.is_break() || progress.end().is_break() {
        return Err(NoEnd::Stopped);
    }
    if let Some(Laws { row, .. }) = laws {
        let statistics = run.step_statistics();
        let rejected = statistics.map_or(0, |statistics| statistics.rejected());
        row.rejected = u32::try_from(rejected).unwrap_or(u32::MAX);
        row.evaluations = run.evaluations();
        row.failure = end.clone().err();
    }
    Ok(Finished {
        end: end.map(|()| EndState::of(&run).with_largest_momentum(largest_momentum)),
        setup,
        seconds,
    })
}

/// Watches the laws during a run.
struct Laws<'a> {
    row: &'a mut StudyRow,
    /// `B₀`, J, with `B = E − work − heat`.
    balance: f64,
    /// The largest of `|E₀|`, the kinetic energy, the work and the heat so far, J.
    energy: f64,
    /// The largest `|B − B₀|` and bound of a step so far, J.
    defect: f64,
    bound: f64,
    /// The total entropy after the last step, J/K.
    entropy: f64,
}

impl<'a> Laws<'a> {
    fn new<const D: usize>(run: &Simulation<D>, row: &'a mut StudyRow) -> Self {
        let ledger = run.ledger();
        Self {
            row,
            balance: ledger.balance,
            energy: ledger.energy.abs(),
            defect: 0.0,
            bound: 0.0,
            entropy: ledger.entropy,
        }
    }

    fn watch<const D: usize>(&mut self, run: &Simulation<D>, report: &StepReport) {
        let (ledger, row) = (run.ledger(), &mut *self.row);
        row.steps += 1;
        row.iterations += report.iterations;
        let defect = (ledger.balance - self.balance).abs();
        self.defect = larger(self.defect, defect);
        self.bound = larger(self.bound, report.bound);
        for part in [ledger.kinetic_energy, ledger.work, ledger.heat] {
            self.energy = larger(self.energy, part.abs());
        }
        row.energy_defect = share(self.defect, self.energy);
        row.step_bound = share(self.bound, self.energy);
        let entropy = ledger.entropy;
        // `0.0 −` makes 0 of −0, which a run without production would have.
        row.least_entropy_change = 0.0 - larger(-row.least_entropy_change, self.entropy - entropy);
        self.entropy = entropy;
    }
}
