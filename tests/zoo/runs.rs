//! A short run of every specimen in both energy–entropy–momentum forms: what the laws say.

use eem::prelude::*;

use crate::families;
use crate::specimen::Specimen;

/// A few roundings of a sum of a handful of terms, relative to the sum of their magnitudes.
const ENERGY: f64 = 4e-15;
/// A difference of two rounded sums can be off by an ulp of each.
const ENTROPY: f64 = -2.0;
/// The same for the angular momentum.
const MOMENTUM: f64 = 4e-15;
const STEPS: usize = 60;
/// Step size over the time in which the bond at rest turns its phase by one radian.
const STEP: f64 = 0.3;
/// Speed over that which takes the mass a tenth of its home far.
const SPEED: f64 = 1.0;
/// Part of the heat that one step takes away from a difference of temperatures.
const COOLING: f64 = 0.02;
/// Temperature of the air over that of the specimen.
const AIR: f64 = 0.97;

/// A mass of one kilogram on a specimen that is anchored, in air.
struct Run {
    simulation: Simulation<2>,
    spring: Element,
    dashpots: usize,
    thermal: bool,
}

impl Run {
    fn new(specimen: &dyn Specimen, scheme: Scheme) -> Self {
        let (x, home) = (specimen.state(), specimen.home());
        let stiffness = specimen.hessian(x)[x.len()].abs();
        let step = STEP / stiffness.sqrt();
        let speed = SPEED * stiffness.sqrt() * 0.1 * (home[0][1] - home[0][0]);
        let mut scene = Scene::<2>::new();
        let pivot = scene.anchor([0.0, 0.0]);
        let bob = scene.mass(1.0, [x[0], 0.0], [0.6 * speed, 0.8 * speed]);
        let spring = specimen.spring(&mut scene, [pivot, bob]);
        for (dashpot, &gamma) in x[1..=specimen.dashpots()].iter().enumerate() {
            scene.set_viscous_stretch(spring, dashpot, gamma);
        }
        if let (true, &[.., theta]) = (specimen.thermal(), x) {
            scene.set_temperature(spring, theta);
            let air = scene.reservoir(AIR * theta);
            let conductance = COOLING * specimen.caloric(x).heat_capacity / step;
            scene.conduct(spring, air, conductance);
        }
        let simulation = Simulation::new(scene, scheme, step).expect("the state is sound");
        Self {
            simulation,
            spring,
            dashpots: specimen.dashpots(),
            thermal: specimen.thermal(),
        }
    }

    /// The present variables of the element.
    fn variables(&self) -> Result<Vec<f64>, SceneError> {
        let run = &self.simulation;
        let mut x = vec![run.stretch(self.spring)?];
        for dashpot in 0..self.dashpots {
            x.push(run.viscous_stretch(self.spring, dashpot)?);
        }
        if self.thermal {
            x.push(run.temperature(self.spring)?);
        }
        Ok(x)
    }

    /// What the energy is the sum of: kinetic energy, ψ, θ s and the heat that went elsewhere.
    fn energy_scale(&self, specimen: &dyn Specimen) -> Result<f64, SceneError> {
        let (ledger, x) = (self.simulation.ledger(), self.variables()?);
        let bound = match x[..] {
            [.., theta] if self.thermal => (theta * specimen.caloric(&x).entropy).abs(),
            _ => 0.0,
        };
        let gone = ledger.reservoir_heat.abs() + ledger.lost_heat.abs();
        Ok(ledger.kinetic_energy + specimen.free_energy(&x).abs() + bound + gone)
    }
}

/// The largest violations of a run.
#[derive(Debug, Default)]
struct Laws {
    energy: f64,
    entropy_ulps: f64,
    momentum: f64,
}

fn run(specimen: &dyn Specimen, scheme: Scheme) -> Result<Laws, Box<dyn std::error::Error>> {
    let mut run = Run::new(specimen, scheme);
    let start = run.simulation.ledger();
    let (mut before, mut scale) = (start, run.energy_scale(specimen)?);
    let (mut defect, mut laws) = (0.0_f64, Laws::default());
    for _ in 0..STEPS {
        run.simulation.step()?;
        let ledger = run.simulation.ledger();
        scale = scale.max(run.energy_scale(specimen)?);
        defect = largest(defect, (ledger.energy - start.energy).abs());
        let entropy = ledger.element_entropy.abs() + ledger.reservoir_entropy.abs();
        let change = ledger.entropy - before.entropy;
        if entropy > 0.0 {
            laws.entropy_ulps = laws.entropy_ulps.min(change / (f64::EPSILON * entropy));
        }
        let turn = (ledger.angular_momentum[2] - start.angular_momentum[2]).abs();
        laws.momentum = largest(laws.momentum, turn / start.angular_momentum[2].abs());
        before = ledger;
    }
    laws.energy = defect / scale;
    Ok(laws)
}

/// The larger one, and NaN if either is.
fn largest(a: f64, b: f64) -> f64 {
    if a >= b || a.is_nan() { a } else { b }
}

#[test]
fn every_specimen_keeps_energy_and_produces_entropy() {
    let mut wrong = Vec::new();
    for specimen in families::all() {
        for scheme in [Scheme::EemEntropy, Scheme::EemTemperature] {
            let what = format!("{:22} {:16}", specimen.name(), scheme.name());
            match run(&*specimen, scheme) {
                Ok(laws) => {
                    let Laws {
                        energy,
                        entropy_ulps,
                        momentum,
                    } = laws;
                    let what =
                        format!("{what} {energy:8.1e} {entropy_ulps:6.2} ulp {momentum:8.1e}");
                    println!("{what}");
                    let kept = energy <= ENERGY && entropy_ulps >= ENTROPY && momentum <= MOMENTUM;
                    wrong.extend((!kept).then_some(what));
                }
                Err(error) => wrong.push(format!("{what} {error}")),
            }
        }
    }
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
}
