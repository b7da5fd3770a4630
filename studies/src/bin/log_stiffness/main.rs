//! The entropy form where s(θ) has no closed inverse.
//!
//! A thermodynamic scheme may carry the temperature θ or the entropy s of a spring. The entropy
//! form needs the internal energy as a function of entropy, e(λ, s) = ψ + θ̂ s, and hence the
//! temperature θ̂(λ, s). For this spring that is no formula:
//!
//! ```text
//! ψ = C(θ)/2 ln²(λ/λ0) − β (θ − θr) ln(λ/λ0) + c (θ − θr − θ ln(θ/θr)),   C = C0 − C1 θr ln(θ/θr)
//! s = −∂ψ/∂θ = C1 θr/(2θ) ln²(λ/λ0) + β ln(λ/λ0) + c ln(θ/θr)
//! ```
//!
//! because θ stands in a reciprocal and in a logarithm. The papers therefore say that this choice
//! "makes impossible the use of the entropy-based formulation" (Conde Martín, Betsch & García
//! Orden 2016, §4.2), and that "the EEM method in entropy formulation is ruled out" (Kern, Romero,
//! Conde Martín & García Orden 2021, §IV.B). They go on in temperatures.
//!
//! No formula is needed, only a number: s grows with θ wherever the heat capacity θ ∂s/∂θ is
//! positive, so that Newton's method in ln θ finds θ̂(λ, s) to rounding. Its derivatives are known
//! without a formula, too: ∂θ̂/∂s = 1/(∂s/∂θ), ∂θ̂/∂λ = −(∂s/∂λ)/(∂s/∂θ). The discrete
//! derivatives of e(λ, s), with both states known, are then as exact as any others; a step asks
//! for two temperatures of each spring per iteration, that of the new length with the old entropy
//! and that of the old length with the new entropy.
//!
//! The example runs the double pendulum of the papers with this spring, counts what the
//! inversions cost, and puts the entropy form beside the other schemes.
//!
//! | symbol | meaning | value |
//! |---|---|---|
//! | q, p, m | positions, momenta, masses | q = (3, 0, 0.5), (3, 1, 1) m, p = (0, 10, 0), (0, 0, −20) kg m/s at t = 0; m = 10, 20 kg |
//! | λ, λ0 | lengths of the springs, natural lengths | λ0 = 2, 1 m |
//! | θ, θr | temperatures, that without thermal stress | θ = 380, 298 K at t = 0, θr = 300 K |
//! | C0, C1 | stiffnesses, their softening with temperature | 5000, 10000 J; 50, 60 J/K |
//! | β, c | thermoelastic coupling, heat capacities | 20 J/K; 5000, 2000 J/K |
//! | κ | heat conductance between the springs | 300 W/K |
//!
//! Source: the papers named above, 25 s in steps of 0.1 s. Their equations of motion are those of
//! the example `double_pendulum`, which draws all figures.
//!
//! What the example claims, and fails without: both energy–entropy–momentum schemes reach the end
//! and keep the laws to rounding; every inversion of the run meets its entropy to rounding within
//! five evaluations.

use std::error::Error;
use std::path::Path;
use std::process::ExitCode;

use eem::invert;
use eem::prelude::*;

use eem_studies::claims::{self, Claims, Laws};
use eem_studies::command_line::CommandLine;
use eem_studies::comparison::{Comparison, Plot};
use eem_studies::record::Record;
use eem_studies::simulate::{self, Watched};
use eem_studies::time_grid::TimeGrid;
use eem_studies::{defects, output, statistics, terminal};

const ABOUT: &str = "Energy, entropy and momentum kept in entropy form, without a formula for θ(s)";
const HINT: &str = "Add --out DIR for the states as CSV and a picture of the energy defects.";

/// Step and end time of the papers, s.
const STEP: f64 = 0.1;
const END: f64 = 25.0;

/// What rounding may do to the laws over the run; see the example `double_pendulum`.
const LAWS: Laws = Laws {
    energy: 4e-15,
    angular_momentum: 1e-13,
    entropy: 2.0,
};

/// The most evaluations of s that an inversion takes: the start is right to two digits, and each of
/// Newton's steps doubles them; one more evaluation confirms the result.
const EVALUATIONS: usize = 5;

