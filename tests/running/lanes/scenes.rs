//! Scenes of a few unknowns, from a mass on an elastic spring to conducting double pendulums.

use eem::prelude::*;
use eem::{FreeEnergy, Real};

use super::watched::{Case, Parts};
use crate::support::{DoublePendulum, Hencky, LogarithmicStiffness, ThermoViscoElastic};

fn vector<S: Real, const D: usize>(numbers: [f64; D]) -> [S; D] {
    numbers.map(S::from_f64)
}

/// An elastic spring, started at `input[0]` m/s.
pub(crate) struct Elastic;

impl Case<2> for Elastic {
    fn scene<S: Real>(&self, [speed, ..]: [S; 3]) -> (Scene<2, S>, Parts) {
        let mut scene = Scene::default();
        let pivot = scene.anchor(vector([0.0, 0.0]));
        let bob = scene.mass(S::one(), vector([3.0, 0.0]), [S::zero(), speed]);
        let law = Hencky {
            stiffness: 100.0,
            natural_length: 1.0,
        };
        let elements = vec![scene.spring(law, [pivot, bob])];
        let nodes = vec![bob];
        (scene, Parts { nodes, elements })
    }
}

/// A thermoelastic spring, started at `input[0]` m/s and `input[1]` K.
pub(crate) struct Thermoelastic;

impl Case<2> for Thermoelastic {
    fn scene<S: Real>(&self, [speed, theta, _]: [S; 3]) -> (Scene<2, S>, Parts) {
        let mut scene = Scene::default();
        let pivot = scene.anchor(vector([0.0, 0.0]));
        let bob = scene.mass(S::from_f64(10.0), vector([3.0, 0.0]), [S::zero(), speed]);
        let spring = scene.spring(LogarithmicStiffness::FIRST, [pivot, bob]);
        scene.set_temperature(spring, theta);
        let (nodes, elements) = (vec![bob], vec![spring]);
        (scene, Parts { nodes, elements })
    }
}

/// The same with a thermoelastic spring of texts.
#[cfg(feature = "typed")]
pub(crate) struct OfTexts(pub(crate) eem::typed::Law);

#[cfg(feature = "typed")]
impl Case<2> for OfTexts {
    fn scene<S: Real>(&self, [speed, theta, _]: [S; 3]) -> (Scene<2, S>, Parts) {
        let mut scene = Scene::default();
        let pivot = scene.anchor(vector([0.0, 0.0]));
        let bob = scene.mass(S::from_f64(10.0), vector([3.0, 0.0]), [S::zero(), speed]);
        let model: eem::typed::ThermalSpring0<S> = self.0.model().unwrap();
        let spring = scene.spring(model, [pivot, bob]);
        scene.set_temperature(spring, theta);
        let (nodes, elements) = (vec![bob], vec![spring]);
        (scene, Parts { nodes, elements })
    }
}

/// The single pendulum of García Orden & Romero (2012), §4.1, started at `input[0]` m/s and
/// `input[1]` K, with `input[2]` W/K to the air.
pub(crate) struct Pendulum;

impl Case<2> for Pendulum {
    fn scene<S: Real>(&self, [speed, theta, conductance]: [S; 3]) -> (Scene<2, S>, Parts) {
        let mut scene = Scene::default();
        let pivot = scene.anchor(vector([0.0, 0.0]));
        let bob = scene.mass(S::one(), vector([3.0, 0.0]), [S::zero(), speed]);
        let spring = scene.spring(ThermoViscoElastic::PENDULUM, [pivot, bob]);
        scene.set_temperature(spring, theta);
        let air = scene.reservoir(S::from_f64(300.0));
        scene.conduct(spring, air, conductance);
        let (nodes, elements) = (vec![bob], vec![spring]);
        (scene, Parts { nodes, elements })
    }
}

/// The double pendulum with logarithmic stiffness, eight unknowns; the first mass of `input[0]` kg, the
/// second spring at `input[1]` K, `input[2]` W/K between them.
pub(crate) struct Double;

impl Case<3> for Double {
    fn scene<S: Real>(&self, [mass, theta, conductance]: [S; 3]) -> (Scene<3, S>, Parts) {
        let published = DoublePendulum::LOGARITHMIC;
        let mut scene = Scene::default();
        let pivot = scene.anchor(vector([0.0; 3]));
        let masses = [mass, S::from_f64(published.masses[1])];
        let nodes = [0, 1].map(|i| {
            let velocity = vector(published.momenta[i]).map(|p: S| p / masses[i]);
            scene.mass(masses[i], vector(published.positions[i]), velocity)
        });
        let ends = [[pivot, nodes[0]], [nodes[0], nodes[1]]];
        let temperatures = [S::from_f64(published.temperatures[0]), theta];
        let springs = [0, 1].map(|i| {
            let law = LogarithmicStiffness {
                stiffness: published.stiffness[i],
                softening: published.softening[i],
                capacity: published.capacity[i],
                natural_length: [2.0, 1.0][i],
                ..LogarithmicStiffness::FIRST
            };
            let spring = scene.spring(law, ends[i]);
            scene.set_temperature(spring, temperatures[i]);
            spring
        });
        scene.conduct(springs[0], springs[1], conductance);
        let (nodes, elements) = (nodes.to_vec(), springs.to_vec());
        (scene, Parts { nodes, elements })
    }
}

