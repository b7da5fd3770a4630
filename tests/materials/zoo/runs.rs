//! A short run of every specimen in both energy–entropy–momentum forms: what the laws say.

use eem::prelude::*;
use eem_testkit::table;

use crate::zoo::families::{self, springs};
use crate::zoo::specimen::{Formula as _, Specimen};

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
/// Temperature of the air over that of the specimen; none where it is insulated, so that without
/// dashpots the entropy has to stay as it is.
const AIR: [Option<f64>; 2] = [Some(0.97), None];

/// A mass of one kilogram on a specimen that is anchored, in air.
struct Run {
    simulation: Simulation<2>,
    spring: Element,
    dashpots: usize,
    thermal: bool,
}

impl Run {
    fn new(specimen: &dyn Specimen, scheme: Scheme, air: Option<f64>) -> Self {
        let (x, home) = (specimen.state(), specimen.home());
        let stiffness = specimen.hessian(x)[x.len()].abs();
        let step = STEP / stiffness.sqrt();
        let speed = SPEED * stiffness.sqrt() * 0.1 * (home[0][1] - home[0][0]);
        let mut scene = Scene::<2>::new();
        let pivot = scene.anchor([0.0, 0.0]);
        let bob = scene.mass(1.0, [x[0], 0.0], [0.6 * speed, 0.8 * speed]);
        let spring = table::spring(&mut scene, specimen.table(), [pivot, bob]);
        for (dashpot, &gamma) in x[1..=specimen.dashpots()].iter().enumerate() {
            scene.set_viscous_stretch(spring, dashpot, gamma);
        }
        if let (true, &[.., theta]) = (specimen.thermal(), x) {
            scene.set_temperature(spring, theta);
            if let Some(ratio) = air {
                let air = scene.reservoir(ratio * theta);
                let conductance = COOLING * specimen.caloric(x).heat_capacity / step;
                scene.conduct(spring, air, conductance);
            }
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

    /// What the energy is the sum of: kinetic energy, ψ, θ s and the heat that went elsewhere; and
    /// C θ, because e counts temperatures from a reference and their rounding does not.
    fn energy_scale(&self, specimen: &dyn Specimen) -> Result<f64, SceneError> {
        let (ledger, x) = (self.simulation.ledger(), self.variables()?);
        let thermal = match x[..] {
            [.., theta] if self.thermal => {
                let caloric = specimen.caloric(&x);
                theta * (caloric.entropy.abs() + caloric.heat_capacity)
            }
            _ => 0.0,
        };
        let gone = ledger.reservoir_heat.abs() + ledger.lost_heat.abs();
        Ok(ledger.kinetic_energy + specimen.free_energy(&x).abs() + thermal + gone)
    }
}

/// The largest violations of a run; the least ΔS of a step in ulp of S, infinite without entropy.
#[derive(Debug)]
struct Laws {
    energy: f64,
    entropy_ulps: f64,
    momentum: f64,
}

fn run(
    specimen: &dyn Specimen,
    scheme: Scheme,
    air: Option<f64>,
) -> Result<Laws, Box<dyn std::error::Error>> {
    let mut run = Run::new(specimen, scheme, air);
    let start = run.simulation.ledger();
    let (mut before, mut scale) = (start, run.energy_scale(specimen)?);
    let (mut defect, mut laws) = (
        0.0_f64,
        Laws {
            energy: 0.0,
            entropy_ulps: f64::INFINITY,
            momentum: 0.0,
        },
    );
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

/// What a run violates, if anything.
fn violation(specimen: &dyn Specimen, scheme: Scheme, air: Option<f64>) -> Option<String> {
    let place = if air.is_some() { "in air" } else { "insulated" };
    let what = format!("{:22} {:16} {place:10}", specimen.name(), scheme.name());
    let laws = match run(specimen, scheme, air) {
        Ok(laws) => laws,
        Err(error) => return Some(format!("{what} {error}")),
    };
    let Laws {
        energy,
        entropy_ulps,
        momentum,
    } = laws;
    let what = format!("{what} {energy:8.1e} {entropy_ulps:8.1e} ulp {momentum:8.1e}");
    println!("{what}");
    let kept = energy <= ENERGY && entropy_ulps >= ENTROPY && momentum <= MOMENTUM;
    (!kept).then_some(what)
}

#[test]
fn every_specimen_keeps_energy_and_produces_entropy() {
    let mut wrong = Vec::new();
    let all = families::all().into_iter();
    // The functions of `Every` are singular beyond its home, which a run leaves.
    let springs = all.filter(|specimen| !specimen.is_solid() && specimen.name() != "Every");
    for specimen in springs {
        for scheme in [Scheme::EemEntropy, Scheme::EemTemperature] {
            for air in AIR {
                wrong.extend(violation(&*specimen, scheme, air));
            }
        }
    }
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
}

/// The energy is a function of the stretch, and is known no better: half an ulp of λ is
/// `½ ε f λ` of energy, at both ends of a run. In stiff material that is more than an ulp of E.
#[test]
fn stiff_material_keeps_energy_to_an_ulp_of_its_stretch() {
    let steel = springs::Steel::example();
    // The largest strain of the run is below that of the home.
    let (force, stretch) = (2.1e7 * 0.002, 1.002);
    let mut run = Run::new(&steel, Scheme::EemEntropy, None);
    let start = run.simulation.ledger().energy;
    for _ in 0..STEPS {
        run.simulation.step().unwrap();
        let defect = (run.simulation.ledger().energy - start).abs();
        assert!(defect <= f64::EPSILON * force * stretch, "{defect:e} J");
    }
}
