//! Two masses on two springs that warm and cool each other, in space.
//!
//! Anchor, spring 1, mass 1, spring 2, mass 2. Each spring cools when it is stretched; heat flows
//! between the two and nowhere else, so that the scene is isolated. No gravity.
//!
//! ```text
//! q̇ᵢ = pᵢ/mᵢ,   ṗ₁ = −f₁ ∂λ₁/∂q₁ − f₂ ∂λ₂/∂q₁,   ṗ₂ = −f₂ ∂λ₂/∂q₂
//! θ₁ ṡ₁ = κ (θ₂ − θ₁),   θ₂ ṡ₂ = κ (θ₁ − θ₂)
//! λ₁ = |q₁|,   λ₂ = |q₂ − q₁|,   f = ∂ψ/∂λ,   s = −∂ψ/∂θ
//!
//! ψ = C(θ)/2 ln²(λ/λ0) − β (θ − θr) ln(λ/λ0) + c (θ − θr − θ ln(θ/θr))
//! C = C0 − C1 θr ln(θ/θr)
//! ```
//!
//! | symbol | meaning | unit | romero | krueger | log |
//! |---|---|---|---|---|---|
//! | m | masses | kg | 1, 2 | 1, 2 | 10, 20 |
//! | q₁ | position of mass 1 at t = 0 | m | (1, 0, 0) | (1, 0, 0) | (3, 0, 0.5) |
//! | q₂ | position of mass 2 at t = 0 | m | (2.2, 0, 0) | (2.2, 0, 0) | (3, 1, 1) |
//! | p₁ | momentum of mass 1 at t = 0 | kg m/s | (0, 2, 0) | (0, 1, 0) | (0, 10, 0) |
//! | p₂ | momentum of mass 2 at t = 0 | kg m/s | (1, 0, 0) | (0, 4.4, 0) | (0, 0, −20) |
//! | λ, λ0 | lengths of the springs, natural lengths | m | 2, 1 | 2, 1 | 2, 1 |
//! | θ, θr | temperatures at t = 0; θr = 300 K | K | 380, 310 | 380, 310 | 380, 298 |
//! | C0 | stiffnesses | J | 0.1, 1 | 100, 100 | 5000, 10000 |
//! | C1 | softening with temperature | J/K | 0, 0 | 0, 0 | 50, 60 |
//! | β | thermoelastic coupling | J/K | 0.2, 0.2 | 0.2, 0.2 | 20, 20 |
//! | c | heat capacities | J/K | 5, 5 | 1000, 1000 | 5000, 2000 |
//! | κ | heat conductance | W/K | 300 | 10 | 300 |
//! | | end time and step | s | 25, 0.3 | 500, 0.1 | 25, 0.1 |
//!
//! Source: Conde Martín, Betsch & García Orden, Commun. Nonlinear Sci. Numer. Simul. 32 (2016),
//! §4, eqs. 43 and 47, figures 3 to 17; the cases are named after Romero (2009) and Krüger, Groß &
//! Betsch (2011), who set the first two, and after the logarithmic stiffness of the third. The
//! third is also example 2 of Kern, Romero, Conde Martín & García Orden (2021), figures 6 to 9. The
//! figures are drawn under their numbers, with the schemes that the papers show, and once more with
//! all schemes; figure 2 is the example `order_study`.
//!
//! The source gives the data of the first two cases without units; they are read here in those of the
//! table, in which ψ is in J. The strain ln(λ/λ0) is dimensionless, so that stiffnesses are energies.
//!
//! What the example claims, and fails without: every energy–entropy–momentum scheme reaches the
//! end, keeps energy and angular momentum to rounding, and loses no entropy in any step.

use std::error::Error;
use std::path::Path;
use std::process::ExitCode;

use clap::{Parser, ValueEnum};

mod cases;
mod figures;

use cases::Case;
use eem_studies::claims::{self, Claims, Laws};
use eem_studies::command_line::{self, CommandLine};
use eem_studies::comparison::Comparison;
use eem_studies::published::{self, Published};
use eem_studies::record::Record;
use eem_studies::{defects, output, simulate, terminal};

const HINT: &str = "Add --out DIR for the states as CSV and the figures of the papers.";
const CHAOS: &str = "Later the motion is chaotic: the paths of different schemes part, and only \
                     energy, entropy and momenta can be compared.";
