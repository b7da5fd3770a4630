//! A tetrahedron of mixed models floats freely for 10 000 steps and keeps all laws.

use eem::prelude::*;
use eem_testkit::length::at_length;

use crate::support::dashpots::tetrahedron;

const STEPS: u32 = 10_000;
const STEP: f64 = 0.005;

/// The state is kept to twice the precision and energy is closed in every step, so that only the
/// evaluation of E shows: a few roundings per term of the sum.
const ENERGY_TOLERANCE: f64 = 4e-15;

/// Two units in the last place of S, for the evaluation of both entropies.
const ENTROPY_TOLERANCE: f64 = -2.0;

/// What rounding may do to a momentum, relative to the sum of the magnitudes it is made of: one
/// rounding of ε per element, of six, and step, in directions that nothing correlates, √(elements·N) ε.
fn momentum_tolerance() -> f64 {
    f64::from(6 * STEPS).sqrt() * f64::EPSILON
}

struct Body {
    run: Simulation<3>,
    nodes: [Node; 4],
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
fn keeps_all_laws(scheme: Scheme) {
    let (scene, nodes) = tetrahedron();
    let run = Simulation::new(scene, scheme, STEP).unwrap();
    let mut body = Body { run, nodes };
    let name = scheme.name();
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
    let bound = momentum_tolerance();
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
fn a_tetrahedron_in_entropy_form() {
    keeps_all_laws(Scheme::EemEntropy);
}

#[test]
fn a_tetrahedron_in_temperature_form() {
    keeps_all_laws(Scheme::EemTemperature);
}

#[test]
fn a_tetrahedron_in_staggered_steps() {
    keeps_all_laws(Scheme::Staggered);
}

#[test]
fn a_tetrahedron_in_explicit_steps() {
    keeps_all_laws(Scheme::EemExplicit);
}
