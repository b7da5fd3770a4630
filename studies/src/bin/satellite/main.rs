//! A satellite with flexible panels that rockets turn.
//!
//! A stiff body has two soft panels on hinges, which four thermo-visco-elastic stiffeners each keep from
//! flapping. For a second, two rockets turn it; then it drifts for a minute, and they stop it again. The panels lag
//! behind and swing, stiffeners that are stretched cool down, others warm up, and what creeps in them becomes
//! heat.
//!
//! ```text
//! ρ q̈ = Div(2 F ∂ψ/∂C),   F = Grad q,   C = FᵀF                          body and panels
//! ψ = λ/2 e1² + μ e2,   e1 = tr G,   e2 = G : G,   G = (C − 1)/2
//! nodes of hinges: those of both solids;   stiffeners: the springs of the example `single_pendulum`
//! rockets: f = F(t) n along lines n of the body, F = 26.5 N for 0 < t < 1 s, −26.5 N for 59 s < t < 60 s
//! ```
//!
//! | symbol | meaning | value |
//! |---|---|---|
//! | – | body | cube of 1 m, 2 × 2 × 2 hexahedra of 8 nodes |
//! | – | panels | 4 m × 1 m × 0.1 m at x = ½ m and x = −½ m, 8 × 2 × 2 hexahedra |
//! | ρ | densities of body and panels | 500 kg/m³, 10 kg/m³ |
//! | E, ν | Young's moduli of body and panels, Poisson's ratio | 1e9 Pa, 5000 Pa; 0.3 |
//! | λ, μ | Lamé's constants | Eν/((1 + ν)(1 − 2ν)), E/(2(1 + ν)) |
//! | – | hinges | the nodes (±½, y, 0), y = −½, 0, ½ m |
//! | – | stiffeners | from the corners of the body to (±(½ + √3/2), ±½, 0), 1 m long |
//! | κ | conductance of each stiffener to surroundings at 300 K | 20 W/K |
//! | – | rockets | at (0, 0, ±½) along ±x, which turns about y; `--axis z`: at (0, ±½, 0) |
//!
//! Source: the system is that of García Orden & Romero, Eur. J. Mech. A/Solids 32 (2012), §4.2, who give
//! neither meshes nor axis, nor how the rockets fire; those are chosen here, and the ambient temperature of
//! 10 K there is read as 300 K. So it behaves as theirs, and its curves are its own. The step is 0.2 s, the end
//! 62 s.
//!
//! A CSV file has time (s), energy E and work W of the rockets (J), entropy S (J/K), kinetic energy (J),
//! angular momentum J (kg m²/s), Newton iterations of the step, the attitude (by how many degrees the body has
//! turned), and the temperatures of the stiffeners (K).
//!
//! What the example claims, and fails without, at steps of 0.1 s and 0.2 s: the energy–entropy–momentum schemes
//! reach the end with E = W to 1e-10 J, no loss of entropy in any step, and, between the firings, J to 1e-14 of
//! itself; midpoint and trapezoidal rule fail, or are off by more than 10 J. With the steps that are known from
//! another program, energies are met to 1e-9 and attitudes to 0.01°.
//!
//! `--aim 90` finds the thrust over time that turns it by 90° and leaves it at rest, from one gradient of each run, and claims
//! that the objective falls by 100 in at most 40 runs, each of which keeps both laws.

use std::error::Error;
use std::process::ExitCode;

use eem::prelude::*;

mod balance;
mod known;
mod optimal;
mod pictures;
mod scene;
mod shapes;
#[path = "../single_pendulum/scene.rs"]
mod single_pendulum;

use eem_studies::claims::{self, Claims};
use eem_studies::command_line::{self, CommandLine};
use eem_studies::record::Record;
use eem_studies::simulate::{self, Further, Watched};
use eem_studies::time_grid::TimeGrid;
use eem_studies::{output, terminal};
use optimal::Aim;
use scene::{Axis, Satellite, satellite};

const ABOUT: &str =
    "A satellite with flexible panels that rockets turn, and how schemes keep its laws";
const HINT: &str = "Add --out DIR for a CSV file per scheme and pictures.";

/// The schemes that are compared when none is asked for by its name.
const COMPARED: [Scheme; 4] = [
    Scheme::EemEntropy,
    Scheme::EemTemperature,
    Scheme::Midpoint,
    Scheme::Trapezoidal,
];

