//! Gravity, forces of time, moved anchors and thermostats: their work and heat close the balance.

use eem::prelude::*;

use crate::support::{DoublePendulum, LogarithmicStiffness, ThermoViscoElastic};

/// One rounding of the energies in the sum per step, in a random walk of 1 000 steps: √1000 ε.
const BALANCE_TOLERANCE: f64 = 7.0e-15;
const ENTROPY_TOLERANCE: f64 = -2.0;

const EEM: [Scheme; 4] = [
    Scheme::EemExplicit,
    Scheme::EemEntropy,
    Scheme::EemTemperature,
    Scheme::Staggered,
];

/// The sum of the magnitudes that enter the balance, whose roundings its defect is made of.
fn magnitude<const D: usize>(ledger: &Ledger<D>) -> f64 {
    // θ s of the elements at about room temperature, of which the internal energy is a part.
    let thermal = 300.0 * ledger.element_entropy;
    let terms = [
        ledger.kinetic_energy,
        ledger.potential_energy,
        ledger.internal_energy,
        ledger.work,
        ledger.heat,
        thermal,
    ];
    terms.into_iter().map(f64::abs).sum()
}

/// The largest defect of the balance, relative to its magnitude, and the smallest ΔS in ulp.
fn balance<const D: usize>(run: &mut Simulation<D>, steps: usize) -> (f64, f64) {
    let first = run.ledger();
    let (mut before, mut size) = (first.entropy, magnitude(&first));
    let (mut defect, mut ulps) = (0.0_f64, f64::INFINITY);
    for _ in 0..steps {
        run.step().unwrap();
        let ledger = run.ledger();
        size = size.max(magnitude(&ledger));
        defect = defect.max((ledger.balance - first.balance).abs());
        if ledger.entropy.abs() > 0.0 {
            ulps = ulps.min((ledger.entropy - before) / (f64::EPSILON * ledger.entropy.abs()));
        }
        before = ledger.entropy;
    }
    let (name, defect) = (run.scheme().name(), defect / size);
    println!("{name}: balance off by {defect:e}, ΔS ≥ {ulps} ulp");
    (defect, ulps)
}

fn assert_closed<const D: usize>(run: &mut Simulation<D>, steps: usize) {
    let (defect, ulps) = balance(run, steps);
    assert!(defect <= BALANCE_TOLERANCE);
    assert!(ulps >= ENTROPY_TOLERANCE);
}

/// A hot viscous spring under gravity, pushed by a force that changes with time.
fn pushed(scheme: Scheme, step: f64) -> Simulation<2> {
    let mut scene = Scene::<2>::new();
    let pivot = scene.anchor([0.0, 0.0]);
    let bob = scene.mass(1.0, [1.5, 0.0], [0.0, 0.0]);
    scene.set_momentum(bob, [0.0, 1.0]);
    let spring = scene.spring(ThermoViscoElastic::PENDULUM, [pivot, bob]);
    scene.set_temperature(spring, 320.0);
    let air = scene.reservoir(300.0);
    scene.conduct(spring, air, 10.0);
    scene.set_gravity([0.0, -9.81]);
    scene.dead_load(bob, [1.0, 0.0]);
    scene.force(bob, |t| [5.0 * (3.0 * t).sin(), 2.0]);
    Simulation::new(scene, scheme, step).unwrap()
}

#[test]
fn work_of_forces_closes_the_energy() {
    for scheme in EEM {
        let mut run = pushed(scheme, 0.05);
        assert_closed(&mut run, 1_000);
        let ledger = run.ledger();
        assert!(ledger.work.abs() > 1.0);
        assert!((ledger.energy - ledger.balance - ledger.work).abs() < 1e-10);
    }
}

#[test]
fn schemes_agree_on_work_for_small_steps() {
    let [eem, others @ ..] = Scheme::ALL.map(|scheme| {
        let mut run = pushed(scheme, 1e-4);
        for _ in 0..2_000 {
            run.step().unwrap();
        }
        run.ledger()
    });
    // Second order: h² times derivatives of the motion, whose frequency is some 70/s.
    for other in others {
        approx::assert_relative_eq!(other.work, eem.work, max_relative = 1e-3);
        approx::assert_relative_eq!(
            other.potential_energy,
            eem.potential_energy,
            max_relative = 1e-4
        );
        approx::assert_relative_eq!(other.balance, eem.balance, max_relative = 1e-6);
    }
}

#[test]
fn a_moved_anchor_does_work() {
    for scheme in EEM {
        let mut scene = Scene::<2>::new();
        let support = scene.anchor([0.0, 0.0]);
        let bob = scene.mass(2.0, [0.0, -1.0], [0.0, 0.0]);
        let spring = scene.spring(ThermoViscoElastic::PENDULUM, [support, bob]);
        scene.set_temperature(spring, 300.0);
        scene.set_gravity([0.0, -9.81]);
        scene.move_anchor(support, |t| {
            [0.1 * (2.0 * t).sin(), 0.05 * (1.0 - (5.0 * t).cos())]
        });
        let mut run = Simulation::new(scene, scheme, 0.05).unwrap();
        assert_closed(&mut run, 1_000);
        let position = run.position(support).unwrap();
        approx::assert_relative_eq!(position.x, 0.1 * 100.0_f64.sin(), max_relative = 1e-12);
        assert!(run.ledger().work.abs() > 1e-3);
    }
}

#[test]
fn a_thermostat_gives_the_heat_that_is_missing() {
    for scheme in EEM {
        let case = DoublePendulum::LOGARITHMIC;
        let mut scene = Scene::<3>::new();
        let pivot = scene.anchor([0.0; 3]);
        let masses = [0, 1].map(|i| scene.mass(case.masses[i], case.positions[i], [0.0, 1.0, 0.0]));
        let springs = [
            scene.spring(LogarithmicStiffness::FIRST, [pivot, masses[0]]),
            scene.spring(LogarithmicStiffness::FIRST, [masses[0], masses[1]]),
        ];
        scene.set_temperature(springs[0], 350.0);
        scene.set_temperature(springs[1], 300.0);
        scene.conduct(springs[0], springs[1], 300.0);
        scene.prescribe_temperature(springs[0], |t| 350.0 + 20.0 * t.sin());
        let mut run = Simulation::new(scene, scheme, 0.05).unwrap();
        assert_closed(&mut run, 200);
        let theta = run.temperature(springs[0]).unwrap();
        approx::assert_relative_eq!(theta, 350.0 + 20.0 * 10.0_f64.sin(), max_relative = 1e-12);
        let ledger = run.ledger();
        assert!(ledger.heat.abs() > 1.0);
        assert!(run.temperature(springs[1]).unwrap() > 310.0);
    }
}

#[test]
fn a_mass_without_springs_falls_freely() {
    for scheme in Scheme::ALL {
        let mut scene = Scene::<2>::new();
        let stone = scene.mass(2.0, [0.0, 10.0], [3.0, 0.0]);
        scene.set_gravity([0.0, -9.81]);
        let mut run = Simulation::new(scene, scheme, 0.1).unwrap();
        for _ in 0..10 {
            run.step().unwrap();
        }
        let position = run.position(stone).unwrap();
        approx::assert_relative_eq!(position.x, 3.0, max_relative = 1e-14);
        approx::assert_relative_eq!(position.y, 10.0 - 0.5 * 9.81, max_relative = 1e-14);
        approx::assert_relative_eq!(
            run.ledger().energy,
            2.0 * 9.81 * 10.0 + 9.0,
            max_relative = 1e-14
        );
    }
}
