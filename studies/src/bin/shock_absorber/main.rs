//! A quarter car on a rough road, whose shock absorber warms up on a winter morning.
//!
//! ```text
//!    body          z_b, m_b
//!   ┌──┴──┐
//! spring  damper   k_s | a rubber mount μ in series with oil η(θ), and a gas charge ──κ── air
//!   └──┬──┘
//!    wheel         z_w, m_w
//!      │
//!     tyre         k_t
//!      │
//!  ~~ road ~~      z(t), the same 200 m again and again
//! ```
//!
//! The road shakes the car, the damper turns that work into heat, warm oil is thin: the damper
//! softens while the car drives, the body is shaken less and the suspension travels more. All of
//! it in one vertical direction:
//!
//! ```text
//! spring  ψ = ½ k_s (λ − λ_s)²         λ = z_b − z_w
//! tyre    ψ = ½ k_t (λ − λ_t)²         λ = z_w − z
//! damper  ψ = ½ μ (λ − λ0 − γ)² − F (θ/θr) (λ − λ0) + c (θ − θr − θ ln(θ/θr))
//!         γ̇ = g/η,   g = −∂ψ/∂γ,   η = η0 exp(a (1/θ − 1/θr)),   θ ṡ = g²/η + κ (θa − θ)
//! ```
//!
//! | symbol | meaning | value | source |
//! |---|---|---|---|
//! | `m_b` | mass of the body | 300 kg | chosen |
//! | `m_w/m_b`, `k_s/m_b`, `k_t/m_b` | mass of the wheel, stiffness of spring and tyre | 0.15, 63.3 s⁻², 653 s⁻² | \[1\] |
//! | η0 | viscosity at θr | 1500 N s/m | chosen: damping ratio 0.3 (that of \[1\] is high on purpose) |
//! | a | its dependence on temperature | 1306 K | 2.5 times the force at −30 °C, \[2\] |
//! | θr | reference temperature | 20 °C | of \[2\] |
//! | μ | stiffness of the mount | 500 kN/m | chosen |
//! | F | force of the gas charge at θr | 200 N | chosen |
//! | c | heat capacity: 0.2 l of oil and the tube around it | 500 J/K | chosen |
//! | κ | conductance to the air, 0.06 m² in the wind | 4 W/K | chosen |
//! | θa | air, and damper at t = 0 | −20 °C | chosen |
//! | g | gravity | 9.81 m/s² | |
//! | G₀ | roughness of the road: class D, poor | 1024·10⁻⁶ m³ | \[3\] |
//! | | waves of the road | 1 m to 100 m | chosen: a tyre rolls over shorter ones |
//! | v, L | speed, length of a lap | 20 m/s, 200 m | chosen |
//!
//! \[1\] the quarter car behind the International Roughness Index: Sayers, Transp. Res. Rec. 1501
//! (1995) 1–12. \[2\] Hryciów, Appl. Sci. 12 (2022) 12765. \[3\] ISO 8608:2016, geometric mean.
//!
//! What the example claims, and fails without: with every energy–entropy–momentum scheme and any
//! step that sees the road, energy minus work minus heat is constant to rounding (in a minute, with
//! the step of 0.005 s, to 1.3e-10 J of 1.5e5 J) and no step loses entropy; the damper warms by more
//! than 20 K in a minute, which shakes the body at least 10 % less and moves the suspension at least
//! 10 % more than a damper of constant viscosity; the wheel stays on the road, which does within 10 %
//! the work that a road of all wavelengths does, `π² G₀ n₀² v k_t`.

use std::error::Error;
use std::path::Path;
use std::process::ExitCode;

use eem::prelude::*;

mod balance;
mod car;
mod pictures;
mod ride;
mod road;

use car::{BODY, CLEARANCE, Car, DAMPER, Damper, GRAVITY, TRACK, TYRE, WINTER, car};
use eem_studies::claims::{self, Claims};
use eem_studies::command_line::CommandLine;
use eem_studies::record::Record;
use eem_studies::simulate::{self, Further, Watched};
use eem_studies::time_grid::TimeGrid;
use eem_studies::{output, terminal};
use ride::Lap;

const ABOUT: &str = "A quarter car on a rough road, whose shock absorber warms up";
const HINT: &str = "Add --out DIR for the states as CSV and pictures.";

/// A tenth of the period of the shortest wave of the road, and one minute, s.
const STEP: f64 = 0.005;
const END: f64 = 60.0;

/// Laps of that minute.
const LAPS: usize = 6;

/// The longest step (s) that the claims are about: the period of the shortest wave. Longer ones do
/// not see the road. They lose digits, too: each step ends by solving 2m/h + ½hA, where A < 0 for
/// a spring in compression, and that comes near zero when h² is near 4mλ/|f|, here (0.1 s)².
const LONGEST_STEP: f64 = 10.0 * STEP;

