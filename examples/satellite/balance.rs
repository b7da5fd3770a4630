//! The balance sheet: what the rockets gave and what became of it, and the laws that it must keep.

use comfy_table::{Table, presets};
use eem::Scheme;

use super::scene::{FIRED, STOP};
use super::support::claims::Claims;
use super::support::first_law;
use super::support::record::{Outcome, Record};
use super::support::statistics::{Statistics, TIME_TOLERANCE, largest, momentum_change};
use super::support::terminal;
use super::{ATTITUDE, Case};

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
    let mut table = Table::new();
    table.load_style(presets::ASCII_MARKDOWN).set_header([
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
    terminal::say(format_args!(
        "W: work of the rockets; turn, W and kinetic energy at the end. Off by: the energy,\n\
         max |E − E₀ − W| over the run. ΔJ: max |J − J(t₀)| from the first firing to the second."
    ));
}

fn row(run: &Record) -> [String; 10] {
    let figures = Statistics::of(run);
    let last = |name| run.column(name).and_then(|values| values.last().copied());
    let cell = |value: Option<f64>, format: fn(f64) -> String| value.map_or("–".into(), format);
    let outcome = match run.outcome {
        Outcome::Completed => "completed".to_owned(),
        Outcome::Failed { time, .. } => format!("failed at {time:.1} s"),
    };
    let time = figures.time_per_step.map(|time| time.as_secs_f64());
    let per_iteration = time.zip(figures.newton_iterations);
    [
        run.scheme.clone(),
        outcome,
        cell(last(ATTITUDE), |turn| format!("{turn:.2}")),
        cell(last("work"), |work| format!("{work:.6}")),
        cell(last("kinetic"), |kinetic| format!("{kinetic:.5}")),
        cell(largest(first_law::defects(run)), |defect| {
            format!("{defect:.1e}")
        }),
        cell(figures.entropy_increment, |least| format!("{least:.1e}")),
        cell(momentum_defect(run), |defect| format!("{defect:.1e}")),
        cell(figures.newton_iterations, |mean| format!("{mean:.2}")),
        cell(
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
        claims.holds(
            run.completed(),
            format!("{scheme} does not reach the end time"),
        );
        claims.at_most(
            &format!("{scheme}: the defect of the energy (J)"),
            largest(first_law::defects(run)),
            ENERGY_DEFECT,
        );
        claims.at_least(
            &format!("{scheme}: the smallest entropy increment (J/K)"),
            Statistics::of(run).entropy_increment,
            0.0,
        );
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
