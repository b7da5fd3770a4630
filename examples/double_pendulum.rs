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
//! third is also example 2 of Kern, Romero, Conde Martín & García Orden (2021).
//!
//! The source gives the data of the first two cases without units; they are read here in those of the
//! table, in which ψ is in J. The strain ln(λ/λ0) is a pure number, so that stiffnesses are energies.
//!
//! What the example claims, and fails without: every energy–entropy–momentum scheme reaches the
//! end, keeps energy and angular momentum to rounding, and loses no entropy in any step.

use std::error::Error;
use std::path::Path;
use std::process::ExitCode;

use clap::{Parser, ValueEnum};
use eem::prelude::*;

mod support;

use support::claims::{self, Claims, Laws};
use support::command_line::{self, CommandLine};
use support::comparison::{Comparison, Plot};
use support::record::Record;
use support::simulate::{self, Watched};
use support::statistics;
use support::time_grid::TimeGrid;
use support::{output, table, terminal};

const HINT: &str = "Add --out DIR for the states as CSV and the figures of the paper.";
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

/// Stiffness logarithmic in the temperature, or constant when `softening` is zero.
#[derive(Clone, Copy, Debug, FreeEnergy)]
#[free_energy(|lambda: Stretch, theta: Temperature| {
    let strain = ln(lambda / natural_length);
    let current_stiffness = stiffness - softening * theta_ref * ln(theta / theta_ref);
    0.5 * current_stiffness * strain.powi(2)
        - coupling * (theta - theta_ref) * strain
        + capacity * (theta - theta_ref - theta * ln(theta / theta_ref))
})]
struct ThermoelasticSpring {
    #[unit("J")]
    stiffness: f64,
    #[unit("J/K")]
    softening: f64,
    #[unit("J/K")]
    coupling: f64,
    #[unit("J/K")]
    capacity: f64,
    #[unit("m")]
    natural_length: f64,
    #[unit("K")]
    theta_ref: f64,
}

/// One of the published cases; SI units, first what belongs to the anchor's side.
#[derive(Clone, Copy, Debug)]
struct Case {
    springs: [ThermoelasticSpring; 2],
    temperatures: [f64; 2],
    conductance: f64,
    masses: [f64; 2],
    positions: [[f64; 3]; 2],
    momenta: [[f64; 3]; 2],
    end: f64,
    step: f64,
    /// The reference takes steps of at most this size (s).
    reference_step: f64,
    /// Until when (s) it is meaningful to compare positions: later the motion is chaotic, and
    /// paths part from the slightest difference.
    comparable: f64,
    /// Until when (s) lengths are drawn, to tell one oscillation from the next.
    drawn: f64,
    /// What rounding may do to the energy, relative to itself.
    energy_defect: f64,
}

/// What rounding may do to E over the run. The state is kept to twice the working precision and
/// energy is closed in every step, so that its defect does not grow with their number; evaluating E
/// from the state costs a dozen roundings of ε/2.
const ENERGY_DEFECT: f64 = 4e-15;

/// The same over 500 s: what closing leaves of a step's defect adds up like a random walk.
const ENERGY_DEFECT_OF_LONG_RUNS: f64 = 2e-14;

/// What rounding may do to J, relative to itself: J is a difference of products whose sum Σ|q||p| is
/// up to 430 times as large (romero, whose springs become 150 m long), and 430 ε is 1e-13.
const MOMENTUM_DEFECT: f64 = 1e-13;

/// What rounding may take from S in a step, in units in the last place.
const ENTROPY_LOSS: f64 = 2.0;

/// The reference's step is at most this share of the schemes' step.
const REFERENCE_SHARE: f64 = 0.05;

/// The reference is recorded at least this often (s), to draw a smooth curve.
const REFERENCE_SAMPLING: f64 = 0.05;

const SOFT_SPRING: ThermoelasticSpring = ThermoelasticSpring {
    stiffness: 0.1,
    softening: 0.0,
    coupling: 0.2,
    capacity: 5.0,
    natural_length: 2.0,
    theta_ref: 300.0,
};

const STIFF_SPRING: ThermoelasticSpring = ThermoelasticSpring {
    stiffness: 100.0,
    capacity: 1000.0,
    ..SOFT_SPRING
};

const LOGARITHMIC_SPRING: ThermoelasticSpring = ThermoelasticSpring {
    stiffness: 5000.0,
    softening: 50.0,
    coupling: 20.0,
    capacity: 5000.0,
    ..SOFT_SPRING
};

const ROMERO: Case = Case {
    springs: [
        SOFT_SPRING,
        ThermoelasticSpring {
            stiffness: 1.0,
            natural_length: 1.0,
            ..SOFT_SPRING
        },
    ],
    temperatures: [380.0, 310.0],
    conductance: 300.0,
    masses: [1.0, 2.0],
    positions: [[1.0, 0.0, 0.0], [2.2, 0.0, 0.0]],
    momenta: [[0.0, 2.0, 0.0], [1.0, 0.0, 0.0]],
    end: 25.0,
    step: 0.3,
    reference_step: 2e-3,
    comparable: f64::INFINITY,
    drawn: f64::INFINITY,
    energy_defect: ENERGY_DEFECT,
};

const KRUEGER: Case = Case {
    springs: [
        STIFF_SPRING,
        ThermoelasticSpring {
            natural_length: 1.0,
            ..STIFF_SPRING
        },
    ],
    conductance: 10.0,
    momenta: [[0.0, 1.0, 0.0], [0.0, 4.4, 0.0]],
    end: 500.0,
    step: 0.1,
    reference_step: 2.5e-3,
    comparable: 2.0,
    drawn: 10.0,
    energy_defect: ENERGY_DEFECT_OF_LONG_RUNS,
    ..ROMERO
};

