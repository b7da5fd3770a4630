//! A thermoelastic block in the shape of an L, set tumbling by tractions on the ends of its legs.
//!
//! The end of the long leg is warm, that of the short one cold. Tractions pull the ends in opposite
//! directions for two seconds, so that the block tumbles, bends and twists; then it is left alone. It is
//! insulated: the one thing that becomes of its heat is that it spreads.
//!
//! ```text
//! ρ q̈ = Div(2 F ∂ψ/∂C),   F = Grad q,   C = FᵀF,   s = −∂ψ/∂θ,   θ ṡ = k Div Grad θ
//! 2 F ∂ψ/∂C n = T(t) on the ends, 0 elsewhere;   k n·Grad θ = 0
//! T = ± (256, 512, 768)/9 Pa τ(t),   τ = t/(1 s) up to 1 s, 2 − t/(1 s) up to 2 s, then 0
//!
//! ψ = a (tr C − 3) + b (tr cof C − 3) + c1/2 j² − d1 ln(1 + j) + c (θ − θr − θ ln(θ/θr))
//!     − 3 β (θ − θr) (c2 j − d2/(1 + j)),   j = det F − 1
//! tr C − 3 = 2 e1,   tr cof C − 3 = 4 e1 + 2 (e1² − e2),   e1 = tr G,   e2 = G : G,   G = (C − 1)/2
//! ```
//!
//! Div and Grad are those of the reference configuration, and so are densities per volume.
//!
//! | symbol | meaning | value |
//! |---|---|---|
//! | – | the legs | [0, 3] × [0, 10] × [0, 3] m and [0, 6] × [0, 3] × [0, 3] m, at rest at t = 0 |
//! | – | mesh | 4 hexahedra of 8 nodes, cut at x = 0, 3, 6 m and y = 0, 3, 6.5, 10 m |
//! | T | tractions | + on the end y = 10 m, − on the end x = 6 m: a torque, no resultant |
//! | θ | temperature, at 8 points per cell | 293.15 K at t = 0, but 313.15 K next to y = 10 m, 273.15 K next to x = 6 m |
//! | ρ, k | density, heat conductivity | 10 kg/m³, 10 W/(m K) |
//! | λ, μ | Lamé's constants at small strains | 5209 Pa, 997.5 Pa |
//! | a, b | Mooney and Rivlin's constants | μ/4 both |
//! | c1, d1 | compression; no stress where there is no strain | λ − μ, 2 (a + 2b) |
//! | β, c2, d2 | linear expansion with temperature; c2 + d2 is the bulk modulus | 2.233e-4/K; λ, 2μ/3 |
//! | c, θr | heat capacity, temperature without thermal stress | 100 J/(m³ K), 293.15 K |
//!
//! The constants of ψ shift the zeros of E and S: E = −10779.4 J and S = −43.6 J/K at t = 0.
//!
//! Sources: the L-shaped block that tractions on its ends set tumbling is that of Simó & Tarnow,
//! Z. angew. Math. Phys. 43 (1992), there elastic. That temperatures may be the thermal variables is due to
//! Conde Martín, Betsch & García Orden, Commun. Nonlinear Sci. Numer. Simul. 32 (2016). The step is
//! 0.025 s, the end 15 s.
//!
//! A CSV file has time (s), energy E and work W of the tractions (J), entropy S (J/K), kinetic energy (J),
//! angular momentum J (kg m²/s), Newton iterations of the step, least and largest temperature (K).
//!
//! What the example claims, and fails without: the energy–entropy–momentum schemes reach the end, and
//! E − W changes by rounding only; they lose no entropy in any step, and J stays once the tractions are
//! gone. With the step above, `eem-temperature` meets the solution of its equations that another program
//! found, to 1e-9.

use std::error::Error;
use std::process::ExitCode;

use eem::prelude::*;

mod balance;
mod known;
mod pictures;
mod scene;
mod shapes;

use eem_studies::claims::{self, Claims};
use eem_studies::command_line::CommandLine;
use eem_studies::record::Record;
use eem_studies::simulate::{self, Further, Watched};
use eem_studies::time_grid::TimeGrid;
use eem_studies::{output, points, terminal};
use scene::{Block, block};

const ABOUT: &str = "A thermoelastic block in the shape of an L, and how schemes keep its laws";
const HINT: &str = "Add --out DIR for a CSV file per scheme and pictures.";

/// The schemes that are compared when none is asked for by its name.
const COMPARED: [Scheme; 4] = [
    Scheme::EemTemperature,
    Scheme::EemEntropy,
    Scheme::Midpoint,
    Scheme::Trapezoidal,
];

/// Columns of the CSV files.
const COLUMNS: [&str; 11] = [
    "time",
    "energy",
    "work",
    "entropy",
    "kinetic",
    "angular_momentum_x",
    "angular_momentum_y",
    "angular_momentum_z",
    "newton_iterations",
    "temperature_min",
    "temperature_max",
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
        .map(|scheme| tumble(scheme, grid))
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
        known::check(run, grid.step, &mut claims);
    }
    Ok(claims)
}

/// Lets the block tumble and records what the CSV files hold.
fn tumble(scheme: Scheme, grid: TimeGrid) -> Result<Record, Box<dyn Error>> {
    let Block { scene, body } = block()?;
    let mut simulation = Simulation::new(scene, scheme, grid.step)?;
    let further = further(body.points());
    let watched = Watched::default();
    simulate::record_with(scheme.name(), &mut simulation, &watched, grid, further)
}

/// Columns of this example's own. A handle that is not of the scene would show as not a number.
fn further(points: &[Element]) -> [Further<3>; 5] {
    [
        ("work", Quantity::Ledger(|ledger| ledger.work)),
        ("entropy", Quantity::TotalEntropy),
        ("kinetic", Quantity::Ledger(|ledger| ledger.kinetic_energy)),
        ("temperature_min", points::coldest(points)),
        ("temperature_max", points::warmest(points)),
    ]
}
