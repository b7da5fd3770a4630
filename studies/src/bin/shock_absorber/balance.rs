//! The ledger: what the road gave and what became of it, and the laws that it must keep.

use super::car::{BODY, CLEARANCE, DAMPER, GRAVITY, TRACK, TYRE};
use eem_studies::claims::Claims;
use eem_studies::record::Record;
use eem_studies::statistics::{Statistics, largest};
use eem_studies::{table, terminal};

/// What rounding may do to E − work − heat, relative to the largest term in it, c θ: evaluating E from θ costs
/// a few roundings of ε/2.
const BALANCE_DEFECT: f64 = 2.0 * f64::EPSILON;

/// What one step may leave of it, J: four roundings of the energy `fλ` of the strut below the resting body. Those
/// of N steps that know nothing of each other add up to √N of one.
const STEP_DEFECT: f64 = 4.0 * 0.5 * f64::EPSILON * BODY * GRAVITY * CLEARANCE;

/// Roundings that are alike in every step, relative to the work that becomes heat: those of the weights of a
/// scheme of higher order, for one.
const WORK_DEFECT: f64 = 8.0 * f64::EPSILON;

/// What rounding may take from S in a step, J/K: two units in the last place, |S| < 128 J/K.
const ENTROPY_LOSS: f64 = 2.0 * 64.0 * f64::EPSILON;

/// What was given and what became of it, a row per scheme.
pub(crate) fn print(runs: &[Record]) {
    let heads = [
        "scheme",
        "work of the road (J)",
        "heat to the air (J)",
        "balance defect (J)",
        "least ΔS (J/K)",
        "Newton/step",
        "µs/step",
    ];
    table::print(heads, runs, row);
    terminal::say("Balance: B = E − work − heat; its defect is max |B − B₀| over the drive.");
    if let Some(power) = mean_power(&runs[0]) {
        let expected = TRACK.power(TYRE);
        terminal::say(format_args!(
            "The road gives {power:.0} W, a road of all wavelengths {expected:.0} W, thick oil or thin."
        ));
    }
}

fn row(run: &Record) -> [String; 7] {
    let figures = Statistics::of(run);
    let time = figures.time_per_step.map(|time| time.as_secs_f64());
    [
        run.scheme.clone(),
        table::last(run, "work", |work| format!("{work:.3}")),
        table::last(run, "reservoir_heat", |heat| format!("{heat:.3}")),
        table::scientific(defect(run)),
        table::scientific(figures.entropy_increment),
        table::cell(figures.newton_iterations, |mean| format!("{mean:.2}")),
        table::cell(time, |time| format!("{:.1}", 1e6 * time)),
    ]
}

/// max |B − B₀|, J.
pub(crate) fn defect(run: &Record) -> Option<f64> {
    let balance = run.column("balance")?;
    largest(balance.iter().map(|value| (value - balance[0]).abs()))
}

/// The two laws of thermodynamics, for the schemes that promise them.
pub(crate) fn check(run: &Record, claims: &mut Claims) {
    let scheme = &run.scheme;
    if !scheme.starts_with("eem-") {
        return;
    }
    claims.reaches_the_end(run);
    let temperatures = run.column("theta_1").unwrap_or_default();
    let heat = DAMPER.capacity * temperatures.iter().copied().fold(0.0, f64::max);
    #[expect(clippy::cast_precision_loss, reason = "a number of steps")]
    let steps = run.column("balance").map_or(0, <[f64]>::len) as f64;
    let work = run.column("work").and_then(<[f64]>::last).copied();
    let work = work.unwrap_or_default().abs();
    claims.at_most(
        &format!("{scheme}: the defect of the balance (J)"),
        defect(run),
        BALANCE_DEFECT * heat + STEP_DEFECT * steps.sqrt() + WORK_DEFECT * work,
    );
    claims.at_least(
        &format!("{scheme}: the smallest entropy increment (J/K)"),
        Statistics::of(run).entropy_increment,
        -ENTROPY_LOSS,
    );
}

/// Mean power of the road, W; `None` before the first lap is full, while the car still gathers
/// energy.
pub(crate) fn mean_power(run: &Record) -> Option<f64> {
    let (time, work) = (*run.column("time")?.last()?, *run.column("work")?.last()?);
    (time >= TRACK.lap_time()).then_some(work / time)
}
