//! Several models, dimensions and paths of heat in one scene.

use eem::prelude::*;

use crate::support::{
    Hencky, Laws, LogarithmicStiffness, ThermoViscoElastic, pendulums_in_contact,
};

const ENERGY_TOLERANCE: f64 = 4e-15;
const ENTROPY_TOLERANCE: f64 = -2.0;
/// Momenta of a free body: what the rounding of N steps adds up to, as a random walk of one
/// rounding of each force per step, √N ε; a factor for the number of forces.
const FREE_MOMENTUM_TOLERANCE: f64 = 1e-14;
/// What each mass has in the beginning, up to 0.9 kg m/s; their sum nearly cancels.
const MOMENTUM: f64 = 1.0;
/// Energy after 1000 steps: a random walk of two roundings per step, 2√N ε.
const WALK_TOLERANCE: f64 = 64.0 * f64::EPSILON;

/// A free triangle and a mass on top: six springs of three models, all thermal ones in contact.
fn tetrahedron(scheme: Scheme, step: f64) -> Simulation<3> {
    let mut scene = Scene::<3>::new();
    let nodes = [
        scene.mass(1.0, [1.1, 0.0, 0.0], [0.0, 0.5, 0.1]),
        scene.mass(2.0, [-0.5, 0.9, 0.0], [-0.4, -0.2, 0.0]),
        scene.mass(1.5, [-0.5, -0.9, 0.1], [0.4, -0.1, -0.2]),
        scene.mass(0.5, [0.1, 0.0, 1.3], [0.1, 0.0, 0.3]),
    ];
    let soft = LogarithmicStiffness {
        natural_length: 1.7,
        ..LogarithmicStiffness::FIRST
    };
    let viscous = ThermoViscoElastic {
        natural_length: 1.5,
        ..ThermoViscoElastic::PENDULUM
    };
    let hencky = Hencky {
        stiffness: 200.0,
        natural_length: 1.6,
    };
    let thermal = [
        scene.spring(soft.clone(), [nodes[0], nodes[1]]),
        scene.spring(viscous.clone(), [nodes[1], nodes[2]]),
        scene.spring(soft, [nodes[2], nodes[0]]),
        scene.spring(viscous, [nodes[0], nodes[3]]),
    ];
    scene.spring(hencky.clone(), [nodes[1], nodes[3]]);
    scene.spring(hencky, [nodes[2], nodes[3]]);
    for (element, temperature) in thermal.into_iter().zip([320.0, 290.0, 310.0, 300.0]) {
        scene.set_temperature(element, temperature);
    }
    scene.conduct(thermal[0], thermal[1], 5.0);
    scene.conduct(thermal[1], thermal[2], 2.0);
    scene.conduct(thermal[2], thermal[3], 1.0);
    scene.conduct(thermal[0], thermal[3], 3.0);
    Simulation::new(scene, scheme, step).unwrap()
}

#[test]
fn a_free_body_of_three_models_keeps_all_laws_in_staggered_steps() {
    let mut run = tetrahedron(Scheme::Staggered, 0.02);
    // 4 masses in space and the temperatures that 4 elements in contact see; nothing for Hencky.
    assert_eq!(run.unknowns(), 12 + 4);
    let first = run.ledger();
    let mut laws = Laws::new(&run);
    for _ in 0..2_000 {
        run.step().unwrap();
        laws.watch(&run);
    }
    let last = run.ledger();
    println!("{laws:?}");
    let linear = (last.linear_momentum - first.linear_momentum).norm();
    let angular = (last.angular_momentum - first.angular_momentum).norm();
    println!("linear momentum off by {linear:e}, angular by {angular:e}");
    assert!(laws.energy <= ENERGY_TOLERANCE);
    assert!(laws.entropy_ulps >= ENTROPY_TOLERANCE);
    assert!(linear <= FREE_MOMENTUM_TOLERANCE * MOMENTUM);
    assert!(angular <= FREE_MOMENTUM_TOLERANCE * first.angular_momentum.norm());
}

// Without the first law: the energy of the variational integrator is only near its value.
#[test]
fn a_free_body_keeps_its_momenta_with_stages_too() {
    let mut run = tetrahedron(Scheme::Variational4, 0.02);
    assert_eq!(run.unknowns(), 2 * (12 + 4));
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
    let mut run = tetrahedron(Scheme::EemEntropy, 0.02);
    let iterations: usize = (0..100).map(|_| run.step().unwrap().iterations).sum();
    println!("{iterations} iterations for 100 steps");
    // An inexact tangent would need three times as many.
    assert!(iterations <= 500);
}

#[test]
fn schemes_agree_for_small_steps() {
    let [(_, eem), others @ ..] = Scheme::ALL.map(|scheme| {
        let mut run = tetrahedron(scheme, 1e-4);
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
fn an_elastic_spring_has_no_thermal_unknown_and_keeps_its_energy() {
    let mut scene = Scene::<2>::new();
    let pivot = scene.anchor([0.0, 0.0]);
    let bob = scene.mass(1.0, [1.5, 0.0], [0.0, 1.0]);
    let spring = scene.spring(
        Hencky {
            stiffness: 100.0,
            natural_length: 1.0,
        },
        [pivot, bob],
    );
    let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.05).unwrap();
    assert_eq!(run.unknowns(), 2);
    assert!(run.temperature(spring).is_err());
    let first = run.ledger();
    for _ in 0..1_000 {
        run.step().unwrap();
    }
    let last = run.ledger();
    approx::assert_relative_eq!(last.energy, first.energy, max_relative = WALK_TOLERANCE);
    assert!(last.entropy.abs() <= 0.0);
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
        let hencky = Hencky {
            stiffness: 100.0,
            natural_length: length,
        };
        scene.spring(hencky, [pivot, far]);
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
