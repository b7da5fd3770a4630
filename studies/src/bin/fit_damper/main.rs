//! Stiffness, viscosity and heat capacity of a shock absorber, recovered from a recorded ride.
//!
//! The car is that of the example `shock_absorber`, with its equations, symbols and values. Two sensors record its
//! ride: the travel of the suspension, and the temperature of the damper. Three numbers of the damper are unknown:
//!
//! ```text
//! ψ = ½ μ (λ − λ0 − γ)² − F (θ/θr) (λ − λ0) + c (θ − θr − θ ln(θ/θr)),   η = η0 exp(a (1/θ − 1/θr))
//!
//! min χ²(x) = Σ ((z(tᵢ; x) − zᵢ)/σz)² + Σ ((θ(tᵢ; x) − θᵢ)/σθ)²,   x = (ln μ, ln η0, ln c)
//! ```
//!
//! | symbol | meaning | value |
//! |---|---|---|
//! | μ, η0, c | stiffness, viscosity and heat capacity that the recording is made with | 500 kN/m, 1500 N s/m, 500 J/K |
//! | zᵢ, σz | travel z = λ − λ0, its normal noise | 1 % of its root mean square about its mean |
//! | θᵢ, σθ | temperature, its normal noise | 0.5 K |
//! | tᵢ | times of recording | every 0.025 s of a ride of 30 s |
//!
//! A sweep ([`eem_sweep`]) looks over a box in which each unknown is off by a factor of 4.5 at most. Its best member
//! is the start of a fit; the optimiser asks for χ², its gradient Jᵀr and the matrix `JᵀJ` of Gauss and Newton, which
//! is a run with three tangents ([`sensitivities`](eem::Simulation::sensitivities)) at each point. The trust region with conjugate gradients in it
//! (Steihaug, SIAM J. Numer. Anal. 20 (1983) 626–637) is that of the crate `argmin`, which works on plain vectors:
//! `levenberg-marquardt` would compile an older `nalgebra` beside ours. The ellipse of confidence is the covariance
//! `(JᵀJ)⁻¹`; fits of fresh noise show whether it is right (the parametric bootstrap: Efron & Tibshirani, 1993, §6.5).
//!
//! The recording is made by the same scheme with the same step, so that errors of the step are no part of what is
//! found. What is shown is how much the noise leaves to be known.
//!
//! What the example claims, and fails without: every run keeps energy minus work minus heat constant to rounding,
//! and no step of any loses entropy; all fits converge. When the ride says something about all three unknowns: each
//! is found within three standard deviations, what the fit leaves is noise, and fits of fresh noise scatter as the
//! covariance says, within what so many of them can tell. The derivatives at the fit are those of differences of runs.
//!
//! All cores work at the sweep with `cargo run --release --features parallel -p eem-studies --bin fit_damper`.

use std::error::Error;
use std::path::PathBuf;
use std::process::ExitCode;

#[path = "../shock_absorber/car.rs"]
mod car;
mod confidence;
mod drive;
mod fit;
mod pictures;
mod recording;
mod report;
#[path = "../shock_absorber/road.rs"]
mod road;
mod survey;

use confidence::Bootstrap;
use drive::UNKNOWNS;
use eem_studies::claims::{self, Claims};
use eem_studies::command_line::{self, positive_seconds};
use eem_studies::time_grid::TimeGrid;
use eem_studies::{output, terminal};
use fit::{Data, Fit};
use pictures::Found;
use recording::Recording;
use survey::Survey;

const ABOUT: &str = "A shock absorber's damper, recovered from a recorded ride";
const HINT: &str = "Add --out DIR for pictures, tables and the sweep.";

/// Step, end and time between two records, s.
const STEP: f64 = 0.005;
const END: f64 = 30.0;
const SAMPLING: f64 = 0.025;

/// Members of the sweep, and fits of fresh noise; fewer without optimisation, where each takes many times as long.
const MEMBERS: usize = if cfg!(debug_assertions) { 24 } else { 96 };
const FITS: usize = if cfg!(debug_assertions) { 8 } else { 32 };

