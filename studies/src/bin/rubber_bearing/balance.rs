//! The balance sheet: what the plate gave and what became of it, and the laws that it must keep.

use super::cycles;
use super::scene::{RUBBER, TEMPERATURE, VOLUME};
use eem_studies::claims::Claims;
use eem_studies::record::Record;
use eem_studies::statistics::Statistics;
use eem_studies::{table, terminal};

/// What rounding may do to E − W, relative to the heat c θ of the rubber, the largest term in it: evaluating E from
/// θ costs a dozen roundings of ε/2 at each of the 144 points, whose signs differ: half an ε of the whole, for each
/// of two states.
const ENERGY_DEFECT: f64 = f64::EPSILON;

/// What rounding may take from S in a step, in units in its last place.
const ENTROPY_LOSS: f64 = 2.0;

/// What was given and what became of it, a row per scheme.
pub(crate) fn print(runs: &[Record]) {
    let heads = [
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
    ];
    table::print(heads, runs, row);
    terminal::say(
        "W: work of the plate, over the run, and in the third and the last cycle, as are stress and\n\
         temperature. Off by: the energy, max |E − E₀ − W| over the run.",
    );
}

fn row(run: &Record) -> [String; 10] {
    let figures = Statistics::of(run);
    let cycles = cycles::all(run);
    let ends = |of: fn(&cycles::Cycle) -> String| match (cycles.first(), cycles.last()) {
        (Some(first), Some(last)) => format!("{} … {}", of(first), of(last)),
        _ => "–".to_owned(),
    };
    let time = figures.time_per_step.map(|time| time.as_secs_f64());
    [
        run.scheme.clone(),
        table::outcome(run),
        table::last(run, "work", |work| format!("{work:.1}")),
        table::first_law_defect(run),
        table::scientific(figures.entropy_increment),
        ends(|cycle| format!("{:.0}", cycle.work)),
        ends(|cycle| format!("{:.1}", 1e-3 * cycle.stress)),
        ends(|cycle| format!("{:.2}", cycle.temperature)),
        table::cell(figures.newton_iterations, |mean| format!("{mean:.2}")),
        table::cell(time, |time| format!("{:.2}", 1e3 * time)),
    ]
}

/// The laws, for the schemes that promise them.
pub(crate) fn check(run: &Record, claims: &mut Claims) {
    let scheme = &run.scheme;
    if !scheme.starts_with("eem-") {
        return;
    }
    claims.reaches_the_end(run);
    claims.keeps_the_first_law(run, ENERGY_DEFECT * RUBBER.capacity * VOLUME * TEMPERATURE);
    claims.loses_no_entropy(run, ENTROPY_LOSS);
}
