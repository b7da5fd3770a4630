//! The answer on the terminal: truth, start and fit of every unknown, and how well they are known.

use eem::nalgebra::Matrix3;

use super::confidence::{Bootstrap, deviations};
use super::drive::{Drive, Logs, UNKNOWNS};
use super::fit::{Data, Fit};
use super::recording::{Recording, TEMPERATURE_NOISE};
use super::survey::{Sample, Survey};
use eem_studies::table;
use eem_studies::terminal::say;

/// Standard deviations of the normal distribution between which 95 % of it lies.
const NINETY_FIVE: f64 = 1.959_963_985;

/// What was recorded.
pub(crate) fn print_recording(truth: &Drive, recording: &Recording, end: f64) {
    let states = recording.travel.len();
    say(format_args!(
        "Recorded: {states} displacements with noise of {:.3} mm and {states} temperatures with noise of \
         {TEMPERATURE_NOISE} K in {end} s; the damper warms by {:.1} K.",
        1e3 * recording.travel_noise,
        rise(truth)
    ));
}

/// How much warmer the damper is at the end than at first, K.
fn rise(drive: &Drive) -> f64 {
    let [Some(first), Some(last)] = [drive.temperature.first(), drive.temperature.last()] else {
        return 0.0;
    };
    last - first
}

/// What the sweep has found.
pub(crate) fn print_survey(survey: &Survey, recording: &Recording) {
    let values = |of: fn(f64, f64) -> f64| {
        let misfits = survey.samples.iter().map(|sample| sample.misfit);
        misfits.reduce(of).unwrap_or(f64::NAN) / super::freedom(recording)
    };
    say(format_args!(
        "Sweep: {} members, χ²/(n − 3) from {:.1} to {:.0}; the best one is the start of the fit.",
        survey.samples.len(),
        values(f64::min),
        values(f64::max),
    ));
}

/// A row per unknown.
pub(crate) fn print(
    start: &Sample,
    fit: &Fit,
    covariance: &Matrix3<f64>,
    bootstrap: &Bootstrap,
    data: Data<'_>,
) {
    say(format_args!(
        "Fit: χ²/(n − 3) = {:.4}, n = {}, after {} steps with {} runs in all; {} fits of fresh noise, {} \
         runs.\n",
        fit.misfit / super::freedom(data.recording),
        data.recording.len(),
        fit.steps,
        fit.points,
        bootstrap.estimates.len(),
        bootstrap.points,
    ));
    let (linear, sampled) = (deviations(covariance), bootstrap.deviations());
    let mut table = table::headed([
        "unknown",
        "truth",
        "start",
        "fit",
        "95 % interval",
        "σ, linear",
        "σ, fresh noise",
        "off the truth",
    ]);
    for (i, unknown) in UNKNOWNS.iter().enumerate() {
        let at = |deviations: f64| (fit.point.logs[i] + deviations * sampled[i]).exp();
        table.add_row([
            unknown.label.to_owned(),
            number(unknown.truth),
            number(start.logs[i].exp()),
            number(at(0.0)),
            format!("{} – {}", number(at(-NINETY_FIVE)), number(at(NINETY_FIVE))),
            percent(linear[i]),
            percent(sampled[i]),
            format!(
                "{:+.2} σ",
                (fit.point.logs[i] - unknown.truth.ln()) / linear[i]
            ),
        ]);
    }
    say(format_args!("{table}\n"));
    let [mount, eta0, capacity] = linear;
    say(format_args!(
        "Intervals: 1.96 σ of fresh noise to both sides. σ, linear: of (JᵀJ)⁻¹, whose correlations are {:+.2} (μ, η0), \
         {:+.2} (η0, c) and {:+.2} (μ, c).",
        covariance[(0, 1)] / (mount * eta0),
        covariance[(1, 2)] / (eta0 * capacity),
        covariance[(0, 2)] / (mount * capacity),
    ));
}

/// The largest of some standard deviations.
pub(crate) fn largest(deviations: &Logs) -> f64 {
    deviations.iter().copied().fold(0.0, f64::max)
}

/// Five digits.
fn number(value: f64) -> String {
    let digits = if value < 1e3 {
        2
    } else {
        usize::from(value < 1e4)
    };
    format!("{value:.digits$}")
}

/// A change of a logarithm.
fn percent(value: f64) -> String {
    format!("{:.3} %", 100.0 * value)
}
