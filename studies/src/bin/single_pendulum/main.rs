//! A thermo-visco-elastic pendulum: mass, spring, dashpot and heat.
//!
//! A mass moves in the plane on a spring whose other end is fixed. The spring starts hot and three
//! times too long; it creeps, and gives its heat to the surroundings. No gravity.
//!
//! ```text
//! q̇ = p/m,   ṗ = −f ∂λ/∂q,   γ̇ = g/η,   θ ṡ = g²/η + κ (θr − θ),   θr σ̇ = κ (θ − θr)
//! λ = |q|,   f = ∂ψ/∂λ,   g = −∂ψ/∂γ,   s = −∂ψ/∂θ
//!
//! ψe = k(θ)/2 ln²(λ/λ0) − βt (θ − θr) ln(λ/λ0) + c (θ − θr − θ ln(θ/θr))
//! ψ  = (1 + βc) ψe + μ(θ) γ² − βc γ ∂ψe/∂λ
//! k  = k0 − k1 (θ − θr),   μ = μ0 − μ1 (θ − θr),   η = η0 exp(a (1/θ − 1/θr))
//! ```
//!
//! | symbol | meaning | value |
//! |---|---|---|
//! | q, p, m | position, momentum, mass | q = (3, 0) m, p = (0, 1) kg m/s at t = 0; m = 1 kg |
//! | λ, λ0 | length of the spring, its natural length | λ0 = 1 m |
//! | γ | viscous stretch | 0 m at t = 0 |
//! | θ, θr, σ | temperature, that of the surroundings, their entropy | θ = 380 K at t = 0, θr = 300 K |
//! | k0, k1 | stiffness, softening with temperature | 100 N m, 0.5 N m/K |
//! | βt, c | thermoelastic coupling, heat capacity | 4 N m/K, 1 N m/K |
//! | μ0, μ1 | viscous stiffness, softening with temperature | 5 N/m, 0.1 N/(m K) |
//! | βc | viscoelastic coupling | 0.1 |
//! | η0, a | viscosity, its dependence on temperature | 100 N s/m, 10 K |
//! | κ | heat conductance | 10 W/K |
//!
//! Source: García Orden & Romero, Eur. J. Mech. A/Solids 32 (2012), §4.1: 20 s in steps of 0.2 s,
//! more than two periods of the fastest oscillation per step. It is also example 1 of Kern, Romero,
//! Conde Martín & García Orden (2021), §IV.A. Figures 2 to 8 of the former and 3 and 4 of the latter
//! are drawn under their numbers; the example `paper_tables` compares the numbers.
//!
//! Units are checked where the free energy stands below. Every sum of the paper agrees in its units
//! (N m of its stiffnesses is J) if βc is dimensionless, and this is the reading here; 2 μ0/k0, to
//! which it is equal, is per square metre, and so a number only with lengths in units of λ0.
//!
//! What the example claims, and fails without: every energy–entropy–momentum scheme reaches the
//! end, keeps energy and angular momentum to rounding, and loses no entropy in any step.

use std::error::Error;
use std::path::Path;
use std::process::ExitCode;

use eem::prelude::*;

mod figures;
mod scene;

use eem_studies::claims::{self, Claims};
use eem_studies::command_line::CommandLine;
use eem_studies::comparison::Comparison;
use eem_studies::record::Record;
use eem_studies::statistics::Statistics;
use eem_studies::time_grid::TimeGrid;
use eem_studies::{defects, output, published, simulate, terminal};
use scene::{CONDUCTANCE, pendulum};

const HINT: &str = "Add --out DIR for the states as CSV and the figures of the papers.";
const ABOUT: &str =
    "A thermo-visco-elastic pendulum, the laws of thermodynamics, and how schemes keep them";

/// The reference takes steps of at most this size (s), and of at most this share of the schemes'
/// step; its positions are then off by 5e-7 (steps of 1e-3 s are off by four times as much).
const REFERENCE_STEP: f64 = 5e-4;
const REFERENCE_SHARE: f64 = 0.05;

