//! The pendulum of a member: a spring whose numbers are drawn at random, and what is kept of its run.

use eem::Scalar;
use eem::prelude::*;
use eem::{MemberError, MemberFailure};
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};

/// Any number would do; the same one draws the same springs.
const SEED: u64 = 2012;

/// Nonlinear in length and temperature, viscous, softening when hot.
#[derive(Clone, Debug, FreeEnergy)]
#[free_energy(|lambda: Stretch, gamma: Viscous, theta: Temperature| {
    let strain = ln(lambda / natural_length);
    let heating = theta - theta_ref;
    let elastic = 0.5 * (k0 - k1 * heating) * strain.powi(2)
        - thermal_coupling * heating * strain
        + capacity * (heating - theta * ln(theta / theta_ref));
    (1 + viscous_coupling) * elastic
        + (mu0 - mu1 * heating) * gamma.powi(2)
        - viscous_coupling * gamma * diff(elastic, lambda)
})]
#[viscosity(gamma = eta0 * exp(a * (1 / theta - 1 / theta_ref)))]
struct CreepingSpring {
    natural_length: f64,
    theta_ref: f64,
    k0: f64,
    k1: f64,
    thermal_coupling: f64,
    capacity: f64,
    viscous_coupling: f64,
    mu0: f64,
    mu1: f64,
    eta0: f64,
    a: f64,
}

/// The temperature of the surroundings, K.
const SURROUNDINGS: f64 = 300.0;

/// A quantity that is known to lie within `mean ± spread`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Unknown {
    pub(crate) name: &'static str,
    pub(crate) label: &'static str,
    mean: f64,
    spread: f64,
}

/// What the members differ in.
#[derive(Clone, Debug)]
pub(crate) struct Spring {
    /// Stiffness (N m), viscosity (N s/m), conductance (W/K), initial temperature (K) and speed
    /// (m/s): the values of [`Spring::UNKNOWNS`].
    pub(crate) values: [f64; 5],
}

impl Spring {
    /// What is not known well.
    pub(crate) const UNKNOWNS: [Unknown; 5] = [
        unknown("stiffness", "stiffness k0 (N m)", 100.0, 10.0),
        unknown("viscosity", "viscosity η0 (N s/m)", 100.0, 30.0),
        unknown("conductance", "conductance κ (W/K)", 0.1, 0.05),
        unknown(
            "initial_temperature",
            "initial temperature (K)",
            300.0,
            10.0,
        ),
        unknown("initial_speed", "initial speed (m/s)", 1.0, 0.5),
    ];

    /// So many springs; the first ones are always the same.
    pub(crate) fn draw(members: usize) -> Vec<Self> {
        let mut random = ChaCha8Rng::seed_from_u64(SEED);
        let mut spring = || Self {
            values: Self::UNKNOWNS.map(|unknown| {
                let position: f64 = random.random();
                unknown.mean + unknown.spread * (2.0 * position - 1.0)
            }),
        };
        (0..members).map(|_| spring()).collect()
    }
}

/// A pendulum on such a spring, for so many steps.
#[derive(Debug)]
pub(crate) struct Pendulum {
    pub(crate) steps: usize,
}

impl Pendulum {
    /// The scene of a member, and its spring.
    pub(crate) fn build(spring: &Spring) -> (Scene<2>, Element) {
        let [k0, eta0, conductance, temperature, speed] = spring.values;
        let mut scene = Scene::<2>::new();
        let pivot = scene.anchor([0.0; 2]);
        let bob = scene.mass(1.0, [3.0, 0.0], [0.0, speed]);
        let law = CreepingSpring {
            natural_length: 1.0,
            theta_ref: SURROUNDINGS,
            k0,
            k1: 0.5,
            thermal_coupling: 4.0,
            capacity: 1.0,
            viscous_coupling: 0.1,
            mu0: 5.0,
            mu1: 0.1,
            eta0,
            a: 10.0,
        };
        let spring = scene.spring(law, [pivot, bob]);
        scene.set_temperature(spring, temperature);
        let surroundings = scene.reservoir(SURROUNDINGS);
        scene.conduct(spring, surroundings, conductance);
        (scene, spring)
    }

    /// Runs a member; what is kept of it.
    pub(crate) fn observe(
        &self,
        run: &mut Simulation<2>,
        spring: Element,
    ) -> Result<End, MemberFailure> {
        let start = run.ledger();
        let mut entropy = start.entropy;
        let mut energy_defect = 0.0;
        let mut entropy_loss = f64::NEG_INFINITY;
        let last_quarter = self.steps - self.steps.div_ceil(4);
        let mut temperatures = 0.0;
        for step in 0..self.steps {
            run.step()?;
            let ledger = run.ledger();
            let defect = (ledger.energy - start.energy).abs() / start.energy.abs();
            energy_defect = Scalar::maximum(energy_defect, defect);
            entropy_loss = Scalar::maximum(entropy_loss, entropy - ledger.entropy);
            entropy = ledger.entropy;
            if step >= last_quarter {
                temperatures += run.temperature(spring)?;
            }
        }
        Ok(End {
            temperature: temperatures / counted(self.steps - last_quarter),
            entropy: entropy - start.entropy,
            energy_defect,
            entropy_loss,
        })
    }

    /// Runs members in an ensemble.
    pub(crate) fn run(
        &self,
        ensemble: Ensemble<'_>,
        springs: &[Spring],
    ) -> Vec<Result<End, MemberError>> {
        ensemble.run(springs, Self::build, |run, spring, _| {
            self.observe(run, spring)
        })
    }
}

const fn unknown(name: &'static str, label: &'static str, mean: f64, spread: f64) -> Unknown {
    Unknown {
        name,
        label,
        mean,
        spread,
    }
}

/// What is kept of a member.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct End {
    /// The mean of θ over the last quarter of the run, K: the spring is colder when it is long.
    pub(crate) temperature: f64,
    /// S − S₀ of spring and surroundings, J/K.
    pub(crate) entropy: f64,
    /// The largest |E − E₀|/|E₀| along the run.
    pub(crate) energy_defect: f64,
    /// The largest loss of S in a step, J/K: negative by the second law.
    pub(crate) entropy_loss: f64,
}

#[expect(clippy::cast_precision_loss, reason = "steps are far fewer than 2^53")]
fn counted(steps: usize) -> f64 {
    steps as f64
}
