//! A rubber bearing of a building in an earthquake: it warms up, softens and damps less.
//!
//! A long block of rubber lies between two steel plates; the upper one is shaken to and fro by as much as the
//! rubber is high. What creeps in the rubber becomes heat, most of which stays: rubber conducts little. Warm rubber
//! creeps faster, so that the cycles grow thinner: the bearing damps less just when it is needed.
//!
//! ```text
//! ρ q̈ = Div(F S),   S = ∂ψ/∂G,   G = (FᵀF − 1)/2                      plane strain, all per reference volume
//! Γ̇ = dev(−∂ψ/∂Γ)/η,   η = η0 exp(a/θ − a/θr)                          the viscous strain
//! θ ṡ = k Div Grad θ + η Γ̇:Γ̇,   s = −∂ψ/∂θ
//!
//! ψ = μ (e1 − ln J) + λ/2 ln²J + (m − m1 (θ − θr)) (G − Γ):(G − Γ)
//!     − 3 α K (θ − θr) ln J + c (θ − θr − θ ln(θ/θr)),   e1 = tr G,   J = det F
//! ```
//!
//! | symbol | meaning | value |
//! |---|---|---|
//! | – | the rubber | 0.4 m wide, 0.1 m high, 0.4 m long; 8 × 2 quadrilaterals of 8 nodes |
//! | – | displacement of the upper plate | 0.1 m sin(2π t/(1 s)), in the first second times t² |
//! | μ, λ | stiffness of the rubber | 0.4e6 Pa, 20e6 Pa |
//! | m, m1 | stiffness of the creeping branch, and how it falls with temperature | 0.6e6 Pa, 3000 Pa/K |
//! | η0, a | viscosity at θr, and how it falls with temperature | 0.12e6 Pa s, 3000 K |
//! | α, K | linear expansion with temperature, bulk modulus | 2e-4/K, 20e6 Pa |
//! | c, k, ρ | heat capacity, conductivity, density | 2e6 J/(K m³), 0.25 W/(m K), 1100 kg/m³, lumped |
//! | θr | temperature of everything at t = 0, and of plates and air | 293.15 K |
//! | – | film between rubber and air | 10 W/(m² K) |
//!
//! Source: the problem and its numbers are chosen here; they are those of a rubber that damps strongly. The step is
//! 0.025 s, the end 20 s.
//!
//! A CSV file has time (s), energy E and work W of the plate (J), entropy S (J/K), the strain (displacement of the
//! plate over height) and the mean shear stress (Pa), mean and largest temperature (K), and Newton iterations of
//! the step.
//!
//! What the example claims, and fails without: the energy–entropy–momentum schemes reach the end, E − W changes by
//! rounding only, and no entropy is lost in any step. From the third cycle on the rubber gets warmer from cycle to cycle and the plate does
//! less work.

use std::error::Error;
use std::process::ExitCode;

use eem::prelude::*;

mod balance;
mod cycles;
mod pictures;
mod scene;
mod shapes;

use eem_studies::claims::{self, Claims};
use eem_studies::command_line::CommandLine;
use eem_studies::record::Record;
use eem_studies::simulate::{self, Further, Watched};
use eem_studies::time_grid::TimeGrid;
use eem_studies::{output, points, terminal};
use scene::{Bearing, HEIGHT, bearing};

const ABOUT: &str = "A rubber bearing in an earthquake, which warms up and damps less";
const HINT: &str = "Add --out DIR for a CSV file per scheme and pictures.";

/// The schemes that are compared when none is asked for by its name.
const COMPARED: [Scheme; 4] = [
    Scheme::EemEntropy,
    Scheme::EemTemperature,
    Scheme::Midpoint,
    Scheme::Trapezoidal,
];

/// Columns of the CSV files.
const COLUMNS: [&str; 9] = [
    "time",
    "energy",
    "work",
    "entropy",
    "strain",
    "shear_stress",
    "temperature_mean",
    "temperature_max",
    "newton_iterations",
];

fn main() -> ExitCode {
    claims::verdict(run(&CommandLine::read(ABOUT)))
}

fn run(command_line: &CommandLine) -> Result<Claims, Box<dyn Error>> {
    let grid = command_line.time_grid(scene::STEP, scene::END);
    let directory = command_line.out.as_deref();
    directory.map_or(Ok(()), output::prepare)?;
    let schemes = command_line.schemes_or(&COMPARED).into_iter();
    let runs = schemes
        .map(|scheme| shake(scheme, grid))
        .collect::<Result<Vec<_>, _>>()?;
    balance::print(&runs);
    match directory {
        Some(directory) => {
            for run in &runs {
                output::write_columns(directory, run, &COLUMNS)?;
            }
            pictures::write(directory, &runs)?;
            shapes::write(directory, grid)?;
            terminal::say(format_args!("States and pictures: {}", directory.display()));
        }
        None => terminal::say(HINT),
    }
    let mut claims = Claims::default();
    for run in &runs {
        balance::check(run, &mut claims);
        cycles::check(run, &mut claims);
    }
    Ok(claims)
}

/// Shakes the bearing and records what the CSV files hold.
fn shake(scheme: Scheme, grid: TimeGrid) -> Result<Record, Box<dyn Error>> {
    let bearing = bearing()?;
    let further = further(&bearing);
    let mut simulation = Simulation::new(bearing.scene, scheme, grid.step)?;
    let watched = Watched::default();
    simulate::record_with(scheme.name(), &mut simulation, &watched, grid, further)
}

/// Columns of this example's own. A handle that is not of the scene would show as not a number.
fn further(bearing: &Bearing) -> [Further<2>; 6] {
    let rubber = bearing.rubber.points();
    let plate = bearing.plate;
    let strain = Quantity::custom(move |run: &Simulation<2>| {
        run.position(plate)
            .map_or(f64::NAN, |position| position.x / HEIGHT)
    });
    [
        ("work", Quantity::Ledger(|ledger| ledger.work)),
        ("entropy", Quantity::TotalEntropy),
        ("strain", strain),
        (
            "shear_stress",
            points::mean(rubber, "Pa", |run, point| {
                Ok(run.solid_state(point)?.stress[(0, 1)])
            }),
        ),
        (
            "temperature_mean",
            points::mean(rubber, "K", Simulation::temperature),
        ),
        ("temperature_max", points::warmest(rubber)),
    ]
}
