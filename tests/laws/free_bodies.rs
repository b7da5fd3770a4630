//! A ring and a tetrahedron of mixed models float freely for 10 000 steps and keep all laws.

use eem::prelude::*;
use eem_testkit::length::at_length;

use crate::support::dashpots::{ThreeDashpots, TwoDashpots};
use crate::support::{Hencky, LogarithmicStiffness, ThermoViscoElastic};

const STEPS: u32 = 10_000;
const STEP: f64 = 0.005;

/// The state is kept to twice the precision and energy is closed in every step, so that only the
/// evaluation of E shows: a few roundings per term of the sum.
const ENERGY_TOLERANCE: f64 = 4e-15;

/// Two units in the last place of S, for the evaluation of both entropies.
const ENTROPY_TOLERANCE: f64 = -2.0;

/// What rounding may do to a momentum, relative to the sum of the magnitudes it is made of: one
/// rounding of ε per element and step, in directions that nothing correlates, √(elements·N) ε.
fn momentum_tolerance(elements: u32) -> f64 {
    f64::from(elements * STEPS).sqrt() * f64::EPSILON
}

/// Masses, spring ends and, of the thermal springs, temperatures and contacts.
struct Body {
    run: Simulation<3>,
    nodes: Vec<Node>,
    elements: u32,
}

fn logarithmic(natural_length: f64) -> LogarithmicStiffness {
    LogarithmicStiffness {
        natural_length,
        ..LogarithmicStiffness::FIRST
    }
}

const HENCKY: Hencky = Hencky {
    stiffness: 200.0,
    natural_length: 1.6,
};

/// Three masses in a circle: elastic, logarithmic, and with two dashpots.
fn ring(scheme: Scheme) -> Body {
    let mut scene = Scene::<3>::new();
    let nodes = [
        scene.mass(1.0, [1.0, 0.0, 0.0], [0.1, 0.6, 0.1]),
        scene.mass(2.0, [-0.5, 0.9, 0.0], [-0.5, -0.2, 0.0]),
        scene.mass(1.5, [-0.5, -0.9, 0.1], [0.4, -0.3, -0.2]),
    ];
    scene.spring(HENCKY, [nodes[0], nodes[1]]);
    let thermal = [
        scene.spring(logarithmic(1.7), [nodes[1], nodes[2]]),
        scene.spring(TwoDashpots::DATA, [nodes[2], nodes[0]]),
    ];
    scene.set_temperature(thermal[0], 320.0);
    scene.set_temperature(thermal[1], 290.0);
    scene.conduct(thermal[0], thermal[1], 5.0);
    Body {
        run: Simulation::new(scene, scheme, STEP).unwrap(),
        nodes: nodes.to_vec(),
        elements: 3,
    }
}

/// Four masses, six springs: two elastic, two logarithmic, one dashpot, three dashpots.
fn tetrahedron(scheme: Scheme) -> Body {
    let mut scene = Scene::<3>::new();
    let nodes = [
        scene.mass(1.0, [1.1, 0.0, 0.0], [0.0, 0.5, 0.1]),
        scene.mass(2.0, [-0.5, 0.9, 0.0], [-0.4, -0.2, 0.0]),
        scene.mass(1.5, [-0.5, -0.9, 0.1], [0.4, -0.1, -0.2]),
        scene.mass(0.5, [0.1, 0.0, 1.3], [0.1, 0.0, 0.3]),
    ];
    let one = ThermoViscoElastic {
        natural_length: 1.5,
        ..ThermoViscoElastic::PENDULUM
    };
    let three = ThreeDashpots {
        natural_length: 1.5,
        ..ThreeDashpots::DATA
    };
    let thermal = [
        scene.spring(logarithmic(1.7), [nodes[0], nodes[1]]),
        scene.spring(one, [nodes[1], nodes[2]]),
        scene.spring(logarithmic(1.7), [nodes[2], nodes[0]]),
        scene.spring(three, [nodes[0], nodes[3]]),
    ];
    scene.spring(HENCKY, [nodes[1], nodes[3]]);
    scene.spring(HENCKY, [nodes[2], nodes[3]]);
    for (element, temperature) in thermal.into_iter().zip([320.0, 290.0, 310.0, 300.0]) {
        scene.set_temperature(element, temperature);
    }
    scene.conduct(thermal[0], thermal[1], 5.0);
    scene.conduct(thermal[1], thermal[2], 2.0);
    scene.conduct(thermal[2], thermal[3], 1.0);
    Body {
        run: Simulation::new(scene, scheme, STEP).unwrap(),
        nodes: nodes.to_vec(),
        elements: 6,
    }
}

impl Body {
    /// Σ|p| and Σ|q||p|.
    fn magnitudes(&self) -> [f64; 2] {
        let mut sums = [0.0; 2];
        for &node in &self.nodes {
            let p = self.run.momentum(node).unwrap().norm();
            sums[0] += p;
            sums[1] += self.run.position(node).unwrap().norm() * p;
        }
        sums
    }
}

/// Steps, and compares every state with the first; a NaN fails every comparison.
fn keeps_all_laws(mut body: Body) {
    let name = body.run.scheme().name();
    let first = body.run.ledger();
    let (mut energy, mut linear, mut angular, mut ulps) = (0.0, 0.0, 0.0, f64::INFINITY);
    let (mut sizes, mut entropy) = (body.magnitudes(), first.entropy);
    for _ in 0..at_length(STEPS, STEPS / 8) {
        body.run.step().unwrap();
        let ledger = body.run.ledger();
        assert!(ledger.energy.is_finite() && ledger.entropy.is_finite());
        energy = f64::max(
            energy,
            (ledger.energy - first.energy).abs() / first.energy.abs(),
        );
        linear = f64::max(
            linear,
            (ledger.linear_momentum - first.linear_momentum).norm(),
        );
        angular = f64::max(
            angular,
            (ledger.angular_momentum - first.angular_momentum).norm(),
        );
        ulps = f64::min(
            ulps,
            (ledger.entropy - entropy) / (f64::EPSILON * entropy.abs()),
        );
        entropy = ledger.entropy;
        let now = body.magnitudes();
        sizes = [0, 1].map(|i| f64::max(sizes[i], now[i]));
    }
    let (linear, angular) = (linear / sizes[0], angular / sizes[1]);
    let bound = momentum_tolerance(body.elements);
    println!(
        "{name}: energy {energy:e}, linear momentum {linear:e}, angular {angular:e} (bound \
         {bound:e}), ΔS ≥ {ulps} ulp, S grew by {:e} J/K",
        entropy - first.entropy
    );
    assert!(energy <= ENERGY_TOLERANCE);
    assert!(ulps >= ENTROPY_TOLERANCE);
    assert!(linear <= bound);
    assert!(angular <= bound);
    // The body is dissipative and its parts are of unequal temperature.
    assert!(entropy - first.entropy > 1e-3);
}

#[test]
fn a_ring_in_entropy_form() {
    keeps_all_laws(ring(Scheme::EemEntropy));
}

#[test]
fn a_ring_in_temperature_form() {
    keeps_all_laws(ring(Scheme::EemTemperature));
}

#[test]
fn a_tetrahedron_in_entropy_form() {
    keeps_all_laws(tetrahedron(Scheme::EemEntropy));
}

#[test]
fn a_tetrahedron_in_temperature_form() {
    keeps_all_laws(tetrahedron(Scheme::EemTemperature));
}
