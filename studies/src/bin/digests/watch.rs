//! Runs a scene as it is to be run, and digests how it ends.

use eem::MemberFailure;
use eem::prelude::*;
use eem_studies::build::{Build, Handles};
use xxhash_rust::xxh3::xxh3_64;

/// How a scene is run.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Drive {
    /// So many steps.
    Steps(usize),
    /// So many steps under control, with a relative tolerance.
    Controlled(f64, usize),
    /// Until the first coordinate of the last node changes its sign, until a time (s) at the latest.
    Event(f64),
}

/// A scene.
pub(crate) trait Case<const D: usize>: Copy + Sync {
    fn build(self) -> Build<D>;
}

/// How a run ended.
pub(crate) struct Seen {
    pub(crate) steps: usize,
    pub(crate) iterations: usize,
    /// The name of the error that ended it, if one did.
    pub(crate) error: String,
    /// Of the last state.
    pub(crate) digest: u64,
}

/// The name of an error, without what it says.
pub(crate) fn name_of(error: &impl core::fmt::Debug) -> String {
    let text = format!("{error:?}");
    let name = text.split(|letter: char| !letter.is_alphanumeric());
    name.take(1).collect()
}

/// A digest of numbers, which tells all of them apart.
pub(crate) fn digest(numbers: impl Iterator<Item = u64>) -> u64 {
    xxh3_64(&numbers.flat_map(u64::to_le_bytes).collect::<Vec<_>>())
}

/// All numbers of the present state, and of its ledger.
fn numbers<const D: usize>(run: &Simulation<D>, handles: &Handles) -> Vec<f64> {
    let mut numbers = vec![run.time(), run.step_size()];
    for &node in &handles.nodes {
        let vectors = [run.position(node), run.momentum(node), run.velocity(node)];
        numbers.extend(vectors.iter().flatten().flat_map(|vector| vector.iter()));
    }
    for &element in &handles.elements {
        let values = [
            run.force(element),
            run.internal_energy(element),
            run.temperature(element),
            run.entropy(element),
            run.entropy_production(element),
            run.viscous_stretch(element, 0),
            run.viscous_stretch(element, 1),
        ];
        numbers.extend(values.into_iter().flatten());
    }
    let reservoirs = handles.reservoirs.iter();
    numbers.extend(reservoirs.flat_map(|&reservoir| run.reservoir_entropy(reservoir)));
    let ledger = run.ledger();
    numbers.extend([
        ledger.kinetic_energy,
        ledger.potential_energy,
        ledger.internal_energy,
        ledger.reservoir_heat,
        ledger.lost_heat,
        ledger.energy,
        ledger.work,
        ledger.heat,
        ledger.balance,
        ledger.element_entropy,
        ledger.element_entropy_of_state,
        ledger.reservoir_entropy,
        ledger.thermostat_entropy,
        ledger.entropy,
    ]);
    numbers.extend(ledger.linear_momentum.iter());
    numbers.extend(ledger.angular_momentum.iter());
    numbers
}

/// Steps a simulation; how many steps and iterations were made is counted also if one fails.
fn drive<const D: usize>(
    run: &mut Simulation<D>,
    drive: Drive,
    last: Option<Node>,
    [steps, iterations]: [&mut usize; 2],
) -> Result<(), MemberFailure> {
    let mut count = |report: &StepReport| {
        *steps += 1;
        *iterations += report.iterations;
    };
    match (drive, last) {
        (Drive::Event(end), Some(node)) => {
            let mut events = [Event::crossing(move |run: &Simulation<D>| {
                Ok(run.position(node)?[0])
            })];
            run.run_until_event_with(end, &mut events, |_, report| {
                count(report);
                ControlFlow::Continue(())
            })?;
        }
        (Drive::Steps(steps) | Drive::Controlled(_, steps), _) => {
            if let Drive::Controlled(tolerance, _) = drive {
                run.control_steps(Tolerance::new(tolerance))?;
            }
            for _ in 0..steps {
                count(&run.step()?);
            }
        }
        (Drive::Event(_), None) => {}
    }
    Ok(())
}

/// Runs a scene; how it ended.
pub(crate) fn watch<const D: usize>(
    run: &mut Simulation<D>,
    handles: &Handles,
    how: Drive,
) -> Seen {
    let (mut steps, mut iterations) = (0, 0);
    let last = handles.nodes.last().copied();
    let error = match drive(run, how, last, [&mut steps, &mut iterations]) {
        Ok(()) => String::new(),
        Err(MemberFailure::Step(error)) => name_of(&error.failure),
        Err(MemberFailure::Scene(error)) => name_of(&error),
        Err(other) => name_of(&other),
    };
    let numbers = numbers(run, handles);
    Seen {
        steps,
        iterations,
        error,
        digest: digest(numbers.iter().map(|number| number.to_bits())),
    }
}
