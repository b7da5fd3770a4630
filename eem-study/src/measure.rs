//! One run of a setting: its state at the end, how well it keeps the laws, and its wall time.

use std::time::Instant;

use crate::course::{Build, Course};
use crate::quantity::{EndState, larger, share};
use crate::row::StudyRow;
use eem_material::number::scalar::Real;
use eem_runtime::{SceneError, Simulation, StepError, StepReport};

/// A run to the end time, or to its first failed step.
#[derive(Clone, Debug)]
pub(crate) struct Finished {
    pub(crate) end: Result<EndState, StepError>,
    /// The time of building the scene and the simulation, s.
    pub(crate) setup: f64,
    /// The time of the steps alone, s.
    pub(crate) seconds: f64,
}

/// Runs a setting. With a row, every step is watched, which takes time, and the row is filled in.
pub(crate) fn run<const D: usize, S: Real>(
    build: &Build<'_, D, S>,
    course: &Course,
    row: Option<&mut StudyRow>,
) -> Result<Finished, SceneError> {
    let start = Instant::now();
    let mut run = course.start(build)?;
    let setup = start.elapsed().as_secs_f64();
    let mut laws = row.map(|row| Laws::new(&run, row));
    let start = Instant::now();
    let end = course.go(&mut run, |run, report| {
        if let Some(laws) = &mut laws {
            laws.watch(run, report);
        }
    });
    let seconds = start.elapsed().as_secs_f64();
    if let Some(Laws { row, .. }) = laws {
        let statistics = run.step_statistics();
        let rejected = statistics.map_or(0, |statistics| statistics.rejected());
        row.rejected = u32::try_from(rejected).unwrap_or(u32::MAX);
        row.evaluations = run.evaluations();
        row.failure = end.clone().err();
    }
    Ok(Finished {
        end: end.map(|()| EndState::of(&run)),
        setup,
        seconds,
    })
}

/// Watches the laws during a run.
struct Laws<'a> {
    row: &'a mut StudyRow,
    /// `B₀` and `|E₀|`, J, with `B = E − work − heat`.
    first: [f64; 2],
    /// The total entropy after the last step, J/K.
    entropy: f64,
}

impl<'a> Laws<'a> {
    fn new<const D: usize, S: Real>(run: &Simulation<D, S>, row: &'a mut StudyRow) -> Self {
        let ledger = run.ledger();
        Self {
            row,
            first: [ledger.balance.to_f64(), ledger.energy.to_f64().abs()],
            entropy: ledger.entropy.to_f64(),
        }
    }

    fn watch<const D: usize, S: Real>(&mut self, run: &Simulation<D, S>, report: &StepReport<S>) {
        let (ledger, row) = (run.ledger(), &mut *self.row);
        row.steps += 1;
        row.iterations += report.iterations;
        let [balance, energy] = self.first;
        let defect = share((ledger.balance.to_f64() - balance).abs(), energy);
        row.energy_defect = larger(row.energy_defect, defect);
        row.step_bound = larger(row.step_bound, share(report.bound.to_f64(), energy));
        let entropy = ledger.entropy.to_f64();
        row.least_entropy_change = -larger(-row.least_entropy_change, self.entropy - entropy);
        self.entropy = entropy;
    }
}