/// Any number would do; the same one draws the same noise.
const SEED: u64 = 2026;

/// An unknown whose standard deviation is larger than this share of itself is not known from the ride: its
/// distribution is not normal any more, and claims about intervals are not made.
const KNOWN: f64 = 0.1;

/// Options of this example.
#[derive(Clone, Debug, clap::Parser)]
struct Options {
    /// Members of the sweep.
    #[arg(long, value_name = "N", default_value_t = MEMBERS, value_parser = at_least_one)]
    members: usize,
    /// Fits of fresh noise, two at least.
    #[arg(long, value_name = "N", default_value_t = FITS, value_parser = at_least_two)]
    fits: usize,
    /// Time step, s.
    #[arg(long, value_name = "H", default_value_t = STEP, value_parser = positive_seconds)]
    step: f64,
    /// Length of the ride, s.
    #[arg(long, value_name = "T", default_value_t = END, value_parser = positive_seconds)]
    end: f64,
    /// Directory for pictures, tables and the sweep, whose members are not run again; created when missing.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

fn main() -> ExitCode {
    claims::verdict(run(&command_line::read(ABOUT)))
}

fn run(options: &Options) -> Result<Claims, Box<dyn Error>> {
    let grid = grid(options)?;
    let directory = options.out.as_deref();
    directory.map_or(Ok(()), output::prepare)?;

    let truth = drive::drive(grid, &[drive::truth()]).remove(0)?;
    let recording = Recording::of(&truth, recording::travel_noise(&truth), SEED);
    report::print_recording(&truth, &recording, grid.end());
    let survey = Survey::run(grid, &recording, options.members, directory)?;
    let start = survey
        .best()
        .ok_or("no member of the sweep reached the end")?;
    report::print_survey(&survey, &recording);

    let data = Data {
        grid,
        recording: &recording,
    };
    let fit = Fit::from(data, start.logs)?;
    let covariance = fit.point.covariance().ok_or("an unknown has no effect")?;
    let bootstrap = Bootstrap::run(data, &fit, options.fits)?;
    report::print(start, &fit, &covariance, &bootstrap, data);
    let found = Found {
        data,
        survey: &survey,
        fit: &fit,
        covariance: &covariance,
        bootstrap: &bootstrap,
    };
    match directory {
        Some(directory) => {
            found.write(directory)?;
            terminal::say(format_args!("Pictures and tables: {}", directory.display()));
        }
        None => terminal::say(HINT),
    }
    let mut claims = Claims::default();
    check_laws(&found, &mut claims);
    check_derivatives(&found, &mut claims)?;
    check_fit(&found, &mut claims);
    Ok(claims)
}

/// Steps to the end, of which those next to [`SAMPLING`] are recorded.
fn grid(options: &Options) -> Result<TimeGrid, String> {
    let mut grid = TimeGrid::reaching(options.end, options.step)?;
    while real(grid.stride + 1) * grid.step <= SAMPLING * (1.0 + 1e-6) {
        grid.stride += 1;
    }
    if grid.steps / grid.stride < UNKNOWNS.len() {
        return Err(format!("{} s are too short for a recording", grid.end()));
    }
    Ok(grid)
}

/// Both laws, by all runs of sweep, fit and fits of fresh noise.
///
/// Every step closes the balance to half a unit in the last place of its largest term c θ; these errors walk at
/// random, so that after N steps they are √N times as large, and hardly ever four times that.
fn check_laws(found: &Found<'_>, claims: &mut Claims) {
    claims.holds(
        found.survey.failed == 0,
        format!("{} members of the sweep fail", found.survey.failed),
    );
    let sweep = found.survey.samples.iter().map(|sample| sample.laws);
    let fits = [found.fit.laws, found.bootstrap.laws];
    let laws = sweep.chain(fits).fold(drive::Laws::NONE, drive::Laws::and);
    claims.at_most(
        "the largest defect of the balance, as a share of the heat in the damper",
        Some(laws.balance_defect),
        4.0 * real(found.data.grid.steps).sqrt() * 0.5 * f64::EPSILON,
    );
    claims.at_most(
        "the largest loss of entropy in a step, as a share of it",
        Some(laws.entropy_loss),
        2.0 * f64::EPSILON,
    );
}

/// The derivatives of χ² at the fit, all three logarithms together, against a difference of runs.
///
/// With the change d of each logarithm it is wrong by d² of the third derivative, which is of the size of the second one, and by
/// rounding of the runs, some 1e-13, over d.
fn check_derivatives(found: &Found<'_>, claims: &mut Claims) -> Result<(), Box<dyn Error>> {
    const CHANGE: f64 = 1e-4;
    let point = &found.fit.point;
    let moved = [CHANGE, -CHANGE].map(|change| point.logs.map(|log| log + change));
    let runs: Result<Vec<_>, _> = drive::drive(found.data.grid, &moved).into_iter().collect();
    let [up, down] = &runs?[..] else {
        return Err("two runs were asked for".into());
    };
    let of = |drive| found.data.recording.residuals(drive);
    let pairs = of(up).into_iter().zip(of(down)).enumerate();
    let (mut off, mut size) = (0.0, 0.0);
    for (at, (up, down)) in pairs {
        let by: f64 = point.jacobian.iter().map(|column| column[at]).sum();
        off += (by - (up - down) / (2.0 * CHANGE)).powi(2);
        size += by.powi(2);
    }
    claims.at_most(
        "what differences of runs are off the derivatives, as a share of them",
        Some((off / size).sqrt()),
        1e-6,
    );
    Ok(())
}

/// What was found, against the truth and against what the noise allows.
fn check_fit(found: &Found<'_>, claims: &mut Claims) {
    let (fit, bootstrap) = (found.fit, found.bootstrap);
    claims.holds(fit.converged, "the fit does not converge");
    claims.holds(
        bootstrap.failed == 0,
        format!("{} fits of fresh noise do not converge", bootstrap.failed),
    );
    let linear = confidence::deviations(found.covariance);
    if report::largest(&linear) > KNOWN {
        terminal::say(format_args!(
            "This ride says too little: claims about unknowns take standard deviations below {} %.",
            100.0 * KNOWN
        ));
        return;
    }
    let sampled = bootstrap.deviations();
    let [least, most] = confidence::spread(bootstrap.estimates.len());
    for (i, unknown) in UNKNOWNS.iter().enumerate() {
        let name = unknown.name;
        claims.at_most(
            &format!("{name}: its distance from the truth, in standard deviations"),
            Some((fit.point.logs[i] - unknown.truth.ln()).abs() / linear[i]),
            3.0,
        );
        let ratio = Some(sampled[i] / linear[i]);
        let what =
            format!("{name}: the deviation of fits of fresh noise, relative to the linear one");
        claims.at_least(&what, ratio, least);
        claims.at_most(&what, ratio, most);
    }
    let freedom = freedom(found.data.recording);
    claims.at_most(
        "what the fit leaves: |χ²/(n − 3) − 1|",
        Some((fit.misfit / freedom - 1.0).abs()),
        4.0 * (2.0 / freedom).sqrt(),
    );
}

/// Numbers that were recorded beyond those that are found.
fn freedom(recording: &Recording) -> f64 {
    real(recording.len() - UNKNOWNS.len())
}

fn at_least_one(text: &str) -> Result<usize, String> {
    at_least(1, text)
}

fn at_least_two(text: &str) -> Result<usize, String> {
    at_least(2, text)
}

fn at_least(least: usize, text: &str) -> Result<usize, String> {
    let count: usize = text.parse().map_err(|_| "not a whole number".to_owned())?;
    if count < least {
        return Err(format!("must be at least {least}"));
    }
    Ok(count)
}

#[expect(clippy::cast_precision_loss, reason = "counts are far below 2^53")]
fn real(count: usize) -> f64 {
    count as f64
}
