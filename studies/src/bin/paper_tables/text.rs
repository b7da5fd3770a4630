//! Numbers that the papers give in captions and in the text, beside ours.

use eem::{FreeEnergy, Scheme};

use super::examples::Runs;
use super::{double_pendulum, single_pendulum};
use eem_studies::record::{Outcome, Record};
use eem_studies::{statistics, table, terminal};

const HEADS: [&str; 4] = ["example", "number", "published", "ours"];

/// A number of a paper and ours, as text.
type Line = (u8, String, &'static str, String);

/// Prints the table; `stated` is the final entropy (J/K) of example 1 for `conductance` (W/K).
pub(crate) fn print(both: &[Runs; 2], conductance: f64, stated: Option<f64>) {
    let [single, double] = both;
    let mut lines = starts(single, double);
    if both.iter().all(Runs::is_as_published) {
        lines.extend(ends(single, double));
        let what = format!("S at the end for κ = {conductance} W/K, J/K");
        lines.push((1, what, "5.4613", number(stated, 4)));
        lines.extend(breakdowns(single, double));
    }
    lines.sort_by_key(|line| line.0);
    let mut table = table::headed(HEADS);
    for (example, what, published, ours) in lines {
        table.add_row([&example.to_string(), &what, published, &ours]);
    }
    terminal::say(format_args!("Numbers in captions and text\n\n{table}\n"));
}

/// What is known at t = 0.
fn starts(single: &Runs, double: &Runs) -> Vec<Line> {
    let first = |runs: &Runs, name: &str, decimals| {
        let column = runs.reference.column(name);
        number(column.and_then(|values| values.first().copied()), decimals)
    };
    let momentum = double.reference.norms("angular_momentum_");
    let momentum = momentum.first().map(|&(_, momentum)| momentum);
    let line = |example, what: &str, published, ours| (example, what.to_owned(), published, ours);
    vec![
        line(1, "E, J", "1704", first(single, "energy", 1)),
        line(1, "S at t = 0, J/K", "5.4258", first(single, "entropy", 4)),
        line(
            1,
            "smallest period, s",
            "0.086",
            format!("{:.3}", single_period()),
        ),
        line(2, "E, J", "4e5", first(double, "energy", 0)),
        line(2, "S at t = 0, J/K", "1183", first(double, "entropy", 0)),
        line(2, "|J|, kg m²/s", "71.6", number(momentum, 1)),
        line(
            2,
            "smallest period, s",
            "0.17",
            format!("{:.2}", double_period()),
        ),
    ]
}

/// What is known at the end.
fn ends(single: &Runs, double: &Runs) -> Vec<Line> {
    let last = |runs: &Runs, decimals| {
        let column = runs.reference.column("entropy");
        number(column.and_then(|values| values.last().copied()), decimals)
    };
    let what = "S at the end, J/K".to_owned();
    vec![
        (1, what.clone(), "5.4613", last(single, 4)),
        (2, what, "1222", last(double, 1)),
    ]
}

/// How the ordinary rules end: García Orden & Romero (2012) and Conde Martín et al. (2016).
fn breakdowns(single: &Runs, double: &Runs) -> Vec<Line> {
    let cases = [
        (single, Scheme::Midpoint, "blows up at 14 s"),
        (single, Scheme::Trapezoidal, "blows up at 15.7 s"),
        (double, Scheme::MidpointTemperature, "fails, unphysical"),
        (
            double,
            Scheme::TrapezoidalTemperature,
            "ends, but unphysical",
        ),
    ];
    let line = |(runs, scheme, published): (&Runs, Scheme, &'static str)| {
        let run = runs.of(scheme)?;
        let number = runs.example.number;
        Some((number, scheme.name().to_owned(), published, fate(run)))
    };
    cases.into_iter().filter_map(line).collect()
}

/// How a run goes wrong, and when.
fn fate(run: &Record) -> String {
    let lost = statistics::first_energy_beyond(run, statistics::BREAKDOWN).map(|row| run.time(row));
    let lost = lost.map(|time| format!("E off at {time:.1} s"));
    let failed = match &run.outcome {
        Outcome::Failed { time, .. } => Some(format!("Newton fails after {time:.1} s")),
        Outcome::Completed => None,
    };
    let parts: Vec<String> = lost.into_iter().chain(failed).collect();
    if parts.is_empty() {
        "reaches the end".to_owned()
    } else {
        parts.join(", ")
    }
}

/// The period (s) of small oscillations about the natural length at θr, dashpot and heat too slow to
/// follow: 2π √(m/k) with m = 1 kg.
fn single_period() -> f64 {
    let spring = single_pendulum::SPRING;
    let state = [spring.natural_length, 0.0, spring.theta_ref];
    let (_, hessian) = spring.hessian(&state);
    let adiabatic = hessian[0][0] - hessian[0][2] * hessian[2][0] / hessian[2][2];
    core::f64::consts::TAU / adiabatic.sqrt()
}

/// The smaller period (s) of small oscillations along the line of both springs, at their natural
/// lengths and the mean of the initial temperatures, heat too slow to follow.
///
/// ```text
/// ω⁴ − ((k₁ + k₂)/m₁ + k₂/m₂) ω² + k₁ k₂/(m₁ m₂) = 0
/// ```
fn double_period() -> f64 {
    let case = double_pendulum::LOG;
    let theta = f64::midpoint(case.temperatures[0], case.temperatures[1]);
    let [k1, k2] = case.springs.map(|spring| {
        let (_, hessian) = spring.hessian(&[spring.natural_length, theta]);
        hessian[0][0] - hessian[0][1] * hessian[1][0] / hessian[1][1]
    });
    let [m1, m2] = case.masses;
    let half = 0.5 * ((k1 + k2) / m1 + k2 / m2);
    let square = half + (half * half - k1 * k2 / (m1 * m2)).sqrt();
    core::f64::consts::TAU / square.sqrt()
}

/// A number, or a dash.
fn number(value: Option<f64>, decimals: usize) -> String {
    value.map_or_else(|| "–".to_owned(), |value| format!("{value:.decimals$}"))
}