/// How well an inversion meets the entropy, in units of ε (Σ|terms of s| + θ ∂s/∂θ): evaluating s
/// costs about one of the first part, twice, and writing θ̂ as a double half of the second.
const RESIDUAL: f64 = 2.0;

/// Starts (K) far from any temperature of the run, but where the heat capacity is positive.
const FAR_STARTS: [f64; 2] = [30.0, 1e6];

/// Stiffness logarithmic in the temperature.
#[derive(Clone, Copy, Debug, FreeEnergy)]
#[free_energy(|lambda: Stretch, theta: Temperature| {
    let strain = ln(lambda / natural_length);
    let current_stiffness = stiffness - softening * theta_ref * ln(theta / theta_ref);
    0.5 * current_stiffness * strain.powi(2)
        - coupling * (theta - theta_ref) * strain
        + capacity * (theta - theta_ref - theta * ln(theta / theta_ref))
})]
struct SofteningSpring {
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

const SPRINGS: [SofteningSpring; 2] = [
    SofteningSpring {
        stiffness: 5000.0,
        softening: 50.0,
        coupling: 20.0,
        capacity: 5000.0,
        natural_length: 2.0,
        theta_ref: 300.0,
    },
    SofteningSpring {
        stiffness: 10_000.0,
        softening: 60.0,
        coupling: 20.0,
        capacity: 2000.0,
        natural_length: 1.0,
        theta_ref: 300.0,
    },
];

/// The pendulum at t = 0, and what to record of it.
fn pendulum(scheme: Scheme, step: f64) -> Result<(Simulation<3>, Watched), SceneError> {
    let mut scene = Scene::<3>::new();
    let anchor = scene.anchor([0.0; 3]);
    let first = scene.mass(10.0, [3.0, 0.0, 0.5], [0.0, 1.0, 0.0]);
    let second = scene.mass(20.0, [3.0, 1.0, 1.0], [0.0, 0.0, -1.0]);
    let springs = [
        scene.spring(SPRINGS[0], [anchor, first]),
        scene.spring(SPRINGS[1], [first, second]),
    ];
    scene.set_temperature(springs[0], 380.0);
    scene.set_temperature(springs[1], 298.0);
    scene.conduct(springs[0], springs[1], 300.0);
    let watched = Watched {
        masses: vec![first, second],
        elements: springs.to_vec(),
        has_reservoirs: false,
    };
    Ok((Simulation::new(scene, scheme, step)?, watched))
}

fn main() -> ExitCode {
    claims::verdict(run(&CommandLine::read(ABOUT)))
}

fn run(command_line: &CommandLine) -> Result<Claims, Box<dyn Error>> {
    let grid = command_line.time_grid(STEP, END);
    let directory = command_line.out.as_deref();
    directory.map_or(Ok(()), output::prepare)?;

    let inversions = Inversions::along_a_run(grid)?;
    inversions.print();
    let mut runs = Vec::new();
    for scheme in command_line.schemes() {
        let (mut simulation, watched) = pendulum(scheme, grid.step)?;
        runs.push(simulate::record(
            scheme.name(),
            &mut simulation,
            &watched,
            grid,
        )?);
    }
    defects::print(&runs, None);
    match directory {
        Some(directory) => write(directory, &runs)?,
        None => terminal::say(HINT),
    }
    Ok(check(&inversions, &runs))
}

/// What the inversions of a run needed and reached.
#[derive(Debug, Default)]
struct Inversions {
    /// How many there were.
    count: u32,
    /// Evaluations of s, all together and at most.
    evaluations: u32,
    most_evaluations: usize,
    /// Most evaluations from the [`FAR_STARTS`].
    far_evaluations: usize,
    /// max |s(θ̂) − s| / (ε (Σ|terms of s| + θ ∂s/∂θ)).
    residual: f64,
    /// max |θ̂ − start|, K.
    distance: f64,
}

impl Inversions {
    /// Runs the entropy form and repeats the inversions of every step's last iteration: the
    /// temperatures at the mixed corners (λ¹, s⁰) and (λ⁰, s¹), from those of the states nearby.
    fn along_a_run(grid: TimeGrid) -> Result<Self, Box<dyn Error>> {
        let (mut simulation, watched) = pendulum(Scheme::EemEntropy, grid.step)?;
        let mut inversions = Self::default();
        let state = |simulation: &Simulation<3>, spring| {
            let lambda = simulation.stretch(spring)?;
            let entropy = simulation.entropy(spring)?;
            Ok::<_, SceneError>((lambda, entropy, simulation.temperature(spring)?))
        };
        for _ in 0..grid.steps {
            let old = [0, 1].map(|i| state(&simulation, watched.elements[i]));
            simulation.step()?;
            for ((model, old), &spring) in SPRINGS.iter().zip(old).zip(&watched.elements) {
                let (lambda_0, entropy_0, theta_0) = old?;
                let (lambda_1, entropy_1, theta_1) = state(&simulation, spring)?;
                inversions.repeat(model, lambda_1, entropy_0, theta_0)?;
                inversions.repeat(model, lambda_0, entropy_1, theta_1)?;
            }
        }
        Ok(inversions)
    }

