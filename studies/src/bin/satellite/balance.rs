//! The balance sheet: what the rockets gave and what became of it, and the laws that it must keep.

use eem::Scheme;

use super::scene::{FIRED, STOP};
use super::{ATTITUDE, Case};
use eem_studies::claims::Claims;
use eem_studies::first_law;
use eem_studies::record::Record;
use eem_studies::statistics::{Statistics, TIME_TOLERANCE, momentum_change};
use eem_studies::{table, terminal};

/// What the exact schemes may be off by: energy, J, and angular momentum between the firings, relative to itself.
const ENERGY_DEFECT: f64 = 1e-10;
const MOMENTUM_DEFECT: f64 = 1e-14;

/// By how much other schemes are off at the end, if they reach it, J.
const PLAINLY_OFF: f64 = 10.0;

/// The steps for which all this is claimed, s, and how long a run has to be for the failures to show.
const STEPS: [f64; 2] = [0.1, 0.2];
const LONG: f64 = 60.0;

/// What was given and what became of it, a row per scheme.
pub(crate) fn print(runs: &[Record]) {
    let heads = [
        "scheme",
        "outcome",
        "turn (°)",
        "W (J)",
        "kinetic (J)",
        "off by (J)",
        "least ΔS (J/K)",
        "ΔJ/J",
        "Newton/step",
        "ms/iteration",
    ];
    table::print(heads, runs, row);
    terminal::say(format_args!(
        "W: work of the rockets; turn, W and kinetic energy at the end. Off by: the energy,\n\
         max |E − E₀ − W| over the run. ΔJ: max |J − J(t₀)| from the first firing to the second."
    ));
}

fn row(run: &Record) -> [String; 10] {
    let figures = Statistics::of(run);
    let time = figures.time_per_step.map(|time| time.as_secs_f64());
    let per_iteration = time.zip(figures.newton_iterations);
    [
        run.scheme.clone(),
        table::outcome(run),
        table::last(run, ATTITUDE, |turn| format!("{turn:.2}")),
        table::last(run, "work", |work| format!("{work:.6}")),
        table::last(run, "kinetic", |kinetic| format!("{kinetic:.5}")),
        table::first_law_defect(run),
        table::scientific(figures.entropy_increment),
        table::scientific(momentum_defect(run)),
        table::cell(figures.newton_iterations, |mean| format!("{mean:.2}")),
        table::cell(
            per_iteration.map(|(time, iterations)| time / iterations),
            |time| format!("{:.2}", 1e3 * time),
        ),
    ]
}

/// max |J − J(t₀)|/|J(t₀)| between the firings; `None` when no step was made then.
fn momentum_defect(run: &Record) -> Option<f64> {
    let drifting = run.until(STOP[0] + TIME_TOLERANCE);
    let change = momentum_change(&drifting, FIRED)?;
    let (_, size) = drifting.norms("angular_momentum_").pop()?;
    Some(change / size)
}

/// The first and the second law, for a run to the end.
pub(crate) fn keeps_both_laws(run: &Record, claims: &mut Claims) {
    claims.reaches_the_end(run);
    claims.keeps_the_first_law(run, ENERGY_DEFECT);
    claims.at_least(
        &format!("{}: the smallest entropy increment (J/K)", run.scheme),
        Statistics::of(run).entropy_increment,
        0.0,
    );
}

/// The laws, for the schemes that promise them, and that others break them.
pub(crate) fn check(run: &Record, case: Case, claims: &mut Claims) {
    let is_claimed = STEPS
        .iter()
        .any(|step| (step - case.step).abs() <= TIME_TOLERANCE);
    if !is_claimed {
        return;
    }
    let scheme = &run.scheme;
    if scheme.starts_with("eem-") {
        keeps_both_laws(run, claims);
        if let Some(defect) = momentum_defect(run) {
            claims.at_most(
                &format!("{scheme}: the relative change of angular momentum between the firings"),
                Some(defect),
                MOMENTUM_DEFECT,
            );
        }
    }
    let others = [Scheme::Midpoint, Scheme::Trapezoidal].map(Scheme::name);
    if others.contains(&scheme.as_str()) && (!run.completed() || run.end() >= LONG) {
        let is_off = first_law::defects(run).any(|defect| defect > PLAINLY_OFF);
        claims.holds(
            !run.completed() || is_off,
            format!("{scheme} reaches the end and is off by less than {PLAINLY_OFF} J"),
        );
    }
}
