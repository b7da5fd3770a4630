//! Damper and spring of a car, designed: from a soft ride to little room for the suspension.
//!
//! The car is that of the example `shock_absorber`, with its equations, symbols and values, on one lap of its road. What
//! shakes the passengers is the acceleration of the body. What takes room is the travel z of the suspension on the road,
//! and by how much a load of 75 kg lowers the car. One cannot be lowered below a line without raising the other. Ten points
//! of that line are the least values of
//!
//! ```text
//! J(x) = A/A₁ + w R/R₁,    x = (ln η0, ln k_s),    w from 0.1 to 10
//!
//! A = (1/T) Σ (vᵢ₊₁ − vᵢ)²/h,    R = (1/T) Σ h zᵢ² + (m g/k_s)²      v: of the body,  A₁, R₁: of the car as it was
//! ```
//!
//! Each is found by L-BFGS of the crate `argmin` from the one before. The derivatives are those of the discrete run,
//! by its adjoint: one [`gradient`](eem::Simulation::gradient) has those by both unknowns. A function of many states, such as
//! A, is differentiated by its weights `aᵢ = ∂J/∂vᵢ`: the misfit `½ Σ (vᵢ − dᵢ)²` with data `dᵢ = vᵢ − aᵢ` has the gradient
//! `Σ aᵢ ∂vᵢ`.
//!
//! What the example claims, and fails without: every run keeps energy minus work minus heat constant to rounding and
//! loses no entropy; every gradient is that of tangents along its run; no design that differs by 2 % in an unknown is
//! better than what was found, nor is the car as it was; along the line the room falls and the acceleration rises.

use std::error::Error;
use std::path::Path;
use std::process::ExitCode;

#[path = "../shock_absorber/balance.rs"]
#[allow(dead_code, reason = "the other study uses all of it")]
mod balance;
#[path = "../shock_absorber/car.rs"]
mod car;
mod ride;
#[path = "../shock_absorber/road.rs"]
mod road;
mod search;

use car::{DAMPER, SUSPENSION, TRACK};
use eem_studies::claims::{self, Claims};
use eem_studies::command_line::CommandLine;
use eem_studies::figures::{Axes, Curve, Figure, write_stack};
use eem_studies::{output, table, terminal};
use ride::Design;
use search::{Best, Runs};

const ABOUT: &str = "Damper and spring of a car, from a soft ride to little room";
const HINT: &str = "Add --out DIR for a picture and the designs as CSV.";

const STEP: f64 = 0.005;

/// The weights of the room.
const WEIGHTS: u8 = 10;
const DECADES: [f64; 2] = [-1.0, 1.0];

fn main() -> ExitCode {
    claims::verdict(run(&CommandLine::read(ABOUT)))
}

fn run(command_line: &CommandLine) -> Result<Claims, Box<dyn Error>> {
    let lap = TRACK.lap_time();
    let grid = command_line.time_grid(STEP, lap);
    let directory = command_line.out.as_deref();
    directory.map_or(Ok(()), output::prepare)?;
    let scheme = command_line.schemes_or(&[eem::Scheme::EemEntropy])[0];

    let mut runs = Runs::start(scheme, grid)?;
    let mut line: Vec<Best> = Vec::new();
    for place in 0..WEIGHTS {
        let share = f64::from(place) / f64::from(WEIGHTS - 1);
        let weight = 10_f64.powf(DECADES[0] + share * (DECADES[1] - DECADES[0]));
        let start = line.last().map_or(Design::FIRST, |best| best.design);
        let best = runs.best(weight, start)?;
        line.push(best);
    }
    print(&runs, &line);
    if grid.end() >= lap {
        check(&mut runs, &line)?;
    }
    match directory {
        Some(directory) => write(directory, &runs, &line)?,
        None => terminal::say(HINT),
    }
    Ok(runs.claims)
}