/// The reference is recorded at least this often (s), to draw a smooth curve.
const REFERENCE_SAMPLING: f64 = 0.01;

/// What rounding may do to the laws over the run, relative to the quantity itself. The state is
/// kept to twice the working precision and energy is closed in every step, so that its defect does
/// not grow with their number; evaluating E or J from the state costs a dozen roundings of ε/2.
const ENERGY_DEFECT: f64 = 4e-15;
const MOMENTUM_DEFECT: f64 = 5e-15;

/// Momentum is what Newton's method leaves of it, less than ε/100 per step: seen after 1000 steps.
const MOMENTUM_DRIFT: f64 = 0.01 * f64::EPSILON;

/// What rounding may take from S in a step, J/K: two units in the last place, 4 J/K < S < 8 J/K.
const ENTROPY_LOSS: f64 = 2.0 * ULP_OF_ENTROPY;
const ULP_OF_ENTROPY: f64 = 4.0 * f64::EPSILON;

fn main() -> ExitCode {
    claims::verdict(run(&CommandLine::read(ABOUT)))
}

fn run(command_line: &CommandLine) -> Result<Claims, Box<dyn Error>> {
    let grid = command_line.time_grid(scene::STEP, scene::END);
    let directory = command_line.out.as_deref();
    directory.map_or(Ok(()), output::prepare)?;

    let reference = reference(grid)?;
    let mut runs = Vec::new();
    for scheme in command_line.schemes() {
        let (mut simulation, watched) = pendulum(scheme, grid.step, CONDUCTANCE)?;
        runs.push(simulate::record(
            scheme.name(),
            &mut simulation,
            &watched,
            grid,
        )?);
    }
    defects::print(&runs, Some(&reference));
    match directory {
        Some(directory) => write(directory, &reference, &runs)?,
        None => terminal::say(HINT),
    }
    Ok(check(&runs))
}

/// The same motion in steps so small that the scheme no longer matters.
fn reference(grid: TimeGrid) -> Result<Record, Box<dyn Error>> {
    let longest = REFERENCE_STEP.min(REFERENCE_SHARE * grid.step);
    let grid = grid.refined(longest, REFERENCE_SAMPLING);
    let (mut simulation, watched) = pendulum(Scheme::EemEntropy, grid.step, CONDUCTANCE)?;
    simulate::record("reference", &mut simulation, &watched, grid)
}

/// The claims about the energy–entropy–momentum schemes, as far as they were run.
fn check(runs: &[Record]) -> Claims {
    let mut claims = Claims::default();
    for run in runs.iter().filter(|run| run.scheme.starts_with("eem-")) {
        let scheme = &run.scheme;
        claims.reaches_the_end(run);
        let steps = u32::try_from(run.steps()).map_or(f64::INFINITY, f64::from);
        let figures = Statistics::of(run);
        claims.at_most(
            &format!("{scheme}: the relative energy defect"),
            figures.energy_defect,
            ENERGY_DEFECT,
        );
        claims.at_most(
            &format!("{scheme}: the relative angular momentum defect"),
            figures.angular_momentum_defect,
            MOMENTUM_DEFECT.max(MOMENTUM_DRIFT * steps),
        );
        claims.at_least(
            &format!("{scheme}: the smallest entropy increment (J/K)"),
            figures.entropy_increment,
            -ENTROPY_LOSS,
        );
    }
    claims
}

/// CSV files and the papers' figures.
fn write(directory: &Path, reference: &Record, runs: &[Record]) -> Result<(), Box<dyn Error>> {
    for run in runs {
        output::write_csv(directory, run)?;
    }
    let reference = Some(reference);
    let comparison = Comparison {
        case: "",
        reference,
        runs,
    };
    comparison.write(directory, &figures::ALL_SCHEMES)?;
    published::write(comparison, directory, &figures::KERN)?;
    figures::hero(runs).write_svg(&directory.join("energy.svg"))?;
    terminal::say(format_args!("States and figures: {}", directory.display()));
    Ok(())
}
