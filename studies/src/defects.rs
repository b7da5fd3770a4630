//! The comparison on the terminal: the defects of every scheme in the laws, and why runs failed below them.

use std::time::Duration;

use super::record::{Outcome, Record};
use super::statistics::{self, BREAKDOWN, Statistics, TIME_TOLERANCE};
use super::table::{self, cell, scientific};
use super::terminal;

/// Column heads, with units where there are any; the last needs a reference.
const HEADS: [&str; 8] = [
    "scheme",
    "outcome",
    "energy defect",
    "least ΔS (J/K)",
    "ang. mom. defect",
    "Newton/step",
    "µs/step",
    "error of q",
];

/// What the heads mean.
const DEFECTS: &str = "Defects are max |X − X₀|/|X₀| over the run";
const ERRORS: &str = "the error of q is its root mean square over";

/// Prints a row per record and, below, the reasons of failed runs and what the heads mean. Positions
/// are compared as long as the reference runs.
pub fn print(records: &[Record], reference: Option<&Record>) {
    let columns = HEADS.len() - usize::from(reference.is_none());
    let mut table = table::headed(HEADS.into_iter().take(columns));
    for record in records {
        table.add_row(row(record, reference).into_iter().take(columns));
    }
    terminal::say(format_args!("{table}\n"));
    for record in records {
        explain(record);
    }
    match reference {
        Some(reference) => {
            let times = compared(records, reference);
            terminal::say(format_args!(
                "{DEFECTS}; {ERRORS} {times}, relative to the reference."
            ));
        }
        None => terminal::say(format_args!("{DEFECTS}.")),
    }
}

/// The times over which positions are compared.
fn compared(records: &[Record], reference: &Record) -> String {
    let longest = records.iter().map(Record::end).fold(0.0, f64::max);
    let end = reference.end();
    if end < longest - TIME_TOLERANCE {
        format!("the first {end:.1} s")
    } else {
        "the run".to_owned()
    }
}

/// Says when and why a run broke down.
fn explain(record: &Record) {
    let scheme = &record.scheme;
    if let Some(time) = Statistics::of(record).breakdown {
        let percent = 100.0 * BREAKDOWN;
        terminal::say(format_args!(
            "{scheme}: the energy is off by more than {percent} % for the first time at t = {time:.6} s."
        ));
    }
    table::say_failure(record);
}

fn row(record: &Record, reference: Option<&Record>) -> Vec<String> {
    let figures = Statistics::of(record);
    let error = reference.and_then(|exact| statistics::position_error(record, exact));
    vec![
        record.scheme.clone(),
        outcome(record, figures.breakdown),
        scientific(figures.energy_defect),
        scientific(figures.entropy_increment),
        scientific(figures.angular_momentum_defect),
        cell(figures.newton_iterations, |mean| format!("{mean:.2}")),
        cell(figures.time_per_step, microseconds),
        scientific(error),
    ]
}

/// How a run ended, or when its energy was plainly wrong.
fn outcome(record: &Record, breakdown: Option<f64>) -> String {
    match (&record.outcome, breakdown) {
        (Outcome::Completed, Some(time)) => format!("energy off at {time:.1} s"),
        _ => table::outcome(record),
    }
}

fn microseconds(duration: Duration) -> String {
    format!("{:.1}", duration.as_secs_f64() * 1e6)
}