/// The line is one of least values.
fn check(runs: &mut Runs, line: &[Best]) -> Result<(), Box<dyn Error>> {
    for best in line {
        let least = runs.least_nearby(best)?.min(1.0 + best.weight);
        runs.claims.at_most(
            "J, as a share of that of other designs",
            Some(best.objective / least),
            1.0,
        );
    }
    for pair in line.windows(2) {
        let [before, after] = [&pair[0].ride, &pair[1].ride];
        let is_line = after.room < before.room && after.acceleration > before.acceleration;
        runs.claims
            .holds(is_line, "a design is worse than another one in both");
    }
    Ok(())
}

fn print(runs: &Runs, line: &[Best]) {
    let mut rows = table::headed([
        "weight of room",
        "viscosity η0 (N s/m)",
        "stiffness k_s (kN/m)",
        "acceleration (m/s²)",
        "travel (mm)",
        "room (mm)",
        "damper at the end (°C)",
        "runs",
    ]);
    let cells = |design: Design, ride: &ride::Ride| {
        [
            format!("{:.0}", design.viscosity()),
            format!("{:.2}", 1e-3 * design.stiffness()),
            format!("{:.3}", ride.acceleration),
            format!("{:.2}", 1e3 * ride.travel),
            format!("{:.1}", 1e3 * ride.room),
            format!("{:.2}", ride.temperature - car::CELSIUS),
        ]
    };
    let first = cells(Design::FIRST, &runs.first);
    let row = |weight: String, cells: [String; 6], count: String| {
        [weight]
            .into_iter()
            .chain(cells)
            .chain([count])
            .collect::<Vec<_>>()
    };
    rows.add_row(row("as it was".to_owned(), first, String::new()));
    for best in line {
        let cells = cells(best.design, &best.ride);
        rows.add_row(row(
            format!("{:.2}", best.weight),
            cells,
            best.runs.to_string(),
        ));
    }
    terminal::say(format_args!(
        "{rows}\nAcceleration of the body and travel of the suspension: root mean squares over the ride. Room: with a load, too."
    ));
}

/// A picture of the line, and its designs.
fn write(directory: &Path, runs: &Runs, line: &[Best]) -> Result<(), Box<dyn Error>> {
    let curve = |label: &str, points: Vec<(f64, f64)>, look| Curve {
        label: label.to_owned(),
        decisive: points.len(),
        points,
        look,
        trusted: true,
    };
    let at = |ride: &ride::Ride| (1e3 * ride.room, ride.acceleration);
    let figure = Figure {
        title: "Ten cars of which none is better than another".to_owned(),
        x_label: "room of the suspension, √R (mm)".to_owned(),
        y_label: "acceleration of the body (m/s²)".to_owned(),
        curves: vec![
            curve(
                "designed",
                line.iter().map(|best| at(&best.ride)).collect(),
                0,
            ),
            curve("as it was", vec![at(&runs.first)], 1),
        ],
        axes: Axes::Even,
    };
    let by_stiffness = Figure {
        title: "Their dampers and springs".to_owned(),
        x_label: "stiffness k_s of the spring (kN/m)".to_owned(),
        y_label: "viscosity η0 (N s/m)".to_owned(),
        curves: vec![
            curve(
                "designed",
                line.iter()
                    .map(|best| (1e-3 * best.design.stiffness(), best.design.viscosity()))
                    .collect(),
                0,
            ),
            curve("as it was", vec![(1e-3 * SUSPENSION, DAMPER.eta0)], 1),
        ],
        axes: Axes::Even,
    };
    write_stack(&[figure, by_stiffness], &directory.join("designs.svg"))?;
    let row = |best: &Best| {
        vec![
            best.weight,
            best.design.viscosity(),
            best.design.stiffness(),
            best.ride.acceleration,
            best.ride.travel,
            best.ride.room,
            best.ride.temperature,
        ]
    };
    let rows: Vec<Vec<f64>> = line.iter().map(row).collect();
    let heads = [
        "weight",
        "viscosity",
        "stiffness",
        "acceleration",
        "travel",
        "room",
        "temperature",
    ];
    output::write_numbers(directory, "designs", &heads, &rows)?;
    terminal::say(format_args!("Picture and designs: {}", directory.display()));
    Ok(())
}