/// Columns of the CSV files.
const COLUMNS: [&str; 18] = [
    "time",
    "energy",
    "work",
    "entropy",
    "kinetic",
    "angular_momentum_x",
    "angular_momentum_y",
    "angular_momentum_z",
    "newton_iterations",
    ATTITUDE,
    "theta_1",
    "theta_2",
    "theta_3",
    "theta_4",
    "theta_5",
    "theta_6",
    "theta_7",
    "theta_8",
];

const ATTITUDE: &str = "attitude_degrees";

/// Options of this example.
#[derive(Clone, Debug, clap::Parser)]
struct Options {
    /// About which axis the rockets turn it.
    #[arg(long, value_enum, default_value = "y")]
    axis: Axis,
    /// The rockets do not stop it.
    #[arg(long)]
    no_stop: bool,
    /// Finds the thrust that turns it by this angle and leaves it at rest, instead of comparing schemes.
    #[arg(long, value_name = "DEGREES", conflicts_with = "no_stop")]
    aim: Option<f64>,
    /// Most iterations of the optimiser, with `--aim`.
    #[arg(long, value_name = "N", default_value_t = 30, requires = "aim")]
    iterations: u64,
    #[command(flatten)]
    common: CommandLine,
}

/// What is run.
#[derive(Clone, Copy, Debug)]
struct Case {
    axis: Axis,
    stops: bool,
    step: f64,
}

fn main() -> ExitCode {
    claims::verdict(run(&command_line::read(ABOUT)))
}

fn run(options: &Options) -> Result<Claims, Box<dyn Error>> {
    let grid = options.common.time_grid(scene::STEP, scene::END);
    let directory = options.common.out.as_deref();
    directory.map_or(Ok(()), output::prepare)?;
    if let Some(degrees) = options.aim {
        let scheme = options.common.schemes_or(&COMPARED[..1])[0];
        let (axis, angle) = (options.axis, degrees.to_radians());
        return optimal::run(
            Aim {
                axis,
                scheme,
                angle,
                grid,
                iterations: options.iterations,
            },
            directory,
        );
    }
    let case = Case {
        axis: options.axis,
        stops: !options.no_stop,
        step: grid.step,
    };
    let schemes = options.common.schemes_or(&COMPARED).into_iter();
    let runs = schemes
        .map(|scheme| turn(scheme, case, grid))
        .collect::<Result<Vec<_>, _>>()?;
    balance::print(&runs);
    match directory {
        Some(directory) => {
            for run in &runs {
                output::write_columns(directory, run, &COLUMNS)?;
            }
            pictures::write(directory, &runs)?;
            shapes::write(directory, case, grid)?;
            terminal::say(format_args!("States and pictures: {}", directory.display()));
        }
        None => terminal::say(HINT),
    }
    let mut claims = Claims::default();
    for run in &runs {
        balance::check(run, case, &mut claims);
        known::check(run, case, &mut claims);
    }
    Ok(claims)
}

/// Turns the satellite and records what the CSV files hold.
fn turn(scheme: Scheme, case: Case, grid: TimeGrid) -> Result<Record, Box<dyn Error>> {
    let satellite = satellite(case.axis, move |t| scene::thrust(t, case.stops))?;
    let (watched, further) = watched(&satellite, case.axis);
    let mut simulation = Simulation::new(satellite.scene, scheme, grid.step)?;
    let mut run = simulate::record_with(scheme.name(), &mut simulation, &watched, grid, further)?;
    run.change(ATTITUDE, unwind);
    Ok(run)
}

/// What is recorded, with columns of this example's own. A handle that is not of the scene would show as not a number.
fn watched(satellite: &Satellite, axis: Axis) -> (Watched, [Further<3>; 3]) {
    let watched = Watched {
        elements: satellite.stiffeners.clone(),
        ..Watched::default()
    };
    let [tail, head] = satellite.line;
    let attitude = Quantity::custom_in("°", move |run: &Simulation<3>| {
        let [Ok(tail), Ok(head)] = [tail, head].map(|node| run.position(node)) else {
            return f64::NAN;
        };
        let line = head - tail;
        let ahead = match axis {
            Axis::Y => -line.z,
            Axis::Z => line.y,
        };
        ahead.atan2(line.x).to_degrees()
    });
    let further = [
        ("work", Quantity::Ledger(|ledger| ledger.work)),
        ("kinetic", Quantity::Ledger(|ledger| ledger.kinetic_energy)),
        (ATTITUDE, attitude),
    ];
    (watched, further)
}

/// Angles that go on where they jump back by a turn, degrees.
fn unwind(angles: &mut [f64]) {
    let mut before = 0.0;
    for angle in angles {
        *angle += 360.0 * ((before - *angle) / 360.0).round();
        before = *angle;
    }
}
