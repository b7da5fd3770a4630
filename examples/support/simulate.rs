//! Stepping a simulation through its time grid while recording what the CSV files hold.

use std::time::{Duration, Instant};

use eem::prelude::*;

use super::progress::Progress;
use super::record::{Outcome, Record};
use super::time_grid::TimeGrid;

/// Names of the axes in the columns.
const AXES: [&str; 3] = ["x", "y", "z"];

/// What is recorded of a scene; columns are numbered in this order, from 1.
#[derive(Clone, Debug, Default)]
pub(crate) struct Watched {
    /// Masses whose position and momentum are recorded.
    pub(crate) masses: Vec<Node>,
    /// Elements whose temperature and viscous stretches are recorded, as far as they have any.
    pub(crate) elements: Vec<Element>,
    /// Whether the scene has reservoirs; the entropy that all have received is recorded.
    pub(crate) has_reservoirs: bool,
}

/// Steps through the time grid, or up to the first step that fails, and records the initial and
/// the grid's states under the name `name`.
///
/// # Errors
///
/// When a handle does not belong to the scene. A failed step is an outcome, not an error.
pub(crate) fn record<const D: usize>(
    name: &str,
    simulation: &mut Simulation<D>,
    watched: &Watched,
    grid: TimeGrid,
) -> Result<Record, SceneError> {
    record_with(name, simulation, watched, grid, |_| Ok(Vec::new()))
}

/// The same, with further columns of the example's own.
///
/// # Errors
///
/// When a handle does not belong to the scene.
pub(crate) fn record_with<const D: usize>(
    name: &str,
    simulation: &mut Simulation<D>,
    watched: &Watched,
    grid: TimeGrid,
    further: impl Fn(&Simulation<D>) -> Result<Vec<(&'static str, f64)>, SceneError>,
) -> Result<Record, SceneError> {
    let state = |simulation: &Simulation<D>| -> Result<_, SceneError> {
        let mut columns: Vec<(String, f64)> = state(simulation, watched)?;
        let own = further(simulation)?.into_iter();
        columns.extend(own.map(|(name, value)| (name.to_owned(), value)));
        Ok(columns)
    };
    let (names, values): (Vec<_>, Vec<_>) = state(simulation)?.into_iter().unzip();
    let mut record = Record::new(name, names);
    record.push(values, 0);
    let mut progress = Progress::new(name, grid.steps);
    let (mut elapsed, mut iterations) = (Duration::ZERO, 0);
    for step in 1..=grid.steps {
        let start = Instant::now();
        let outcome = simulation.step();
        elapsed += start.elapsed();
        match outcome {
            Ok(report) => iterations += report.iterations,
            Err(error) => {
                record.outcome = failure(&error);
                break;
            }
        }
        progress.advance(step);
        if step.is_multiple_of(grid.stride) {
            let values = state(simulation)?.into_iter().map(|column| column.1);
            record.push(values.collect(), std::mem::take(&mut iterations));
        }
    }
    record.elapsed = elapsed;
    Ok(record)
}

fn failure(error: &StepError) -> Outcome {
    let iterations = error.history.len();
    Outcome::Failed {
        time: error.time,
        reason: format!("{} ({iterations} iterations)", error.failure),
    }
}

/// The columns with their present values; energy, entropy and momenta come from the ledger.
fn state<const D: usize>(
    simulation: &Simulation<D>,
    watched: &Watched,
) -> Result<Vec<(String, f64)>, SceneError> {
    let ledger = simulation.ledger();
    let mut columns = vec![("time".to_owned(), simulation.time())];
    nodes(simulation, watched, &mut columns)?;
    let has_entropy = internal_variables(simulation, watched, &mut columns);
    if watched.has_reservoirs {
        columns.push(("reservoir_entropy".to_owned(), ledger.reservoir_entropy));
    }
    columns.push(("energy".to_owned(), ledger.energy));
    if has_entropy {
        columns.push(("entropy".to_owned(), ledger.entropy));
    }
    let momentum = ledger.angular_momentum;
    if D == 2 {
        columns.push(("angular_momentum".to_owned(), momentum[2]));
    } else if D == 3 {
        let named = AXES.iter().zip(momentum.iter());
        columns.extend(named.map(|(axis, &value)| (format!("angular_momentum_{axis}"), value)));
    }
    Ok(columns)
}

/// Appends `q1_x, …, q2_x, …, p1_x, …`.
fn nodes<const D: usize>(
    simulation: &Simulation<D>,
    watched: &Watched,
    columns: &mut Vec<(String, f64)>,
) -> Result<(), SceneError> {
    let mut append = |name: String, vector: &[f64]| {
        let named = AXES.iter().zip(vector);
        columns.extend(named.map(|(axis, &value)| (format!("{name}_{axis}"), value)));
    };
    for (number, &mass) in (1..).zip(&watched.masses) {
        append(format!("q{number}"), simulation.position(mass)?.as_slice());
    }
    for (number, &mass) in (1..).zip(&watched.masses) {
        append(format!("p{number}"), simulation.momentum(mass)?.as_slice());
    }
    Ok(())
}

/// Appends `theta_1, …, gamma_1, …`, where an element with several dashpots has `gamma_1_1, …`;
/// returns whether there is a temperature at all.
fn internal_variables<const D: usize>(
    simulation: &Simulation<D>,
    watched: &Watched,
    columns: &mut Vec<(String, f64)>,
) -> bool {
    let before = columns.len();
    for (number, &element) in (1..).zip(&watched.elements) {
        if let Ok(theta) = simulation.temperature(element) {
            columns.push((format!("theta_{number}"), theta));
        }
    }
    let is_thermal = columns.len() > before;
    for (number, &element) in (1..).zip(&watched.elements) {
        let stretch = |dashpot| simulation.viscous_stretch(element, dashpot).ok();
        let stretches: Vec<f64> = (0..).map_while(stretch).collect();
        if let [gamma] = stretches[..] {
            columns.push((format!("gamma_{number}"), gamma));
            continue;
        }
        for (dashpot, gamma) in (1..).zip(stretches) {
            columns.push((format!("gamma_{number}_{dashpot}"), gamma));
        }
    }
    is_thermal
}
