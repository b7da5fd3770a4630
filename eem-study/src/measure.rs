//! One setting: its state at the end, what it did to the laws, and the time that it takes.

use std::time::Instant;

use crate::course::{Build, Course};
use crate::quantity::{EndState, larger, share};
use eem_material::number::scalar::Real;
use eem_runtime::SceneError;
use eem_runtime::Simulation;
use eem_runtime::StepError;

/// What a run was like.
#[derive(Clone, Debug)]
pub(crate) struct Measured {
    /// The state at the end time, or why the run did not get there.
    pub(crate) end: Result<EndState, StepError>,
    /// max |B − B₀|/|E₀| over the run with `B = E − work − heat`.
    pub(crate) energy_defect: f64,
    /// The largest bound of a step's defect over |E₀|.
    pub(crate) step_bound: f64,
    /// The smallest ΔS of a step, J/K.
    pub(crate) least_entropy_change: f64,
    pub(crate) steps: u32,
    pub(crate) rejected: u32,
    pub(crate) iterations: usize,
    pub(crate) evaluations: u64,
}

/// Wall times of the repeats, s.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Times {
    /// The least time that building the scene and the simulation took.
    pub(crate) setup: f64,
    /// The least time of all steps.
    pub(crate) least: f64,
    /// The median of it.
    pub(crate) median: f64,
}

/// Runs a setting once with an eye on its laws.
pub(crate) fn measure<const D: usize, S: Real>(
    build: &Build<'_, D, S>,
    course: &Course,
) -> Result<Measured, SceneError> {
    let mut run = course.start(build)?;
    let mut laws = Laws::new(&run);
    let (mut steps, mut iterations) = (0, 0);
    let end = course.go(&mut run, |run, report| {
        laws.watch(run, report.bound.to_f64());
        steps += 1;
        iterations += report.iterations;
    });
    let statistics = run.step_statistics();
    let rejected = statistics.map_or(0, |statistics| statistics.rejected());
    Ok(Measured {
        end: end.map(|()| EndState::of(&run)),
        energy_defect: laws.energy_defect,
        step_bound: laws.step_bound,
        least_entropy_change: laws.least_entropy_change,
        steps,
        rejected: u32::try_from(rejected).unwrap_or(u32::MAX),
        iterations,
        evaluations: run.evaluations(),
    })
}

/// The end of a run that is not watched.
pub(crate) fn end_state<const D: usize, S: Real>(
    build: &Build<'_, D, S>,
    course: &Course,
) -> Result<Result<EndState, StepError>, SceneError> {
    let mut run = course.start(build)?;
    let end = course.go(&mut run, |_, _| ());
    Ok(end.map(|()| EndState::of(&run)))
}

/// The time of building the scene and the simulation, and that of the steps alone, up to the first that
/// fails, s.
pub(crate) fn time<const D: usize, S: Real>(
    build: &Build<'_, D, S>,
    course: &Course,
) -> Result<[f64; 2], SceneError> {
    let start = Instant::now();
    let mut run = course.start(build)?;
    let setup = start.elapsed().as_secs_f64();
    let start = Instant::now();
    // A failure is that of the watched run.
    let _same_end = course.go(&mut run, |_, _| ());
    Ok([setup, start.elapsed().as_secs_f64()])
}

impl Times {
    /// Of the repeats of a setting.
    pub(crate) fn of(repeats: &[[f64; 2]]) -> Self {
        let sorted = |index: usize| {
            let mut times: Vec<f64> = repeats.iter().map(|times| times[index]).collect();
            times.sort_by(f64::total_cmp);
            times
        };
        let least = |times: &[f64]| times.first().copied().unwrap_or(f64::NAN);
        let (setups, times) = (sorted(0), sorted(1));
        let middle = |rank: usize| times.get(rank / 2).copied().unwrap_or(f64::NAN);
        Self {
            setup: least(&setups),
            least: least(&times),
            median: f64::midpoint(middle(times.len().saturating_sub(1)), middle(times.len())),
        }
    }
}

/// What a run has done to the laws so far.
struct Laws {
    /// `B₀` and `|E₀|`, J.
    first: [f64; 2],
    /// The total entropy after the last step, J/K.
    entropy: f64,
    energy_defect: f64,
    step_bound: f64,
    least_entropy_change: f64,
}

impl Laws {
    fn new<const D: usize, S: Real>(run: &Simulation<D, S>) -> Self {
        let ledger = run.ledger();
        Self {
            first: [ledger.balance.to_f64(), ledger.energy.to_f64().abs()],
            entropy: ledger.entropy.to_f64(),
            energy_defect: 0.0,
            step_bound: 0.0,
            least_entropy_change: f64::INFINITY,
        }
    }

    /// Looks at the state after a step whose defect has this bound, J.
    fn watch<const D: usize, S: Real>(&mut self, run: &Simulation<D, S>, bound: f64) {
        let ledger = run.ledger();
        let [balance, energy] = self.first;
        let defect = share((ledger.balance.to_f64() - balance).abs(), energy);
        self.energy_defect = larger(self.energy_defect, defect);
        self.step_bound = larger(self.step_bound, share(bound, energy));
        let entropy = ledger.entropy.to_f64();
        self.least_entropy_change = -larger(-self.least_entropy_change, self.entropy - entropy);
        self.entropy = entropy;
    }
}
