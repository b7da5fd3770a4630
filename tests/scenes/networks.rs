//! Several models, dimensions and paths of heat in one scene.

use eem::prelude::*;

use crate::support::dashpots::tetrahedron;
use crate::support::{
    Laws, LogarithmicStiffness, ThermoViscoElastic, hencky, pendulums_in_contact,
};

const ENERGY_TOLERANCE: f64 = 4e-15;
const ENTROPY_TOLERANCE: f64 = -2.0;
/// Momenta of a free body: what the rounding of N steps adds up to, as a random walk of one
/// rounding of each force per step, √N ε; a factor for the number of forces.
const FREE_MOMENTUM_TOLERANCE: f64 = 1e-14;
/// What each mass has in the beginning, up to 0.9 kg m/s; their sum nearly cancels.
const MOMENTUM: f64 = 1.0;

fn free_body(scheme: Scheme, step: f64) -> Simulation<3> {
    Simulation::new(tetrahedron().0, scheme, step).unwrap()
}

// Without the first law: the energy of the variational integrator is only near its value.
#[test]
fn a_free_body_keeps_its_momenta_with_stages_too() {
    let mut run = free_body(Scheme::Variational4, 0.02);
    // 4 masses in space and the temperatures that 5 elements in contact see; nothing for Hencky.
    assert_eq!(run.unknowns(), 2 * (12 + 5));
    let first = run.ledger();
    let mut laws = Laws::new(&run);
    let iterations: usize = (0..500)
        .map(|_| {
            let report = run.step().unwrap();
            laws.watch(&run);
            report.iterations
        })
        .sum();
    let last = run.ledger();
    println!("{iterations} iterations, {laws:?}");
    let linear = (last.linear_momentum - first.linear_momentum).norm();
    let angular = (last.angular_momentum - first.angular_momentum).norm();
    println!("linear momentum off by {linear:e}, angular by {angular:e}");
    assert!(iterations <= 2_500);
    assert!(laws.entropy_ulps >= ENTROPY_TOLERANCE);
    assert!(linear <= FREE_MOMENTUM_TOLERANCE * MOMENTUM);
    assert!(angular <= FREE_MOMENTUM_TOLERANCE * first.angular_momentum.norm());
}

#[test]
fn conduction_converges_quadratically_too() {
    let mut run = free_body(Scheme::EemEntropy, 0.02);
    let iterations: usize = (0..100).map(|_| run.step().unwrap().iterations).sum();
    println!("{iterations} iterations for 100 steps");
    // An inexact tangent would need three times as many.
    assert!(iterations <= 500);
}

#[test]
fn schemes_agree_for_small_steps() {
    let [(_, eem), others @ ..] = Scheme::ALL.map(|scheme| {
        let mut run = free_body(scheme, 1e-4);
        for _ in 0..100 {
            run.step().unwrap();
        }
        (scheme, run.ledger())
    });
    for (scheme, other) in others {
        // h² or h = 1e-4, times derivatives of the motion.
        let kinetic = if scheme == Scheme::Staggered {
            1e-3
        } else {
            1e-5
        };
        approx::assert_relative_eq!(
            other.kinetic_energy,
            eem.kinetic_energy,
            max_relative = kinetic
        );
        approx::assert_relative_eq!(other.energy, eem.energy, max_relative = 1e-7);
        approx::assert_relative_eq!(other.entropy, eem.entropy, max_relative = 1e-7);
    }
}

#[test]
fn lengths_of_very_different_size_do_not_loosen_the_laws() {
    for length in [1.0, 1e3, 1e6, 1e9] {
        let mut scene = Scene::<2>::new();
        let pivot = scene.anchor([0.0, 0.0]);
        let bob = scene.mass(1.0, [1.5, 0.0], [0.0, 1.0]);
        let spring = scene.spring(ThermoViscoElastic::PENDULUM, [pivot, bob]);
        scene.set_temperature(spring, 320.0);
        let far = scene.mass(1.0, [0.0, length], [0.0, 0.0]);
        scene.spring(hencky(100.0, length), [pivot, far]);
        let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.05).unwrap();
        let mut laws = Laws::new(&run);
        for _ in 0..200 {
            run.step().unwrap();
            laws.watch(&run);
        }
        println!("{length:e} m: {laws:?}");
        assert!(laws.energy <= ENERGY_TOLERANCE);
    }
}

// κh/c = 10² … 10⁵ with c = 1.1 J/K: heat equalises many times over within a step. A rounding of Θ
// is then κh/c roundings of the element's own temperature, which shows in the energy.
#[test]
fn stiff_conduction_converges_and_keeps_the_laws() {
    for conductance in [1e3, 1e4, 1e5, 1e6] {
        let (iterations, laws) = pendulums_in_contact(Scheme::EemEntropy, 0.1, conductance);
        println!("{conductance:e} W/K: {iterations} iterations, {laws:?}");
        assert!(iterations <= 800);
        assert!(laws.energy <= ENERGY_TOLERANCE * conductance * 0.1 / 1.1);
        assert!(laws.entropy_ulps >= ENTROPY_TOLERANCE);
    }
}

/// What flows to a reservoir ten thousand times colder leaves the element with the little that exchange and production
/// do not cancel.
#[test]
fn a_hot_spring_cools_beside_a_very_cold_reservoir() {
    for scheme in [Scheme::EemEntropy, Scheme::EemTemperature] {
        let mut scene = Scene::<2>::new();
        let ends = [
            scene.anchor([0.0, 0.0]),
            scene.mass(1.0, [2.0, 0.0], [0.0, 0.1]),
        ];
        let spring = scene.spring(LogarithmicStiffness::FIRST, ends);
        scene.set_temperature(spring, 1e4);
        let cold = scene.reservoir(1.0);
        scene.conduct(spring, cold, 1e4);
        let mut run = Simulation::new(scene, scheme, 0.1).unwrap();
        for _ in 0..10 {
            run.step().unwrap();
        }
        assert!(run.temperature(spring).unwrap() < 5e3);
    }
}