/// A law whose parameters are numbers of the scene.
#[derive(Clone, Debug, FreeEnergy)]
#[free_energy(|lambda: Stretch, theta: Temperature| {
    let strain = ln(lambda / length);
    0.5 * stiffness * strain.powi(2) - coupling * (theta - 300) * strain
        + 1000 * (theta - 300 - theta * ln(theta / 300))
})]
struct Material<S> {
    stiffness: S,
    coupling: S,
    length: S,
}

/// A constant of the program.
const CAPACITY: f64 = 3.0;

/// With a dashpot beside the spring, an array, constants and helpers.
#[derive(Clone, Debug, FreeEnergy)]
#[free_energy(|lambda: Stretch, theta: Temperature| {
    let log = |x, reference| ln(x / reference);
    let square = |x| x * x;
    stiffness[0] * square(log(lambda, 1)) + PI * stiffness[1] * square(square(lambda - 1))
        + CAPACITY * (theta - 300 - theta * log(theta, 300))
})]
#[viscosity(lambda = eta * exp(CAPACITY - self::CAPACITY * theta / 300))]
struct Voigt<S> {
    stiffness: [S; 2],
    eta: S,
}

/// A mass on it, started at `input[1]` K, with the second stiffness `input[0]` N/m³ and the viscosity `input[2]`
/// N s/m.
pub(crate) struct Damped;

impl Case<2> for Damped {
    fn scene<S: Real>(&self, [stiffness, theta, eta]: [S; 3]) -> (Scene<2, S>, Parts) {
        let mut scene = Scene::default();
        let pivot = scene.anchor(vector([0.0, 0.0]));
        let bob = scene.mass(S::one(), vector([1.4, 0.0]), vector([0.2, 1.0]));
        let law = Voigt {
            stiffness: [S::from_f64(20.0), stiffness],
            eta,
        };
        let spring = scene.spring(law, [pivot, bob]);
        scene.set_temperature(spring, theta);
        let (nodes, elements) = (vec![bob], vec![spring]);
        (scene, Parts { nodes, elements })
    }
}

/// A sweep over the material: stiffness `input[0]` J, coupling `input[1]` J/K, length `input[2]` m.
pub(crate) struct Sweep;

impl Case<1> for Sweep {
    fn scene<S: Real>(&self, [stiffness, coupling, length]: [S; 3]) -> (Scene<1, S>, Parts) {
        let mut scene = Scene::default();
        let hook = scene.anchor(vector([0.0]));
        let mass = scene.mass(S::from_f64(2.0), vector([-1.2]), vector([0.5]));
        let law = Material {
            stiffness,
            coupling,
            length,
        };
        let spring = scene.spring(law, [hook, mass]);
        scene.set_temperature(spring, S::from_f64(310.0));
        scene.set_gravity(vector([-9.81]));
        let (nodes, elements) = (vec![mass], vec![spring]);
        (scene, Parts { nodes, elements })
    }
}

/// Two springs in a row whose hook is shaken by `input[0]` m, with a load of `input[1]` N, the second
/// spring heated by `input[2]` K/s.
pub(crate) struct Driven;

impl Case<2> for Driven {
    fn scene<S: Real>(&self, [amplitude, load, rate]: [S; 3]) -> (Scene<2, S>, Parts) {
        let mut scene = Scene::default();
        let hook = scene.anchor(vector([0.0, 0.0]));
        let nodes = [
            scene.mass(S::from_f64(10.0), vector([2.1, 0.0]), vector([0.0, 0.1])),
            scene.mass(S::from_f64(20.0), vector([4.2, 0.3]), vector([0.0, 0.0])),
        ];
        let springs = [[hook, nodes[0]], [nodes[0], nodes[1]]]
            .map(|ends| scene.spring(LogarithmicStiffness::FIRST, ends));
        scene.set_temperature(springs[0], S::from_f64(300.0));
        scene.set_temperature(springs[1], S::from_f64(300.0));
        scene.move_anchor(hook, move |time: S| [amplitude * time.sin(), S::zero()]);
        scene.dead_load(nodes[1], [load, S::zero()]);
        scene.prescribe_temperature(springs[1], move |time| S::from_f64(300.0) + rate * time);
        let (nodes, elements) = (nodes.to_vec(), springs.to_vec());
        (scene, Parts { nodes, elements })
    }
}

/// A chain with too many unknowns for lanes, started at `input[0]` m/s.
pub(crate) struct Chain;

impl Case<3> for Chain {
    fn scene<S: Real>(&self, [speed, ..]: [S; 3]) -> (Scene<3, S>, Parts) {
        let mut scene = Scene::default();
        let mut ends = [scene.anchor(vector([0.0; 3])); 2];
        let (mut nodes, mut elements) = (Vec::new(), Vec::new());
        for i in 1..=5_u8 {
            let position = vector([1.5 * f64::from(i), 0.0, 0.0]);
            let node = scene.mass(S::one(), position, [S::zero(), speed, S::zero()]);
            ends = [ends[1], node];
            let spring = scene.spring(LogarithmicStiffness::FIRST, ends);
            scene.set_temperature(spring, S::from_f64(310.0));
            nodes.push(node);
            elements.push(spring);
        }
        (scene, Parts { nodes, elements })
    }
}
