//! The balance sheet: what the tractions gave and what became of it, and the laws that it must keep.

use super::scene::{LOADED, RUBBER, VOLUME};
use eem_studies::claims::Claims;
use eem_studies::record::Record;
use eem_studies::statistics::{Statistics, momentum_change};
use eem_studies::{table, terminal};

/// What rounding may do to E − W, relative to the heat c θ of the block, the largest term in it. The state
/// is kept to twice the working precision and Newton's method goes on to the rounding of its residual, so that
/// the defect hardly grows with their number. Evaluating E from θ costs a dozen roundings of ε/2 at each of the 32 points,
/// whose signs differ: half an ε of the whole, for each of two states.
const ENERGY_DEFECT: f64 = f64::EPSILON;

/// What rounding may do to J, kg m²/s: evaluating it from the state costs some dozen ε/2 of its terms, less
/// than 1e4 kg m²/s; Newton's method leaves less than the second number in a step, seen after 1000 steps.
const MOMENTUM_DEFECT: f64 = 1e-10;
const MOMENTUM_DRIFT: f64 = 1e-13;

/// What rounding may take from S in a step, in units in its last place.
const ENTROPY_LOSS: f64 = 2.0;

/// What was given and what became of it, a row per scheme.
pub(crate) fn print(runs: &[Record]) {
    let heads = [
        "scheme",
        "outcome",
        "W (J)",
        "kinetic (J)",
        "off by (J)",
        "least ΔS (J/K)",
        "ΔJ (kg m²/s)",
        "θ (K)",
        "Newton/step",
        "ms/step",
    ];
    table::print(heads, runs, row);
    terminal::say(format_args!(
        "W: work of the tractions; W, kinetic energy and least and largest temperature at the end.\n\
         Off by: the energy, max |E − E₀ − W| over the run. ΔJ: max |J − J(t₀)| after t₀ = {LOADED} s,\n\
         when the tractions have ended."
    ));
}

fn row(run: &Record) -> [String; 10] {
    let figures = Statistics::of(run);
    let range = ["temperature_min", "temperature_max"];
    let [least, most] = range.map(|name| table::last(run, name, |theta| format!("{theta:.2}")));
    let time = figures.time_per_step.map(|time| time.as_secs_f64());
    [
        run.scheme.clone(),
        table::outcome(run),
        table::last(run, "work", |work| format!("{work:.3}")),
        table::last(run, "kinetic", |kinetic| format!("{kinetic:.3}")),
        table::first_law_defect(run),
        table::scientific(figures.entropy_increment),
        table::scientific(momentum_change(run, LOADED)),
        format!("{least} … {most}"),
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
    let warmest = run.column("temperature_max").unwrap_or_default();
    let warmest = warmest.iter().copied().fold(0.0, f64::max);
    claims.keeps_the_first_law(run, ENERGY_DEFECT * RUBBER.capacity * VOLUME * warmest);
    claims.loses_no_entropy(run, ENTROPY_LOSS);
    if let Some(defect) = momentum_change(run, LOADED) {
        let steps = u32::try_from(run.steps()).map_or(f64::INFINITY, f64::from);
        claims.at_most(
            &format!("{scheme}: the change of angular momentum after {LOADED} s (kg m²/s)"),
            Some(defect),
            MOMENTUM_DEFECT.max(MOMENTUM_DRIFT * steps),
        );
    }
}
