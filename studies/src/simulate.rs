//! Stepping a simulation through its time grid while recording what the CSV files hold.

use std::error::Error;
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use eem::prelude::*;

use super::progress::Progress;
use super::record::{Outcome, Record};
use super::time_grid::TimeGrid;

/// Columns: their name, to which vectors append `_x`, `_y`, `_z`, and what they hold.
type Columns<const D: usize> = Vec<(String, Quantity<D>)>;

/// A column of an example's own.
pub type Further<const D: usize> = (&'static str, Quantity<D>);

/// What is recorded of a scene; columns are numbered in this order, from 1.
#[derive(Clone, Debug, Default)]
pub struct Watched {
    /// Masses whose position and momentum are recorded.
    pub masses: Vec<Node>,
    /// Elements whose temperature and viscous stretches are recorded, as far as they have any.
    pub elements: Vec<Element>,
    /// Whether the scene has reservoirs; the entropy that all have received is recorded.
    pub has_reservoirs: bool,
}

/// Steps through the time grid, or up to the first step that fails, and records the initial and
/// the grid's states under the name `name`.
///
/// # Errors
///
/// When a handle does not belong to the scene. A failed step is an outcome, not an error.
pub fn record<const D: usize>(
    name: &str,
    simulation: &mut Simulation<D>,
    watched: &Watched,
    grid: TimeGrid,
) -> Result<Record, Box<dyn Error>> {
    record_with(name, simulation, watched, grid, [])
}

/// The same, with further columns of the example's own.
///
/// # Errors
///
/// When a handle does not belong to the scene.
pub fn record_with<const D: usize>(
    name: &str,
    simulation: &mut Simulation<D>,
    watched: &Watched,
    grid: TimeGrid,
    further: impl IntoIterator<Item = Further<D>>,
) -> Result<Record, Box<dyn Error>> {
    let mut columns = columns(simulation, watched);
    let further = further.into_iter();
    columns.extend(further.map(|(name, quantity)| (name.to_owned(), quantity)));
    columns.push(("newton_iterations".to_owned(), Quantity::NewtonIterations));
    let mut recorder = Recorder::new(simulation, columns)?.every(grid.stride);
    recorder.reserve(grid.steps / grid.stride);
    let mut progress = Progress::new(name, grid.steps);
    let (mut outcome, mut elapsed) = (Outcome::Completed, Duration::ZERO);
    for step in 1..=grid.steps {
        let start = Instant::now();
        let result = simulation.step();
        elapsed += start.elapsed();
        match result {
            Ok(report) => {
                let ControlFlow::Continue(()) = recorder.observe(simulation, &report) else {
                    break;
                };
            }
            Err(error) => {
                outcome = failure(&error);
                break;
            }
        }
        progress.advance(step);
    }
    Ok(Record::of(name, &recorder, outcome, elapsed))
}

fn failure(error: &StepError) -> Outcome {
    let iterations = error.history.len();
    Outcome::Failed {
        time: error.time,
        reason: format!("{} ({iterations} iterations)", error.failure),
    }
}

/// `q1`, …, `p1`, …, `theta_1`, …, `gamma_1`, …, `reservoir_entropy`, `energy`, `entropy`,
/// `angular_momentum`, as far as the scene has them.
fn columns<const D: usize>(simulation: &Simulation<D>, watched: &Watched) -> Columns<D> {
    let nodes = || (1..).zip(watched.masses.iter().copied());
    let positions = nodes().map(|(i, mass)| (format!("q{i}"), Quantity::Position(mass)));
    let momenta = nodes().map(|(i, mass)| (format!("p{i}"), Quantity::Momentum(mass)));
    let mut columns: Columns<D> = positions.chain(momenta).collect();
    let elements = || (1..).zip(watched.elements.iter().copied());
    let thermal = elements().filter(|&(_, element)| simulation.temperature(element).is_ok());
    let temperature = |(i, element)| (format!("theta_{i}"), Quantity::Temperature(element));
    let before = columns.len();
    columns.extend(thermal.map(temperature));
    let has_entropy = columns.len() > before;
    for (i, element) in elements() {
        columns.extend(dashpots(simulation, i, element));
    }
    if watched.has_reservoirs {
        let received = Quantity::Ledger(|ledger| ledger.reservoir_entropy);
        columns.push(("reservoir_entropy".to_owned(), received));
    }
    columns.push(("energy".to_owned(), Quantity::TotalEnergy));
    if has_entropy {
        columns.push(("entropy".to_owned(), Quantity::TotalEntropy));
    }
    if D > 1 {
        columns.push(("angular_momentum".to_owned(), Quantity::AngularMomentum));
    }
    columns
}

/// `gamma_1`, or `gamma_1_1`, `gamma_1_2`, … of an element with several dashpots.
fn dashpots<const D: usize>(
    simulation: &Simulation<D>,
    number: usize,
    element: Element,
) -> Columns<D> {
    let stretch = |dashpot| simulation.viscous_stretch(element, dashpot).ok();
    let stretches: Vec<f64> = (0..).map_while(stretch).collect();
    let count = stretches.len();
    let column = |dashpot| {
        let name = if count == 1 {
            format!("gamma_{number}")
        } else {
            format!("gamma_{number}_{}", dashpot + 1)
        };
        (name, Quantity::ViscousStretch(element, dashpot))
    };
    (0..count).map(column).collect()
}