const ABOUT: &str = "A thermoelastic double pendulum in space: three published cases";

#[derive(Debug, Parser)]
struct Options {
    /// Which of the published cases.
    #[arg(long, value_name = "NAME", default_value = "log")]
    case: CaseName,
    #[command(flatten)]
    common: CommandLine,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum CaseName {
    /// Soft springs, strong conduction: slow.
    Romero,
    /// Stiff springs of large heat capacity: fast oscillations, 500 s.
    Krueger,
    /// Stiffness logarithmic in the temperature, strong coupling.
    Log,
}

impl CaseName {
    /// What stands before the titles of pictures.
    const fn title(self) -> &'static str {
        match self {
            Self::Romero => "Romero",
            Self::Krueger => "Krüger",
            Self::Log => "logarithmic stiffness",
        }
    }

    const fn case(self) -> Case {
        match self {
            Self::Romero => cases::ROMERO,
            Self::Krueger => cases::KRUEGER,
            Self::Log => cases::LOG,
        }
    }

    /// The figures of the papers about it.
    const fn figures(self) -> &'static [Published] {
        match self {
            Self::Romero => &figures::ROMERO,
            Self::Krueger => &figures::KRUEGER,
            Self::Log => &figures::LOG,
        }
    }
}

/// What rounding may do to J, relative to itself: J is a difference of products whose sum Σ|q||p| is
/// up to 430 times as large (romero, whose springs become 150 m long), and 430 ε is 1e-13.
const MOMENTUM_DEFECT: f64 = 1e-13;

/// What rounding may take from S in a step, in units in the last place.
const ENTROPY_LOSS: f64 = 2.0;

fn main() -> ExitCode {
    claims::verdict(run(&command_line::read(ABOUT)))
}

fn run(options: &Options) -> Result<Claims, Box<dyn Error>> {
    let case = options.case.case();
    let grid = options.common.time_grid(case.step, case.end);
    let directory = options.common.out.as_deref();
    directory.map_or(Ok(()), output::prepare)?;

    let reference = case.reference(grid)?;
    let mut runs = Vec::new();
    for scheme in options.common.schemes() {
        let (mut simulation, watched) = case.pendulum(scheme, grid.step)?;
        runs.push(simulate::record(
            scheme.name(),
            &mut simulation,
            &watched,
            grid,
        )?);
    }
    defects::print(&runs, Some(&reference.until(case.comparable)));
    if case.comparable < grid.end() {
        terminal::say(CHAOS);
    }
    match directory {
        Some(directory) => write(directory, options.case, &reference, &runs)?,
        None => terminal::say(HINT),
    }
    Ok(check(&case, &runs))
}

/// The claims about the energy–entropy–momentum schemes, as far as they were run.
fn check(case: &Case, runs: &[Record]) -> Claims {
    let laws = Laws {
        energy: case.energy_defect,
        angular_momentum: MOMENTUM_DEFECT,
        entropy: ENTROPY_LOSS,
    };
    let mut claims = Claims::default();
    for run in runs.iter().filter(|run| run.scheme.starts_with("eem-")) {
        claims.keeps_the_laws(run, &laws);
    }
    claims
}

/// CSV files and the papers' figures.
fn write(
    directory: &Path,
    name: CaseName,
    reference: &Record,
    runs: &[Record],
) -> Result<(), Box<dyn Error>> {
    for run in runs {
        output::write_csv(directory, run)?;
    }
    let drawn = name.case().drawn;
    let early: Vec<Record> = runs.iter().map(|run| run.until(drawn)).collect();
    let (early, early_reference) = (early.as_slice(), &reference.until(drawn));
    let case = name.title();
    let comparison = |reference, runs| Comparison {
        case,
        reference,
        runs,
    };
    comparison(Some(early_reference), early).write(directory, &figures::LENGTHS)?;
    let all = comparison(Some(reference), runs);
    all.write(directory, &figures::HISTORIES)?;
    comparison(None, runs).write(directory, &figures::DEFECTS)?;
    published::write(all, directory, name.figures())?;
    terminal::say(format_args!("States and figures: {}", directory.display()));
    Ok(())
}
