//! The balance sheet: what the plate gave and what became of it, and the laws that it must keep.

use comfy_table::{Table, presets};

use super::cycles;
use super::scene::{RUBBER, TEMPERATURE, VOLUME};
use super::support::claims::Claims;
use super::support::first_law;
use super::support::record::{Outcome, Record};
use super::support::statistics::{Statistics, largest};
use super::support::terminal;

/// What rounding may do to E − W, relative to the heat c θ of the rubber, the largest term in it: evaluating E from
/// θ costs a dozen roundings of ε/2 at each of the 144 points, whose signs differ: half an ε of the whole, for each
/// of two states.
const ENERGY_DEFECT: f64 = f64::EPSILON;

/// What rounding may take from S in a step, in units in its last place.
const ENTROPY_LOSS: f64 = 2.0;

/// What was given and what became of it, a row per scheme.
pub(crate) fn print(runs: &[Record]) {
    let mut table = Table::new();
    table.load_style(presets::ASCII_MARKDOWN).set_header([
        "scheme",
        "outcome",
        "W (J)",
        "off by (J)",
        "least ΔS (J/K)",
        "W of cycles (J)",
        "largest shear (kPa)",
        "mean θ (K)",
        "Newton/step",
        "ms/step",
    ]);
    for run in runs {
        table.add_row(row(run));
    }
    terminal::say(format_args!("{table}\n"));
    for run in runs {
        if let Outcome::Failed { time, reason } = &run.outcome {
            let scheme = &run.scheme;
            terminal::say(format_args!(
                "{scheme} failed after t = {time:.6} s: {reason}"
            ));
        }
    }
    terminal::say(
        "W: work of the plate, over the run, and in the third and the last cycle, as are stress and\n\
         temperature. Off by: the energy, max |E − E₀ − W| over the run.",
    );
}

fn row(run: &Record) -> [String; 10] {
    let figures = Statistics::of(run);
    let last = |name| run.column(name).and_then(|values| values.last().copied());
    let cell = |value: Option<f64>, format: fn(f64) -> String| value.map_or("–".into(), format);
    let outcome = match run.outcome {
        Outcome::Completed => "completed".to_owned(),
        Outcome::Failed { time, .. } => format!("failed at {time:.1} s"),
    };
    let cycles = cycles::all(run);
    let ends = |of: fn(&cycles::Cycle) -> String| match (cycles.first(), cycles.last()) {
        (Some(first), Some(last)) => format!("{} … {}", of(first), of(last)),
        _ => "–".to_owned(),
    };
    let time = figures.time_per_step.map(|time| time.as_secs_f64());
    [
        run.scheme.clone(),
        outcome,
        cell(last("work"), |work| format!("{work:.1}")),
        cell(largest(first_law::defects(run)), |defect| {
            format!("{defect:.1e}")
        }),
        cell(figures.entropy_increment, |least| format!("{least:.1e}")),
        ends(|cycle| format!("{:.0}", cycle.work)),
        ends(|cycle| format!("{:.1}", 1e-3 * cycle.stress)),
        ends(|cycle| format!("{:.2}", cycle.temperature)),
        cell(figures.newton_iterations, |mean| format!("{mean:.2}")),
        cell(time, |time| format!("{:.2}", 1e3 * time)),
    ]
}

/// The laws, for the schemes that promise them.
pub(crate) fn check(run: &Record, claims: &mut Claims) {
    let scheme = &run.scheme;
    if !scheme.starts_with("eem-") {
        return;
    }
    claims.holds(
        run.completed(),
        format!("{scheme} does not reach the end time"),
    );
    claims.at_most(
        &format!("{scheme}: the defect of the energy (J)"),
        largest(first_law::defects(run)),
        ENERGY_DEFECT * RUBBER.capacity * VOLUME * TEMPERATURE,
    );
    claims.at_least(
        &format!("{scheme}: the smallest entropy increment (units in the last place)"),
        Statistics::of(run).entropy_increment_ulps,
        -ENTROPY_LOSS,
    );
}