    /// Finds the temperature at length `lambda` and entropy `entropy`, from `start` and from far
    /// away.
    fn repeat(
        &mut self,
        model: &SofteningSpring,
        lambda: f64,
        entropy: f64,
        start: f64,
    ) -> Result<(), eem::InversionError> {
        let caloric = |theta: f64| FreeEnergy::<f64>::caloric(model, &[lambda, theta]);
        let found = invert(caloric, entropy, start)?;
        let reached = caloric(found.temperature);
        let noise = f64::EPSILON * (reached.magnitude + reached.heat_capacity);
        self.count += 1;
        self.evaluations += u32::try_from(found.evaluations).unwrap_or(u32::MAX);
        self.most_evaluations = self.most_evaluations.max(found.evaluations);
        self.residual = self.residual.max((reached.entropy - entropy).abs() / noise);
        self.distance = self.distance.max((found.temperature - start).abs());
        for far in FAR_STARTS {
            let evaluations = invert(caloric, entropy, far)?.evaluations;
            self.far_evaluations = self.far_evaluations.max(evaluations);
        }
        Ok(())
    }

    fn print(&self) {
        let Self {
            count,
            most_evaluations: most,
            far_evaluations: far,
            residual,
            distance,
            ..
        } = self;
        let mean = f64::from(self.evaluations) / f64::from(*count);
        let [cold, hot] = FAR_STARTS;
        terminal::say(format_args!(
            "No formula gives the temperature of this spring from its entropy; Newton's method does.\n\
             {count} inversions s = s(λ, θ) of a run in entropy form, from up to {distance:.2} K away:\n\
             - {mean:.2} evaluations of s on average and {most} at most; {far} from {cold} K or {hot:e} K;\n\
             - s is met within {residual:.1} ε (Σ|terms of s| + θ ∂s/∂θ): to rounding.\n"
        ));
    }
}

/// CSV files and the picture.
fn write(directory: &Path, runs: &[Record]) -> Result<(), Box<dyn Error>> {
    for run in runs {
        output::write_csv(directory, run)?;
    }
    let reference = None;
    Comparison {
        case: "",
        reference,
        runs,
    }
    .write(directory, &[ENERGY_DEFECT])?;
    terminal::say(format_args!("States and picture: {}", directory.display()));
    Ok(())
}

const ENERGY_DEFECT: Plot = Plot::defect(
    "energy_defect",
    "Stiffness logarithmic in θ: largest defect of the energy so far",
    "|E − E₀| / |E₀|",
    statistics::energy_defects,
);

/// The claims about the inversions, and about the energy–entropy–momentum schemes as far as they
/// were run.
fn check(inversions: &Inversions, runs: &[Record]) -> Claims {
    let mut claims = Claims::default();
    let most = inversions.most_evaluations;
    claims.holds(
        most <= EVALUATIONS,
        format!("an inversion took {most} evaluations, claimed are at most {EVALUATIONS}"),
    );
    claims.at_most(
        "the largest residual of an inversion (units of rounding)",
        Some(inversions.residual),
        RESIDUAL,
    );
    for run in runs.iter().filter(|run| run.scheme.starts_with("eem-")) {
        claims.keeps_the_laws(run, &LAWS);
    }
    claims
}
