//! All solvers in both variables over all tolerances: errors, energy defects and wall times.

use std::error::Error;
use std::time::{Duration, Instant};

use crate::cases::CaseName;
use crate::reference::Reference;
use crate::rows::Row;
use crate::solvers::{Solver, Task};
use crate::systems::{Double, Single, System, Variables, larger};
use eem_studies::terminal;

/// By decades from 10⁻² to 10⁻¹¹.
pub(crate) const TOLERANCES: [f64; 10] =
    [1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11];

/// Repeats for the clock: at least the first number, at most the second, in between as many as fit into the time.
const REPEATS: [u32; 2] = [5, 400];
const PATIENCE: Duration = Duration::from_millis(200);

/// The rows of all peers for a case and an end time, s.
pub(crate) fn study(case: CaseName, end: f64) -> Result<Vec<Row>, Box<dyn Error>> {
    let reference = Reference::of(case, end)?;
    let [q, p, theta] = reference.doubts;
    terminal::say(format_args!(
        "References: gauss4 of the library in {} steps and dop853; they differ by {q:.0e} in q, {p:.0e} in p, \
         {theta:.0e} in θ.",
        reference.steps
    ));
    let mut rows = Vec::new();
    for solver in Solver::ALL {
        for variables in Variables::ALL {
            let name = format!("{} {}", solver.name(), variables.name());
            let start = reference.start.clone();
            let next = match case.double() {
                None => line(&Single::new(variables, start), solver, &reference, end),
                Some(case) => line(
                    &Double::new(&case, variables, start),
                    solver,
                    &reference,
                    end,
                ),
            };
            rows.extend(next.into_iter().map(|row| Row {
                scheme: name.clone(),
                ..row
            }));
        }
    }
    Ok(rows)
}

/// One solver with all tolerances.
fn line<const N: usize>(
    system: &impl System<N>,
    solver: Solver,
    reference: &Reference,
    end: f64,
) -> Vec<Row> {
    let rows = TOLERANCES.iter().map(|&tolerance| {
        let task = Task {
            system,
            sizes: system.sizes(reference.momentum),
            end,
            tolerance,
        };
        measure(&task, solver, reference)
    });
    rows.collect()
}

/// One run that is watched and warms up, and those for the clock, which are not watched.
fn measure<const N: usize, S: System<N>>(
    task: &Task<'_, S, N>,
    solver: Solver,
    reference: &Reference,
) -> Row {
    let first = task.system.energy(&task.system.start());
    let mut defect = 0.0;
    let watched = solver.solve(task, |y| {
        let change = (task.system.energy(y) - first).abs() / first.abs();
        defect = larger(defect, change);
    });
    let solved = match watched {
        Ok(solved) => solved,
        Err(error) => {
            terminal::say(format_args!(
                "{} at {:.0e}: {error}",
                solver.name(),
                task.tolerance
            ));
            return Row::failed(task.tolerance, defect);
        }
    };
    let end = task.system.state(&solved.y);
    Row {
        scheme: String::new(),
        tolerance: Some(task.tolerance),
        step: None,
        errors: reference.errors(&end),
        largest_error: reference.largest_error(&end),
        energy_defect: Some(defect),
        steps: solved.steps,
        rejected: solved.rejected,
        evaluations: solved.evaluations,
        seconds: Some(least_time(task, solver)),
    }
}

/// The least time of the steps in all repeats, s.
fn least_time<const N: usize, S: System<N>>(task: &Task<'_, S, N>, solver: Solver) -> f64 {
    let [fewest, most] = REPEATS;
    let started = Instant::now();
    let mut least = f64::INFINITY;
    for repeat in 0..most {
        if repeat >= fewest && started.elapsed() > PATIENCE {
            break;
        }
        if let Ok(solved) = solver.solve(task, |_| ()) {
            least = least.min(solved.seconds);
        }
    }
    least
}