const LOG: Case = Case {
    springs: [
        LOGARITHMIC_SPRING,
        ThermoelasticSpring {
            stiffness: 10_000.0,
            softening: 60.0,
            capacity: 2000.0,
            natural_length: 1.0,
            ..LOGARITHMIC_SPRING
        },
    ],
    temperatures: [380.0, 298.0],
    conductance: 300.0,
    masses: [10.0, 20.0],
    positions: [[3.0, 0.0, 0.5], [3.0, 1.0, 1.0]],
    momenta: [[0.0, 10.0, 0.0], [0.0, 0.0, -20.0]],
    end: 25.0,
    step: 0.1,
    reference_step: 1e-3,
    comparable: 10.0,
    drawn: 12.5,
    energy_defect: ENERGY_DEFECT,
};

impl CaseName {
    const fn case(self) -> Case {
        match self {
            Self::Romero => ROMERO,
            Self::Krueger => KRUEGER,
            Self::Log => LOG,
        }
    }
}

impl Case {
    /// The pendulum at t = 0, and what to record of it.
    fn pendulum(&self, scheme: Scheme, step: f64) -> Result<(Simulation<3>, Watched), SceneError> {
        let mut scene = Scene::<3>::new();
        let anchor = scene.anchor([0.0; 3]);
        let masses = [0, 1].map(|i| {
            let mass = scene.mass(self.masses[i], self.positions[i], [0.0; 3]);
            scene.set_momentum(mass, self.momenta[i]);
            mass
        });
        let ends = [[anchor, masses[0]], masses];
        let springs = [0, 1].map(|i| {
            let spring = scene.spring(self.springs[i], ends[i]);
            scene.set_temperature(spring, self.temperatures[i]);
            spring
        });
        scene.conduct(springs[0], springs[1], self.conductance);
        let watched = Watched {
            masses: masses.to_vec(),
            elements: springs.to_vec(),
            has_reservoirs: false,
        };
        Ok((Simulation::new(scene, scheme, step)?, watched))
    }

    /// The same motion in steps so small that the scheme no longer matters while positions are
    /// comparable.
    fn reference(&self, grid: TimeGrid) -> Result<Record, SceneError> {
        let longest = self.reference_step.min(REFERENCE_SHARE * grid.step);
        let grid = grid.refined(longest, REFERENCE_SAMPLING);
        let (mut simulation, watched) = self.pendulum(Scheme::EemTemperature, grid.step)?;
        simulate::record("reference", &mut simulation, &watched, grid)
    }
}

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
    table::print(&runs, Some(&reference.until(case.comparable)));
    if case.comparable < grid.end() {
        terminal::say(CHAOS);
    }
    match directory {
        Some(directory) => write(directory, &case, &reference, &runs)?,
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
    case: &Case,
    reference: &Record,
    runs: &[Record],
) -> Result<(), Box<dyn Error>> {
    for run in runs {
        output::write_csv(directory, run)?;
    }
    let early: Vec<Record> = runs.iter().map(|run| run.until(case.drawn)).collect();
    let (early, early_reference) = (early.as_slice(), &reference.until(case.drawn));
    let comparison = |reference, runs| Comparison { reference, runs };
    comparison(Some(early_reference), early).write(directory, &LENGTHS)?;
    comparison(Some(reference), runs).write(directory, &HISTORIES)?;
    comparison(None, runs).write(directory, &DEFECTS)?;
    terminal::say(format_args!("States and figures: {}", directory.display()));
    Ok(())
}

/// Figures 3, 7, 9 and 12 of the paper.
const LENGTHS: [Plot; 2] = [
    Plot::history("length_1", "Length of spring 1", "length λ₁ (m)", |run| {
        run.norms("q1_")
    }),
    Plot::history("length_2", "Length of spring 2", "length λ₂ (m)", |run| {
        run.distances("q1_", "q2_")
    }),
];

/// Figures 4 to 6, 8, 10, 11 and 13 to 17 of the paper.
const HISTORIES: [Plot; 5] = [
    Plot::history(
        "temperature_1",
        "Temperature of spring 1",
        "temperature θ₁ (K)",
        |run| run.points("time", "theta_1"),
    ),
    Plot::history(
        "temperature_2",
        "Temperature of spring 2",
        "temperature θ₂ (K)",
        |run| run.points("time", "theta_2"),
    ),
    Plot::history("energy", "Total energy", "total energy E (J)", |run| {
        run.points("time", "energy")
    }),
    Plot::history("entropy", "Total entropy", "total entropy S (J/K)", |run| {
        run.points("time", "entropy")
    }),
    Plot::history(
        "angular_momentum",
        "Angular momentum",
        "angular momentum |J| (kg m²/s)",
        |run| run.norms("angular_momentum_"),
    ),
];

/// Figures 7 and 9 of Kern et al. (2021), as bounds.
const DEFECTS: [Plot; 2] = [
    Plot::defect(
        "energy_defect",
        "Largest defect of the energy so far",
        "|E − E₀| / |E₀|",
        statistics::energy_defects,
    ),
    Plot::defect(
        "angular_momentum_defect",
        "Largest defect of the angular momentum so far",
        "|J − J₀| / |J₀|",
        statistics::angular_momentum_defects,
    ),
];