/// Drives the quarter car, at rest at first, and records what the tables and pictures show.
fn drive(
    name: &str,
    scheme: Scheme,
    damper: Damper,
    grid: TimeGrid,
) -> Result<Record, Box<dyn Error>> {
    let Car {
        scene,
        contact,
        wheel,
        body,
        parts,
    } = car(damper);
    let [_, _, damper] = parts;
    let watched = Watched {
        masses: vec![wheel, body],
        elements: vec![damper],
        has_reservoirs: true,
    };
    let mut simulation = Simulation::new(scene, scheme, grid.step)?;
    let further = further(contact, parts);
    simulate::record_with(name, &mut simulation, &watched, grid, further)
}

/// Columns of this example's own. A handle that is not of the scene would show as not a number.
fn further(contact: Node, [tyre, spring, damper]: [Element; 3]) -> [Further<1>; 8] {
    let value = |result: Result<f64, SceneError>| result.unwrap_or(f64::NAN);
    let road = move |run: &Simulation<1>| value(run.position(contact).map(|road| road[0]));
    let travel = move |run: &Simulation<1>| value(run.stretch(spring)) - CLEARANCE;
    let acceleration = move |run: &Simulation<1>| {
        let strut = value(run.force(spring)) + value(run.force(damper));
        -strut / BODY - GRAVITY
    };
    let tyre_force = move |run: &Simulation<1>| -value(run.force(tyre));
    [
        ("road", Quantity::custom(road)),
        ("travel", Quantity::custom(travel)),
        ("acceleration", Quantity::custom(acceleration)),
        ("tyre_force", Quantity::custom(tyre_force)),
        ("damper_energy", Quantity::InternalEnergy(damper)),
        (
            "reservoir_heat",
            Quantity::Ledger(|ledger| ledger.reservoir_heat),
        ),
        ("work", Quantity::Ledger(|ledger| ledger.work)),
        ("balance", Quantity::Ledger(|ledger| ledger.balance)),
    ]
}

fn main() -> ExitCode {
    claims::verdict(run(&CommandLine::read(ABOUT)))
}

fn run(command_line: &CommandLine) -> Result<Claims, Box<dyn Error>> {
    let grid = command_line.time_grid(STEP, END);
    let directory = command_line.out.as_deref();
    directory.map_or(Ok(()), output::prepare)?;

    let schemes = command_line.schemes();
    let frozen = DAMPER.frozen(WINTER);
    let constant = drive("constant-viscosity", schemes[0], frozen.clone(), grid)?;
    let mut runs = Vec::new();
    for scheme in schemes {
        runs.push(drive(scheme.name(), scheme, DAMPER, grid)?);
    }
    let lap_time = TRACK.lap_time();
    let laps = [&runs[0], &constant].map(|run| ride::laps(run, lap_time));
    ride::print((&DAMPER, &laps[0]), (&frozen, &laps[1]));
    balance::print(&runs);
    match directory {
        Some(directory) => write(directory, &runs, &constant, [&laps[0], &laps[1]])?,
        None => terminal::say(HINT),
    }
    let mut claims = Claims::default();
    if grid.step <= LONGEST_STEP {
        for run in &runs {
            balance::check(run, &mut claims);
        }
    }
    if runs[0].scheme.starts_with("eem-") {
        check_ride(&runs[0], [&laps[0], &laps[1]], grid, &mut claims);
    }
    Ok(claims)
}

/// The ride, when the step resolves the road and just a minute is driven: later the damper is so
/// warm that the wheel leaves the road, which a linear tyre cannot do. The first lap starts from
/// rest: the second is the first one to compare with.
fn check_ride(run: &Record, [warming, constant]: [&[Lap]; 2], grid: TimeGrid, claims: &mut Claims) {
    let complete = |laps: &[Lap]| laps.iter().filter(|lap| lap.is_complete).count();
    if grid.step > STEP || complete(warming) != LAPS || complete(constant) != LAPS {
        return;
    }
    let (warm, cold) = (warming[LAPS - 1], constant[LAPS - 1]);
    claims.at_most(
        "the change of the ride with constant viscosity",
        Some((cold.acceleration / constant[1].acceleration - 1.0).abs()),
        0.001,
    );
    claims.at_least(
        "the damper's rise in temperature in a minute (K)",
        Some(warm.temperature - WINTER),
        20.0,
    );
    claims.at_most(
        "acceleration with a warm damper, as a share of that with a cold one",
        Some(warm.acceleration / cold.acceleration),
        0.9,
    );
    claims.at_least(
        "travel with a warm damper, as a share of that with a cold one",
        Some(warm.travel / cold.travel),
        1.1,
    );
    let tyre = run.column("tyre_force").unwrap_or_default();
    let lightest = tyre.iter().copied().reduce(f64::min);
    claims.at_least("the least load on the road (N)", lightest, 0.0);
    let share = balance::mean_power(run).map(|power| (power / TRACK.power(TYRE) - 1.0).abs());
    claims.at_most("the road's power, off that of all waves", share, 0.1);
}

/// CSV files and pictures.
fn write(
    directory: &Path,
    runs: &[Record],
    constant: &Record,
    laps: [&[Lap]; 2],
) -> Result<(), Box<dyn Error>> {
    for run in runs.iter().chain([constant]) {
        output::write_csv(directory, run)?;
    }
    pictures::write(directory, runs, constant, laps)?;
    terminal::say(format_args!("States and pictures: {}", directory.display()));
    Ok(())
}
