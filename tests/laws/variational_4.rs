//! What the variational integrator of fourth order keeps, and how its errors shrink.

use std::sync::Arc;

use eem::prelude::*;
use eem_testkit::length::at_length;
use eem_testkit::table;

use crate::support::orders::{double_error, slope};
use crate::support::springs::linear;
use crate::support::tangents::assert_tangent;
use crate::support::{DoublePendulum, Laws, in_air, pendulums_in_contact, single_pendulum};

const SCHEME: Scheme = Scheme::Variational4;

/// What a slope fitted over a factor of four in h may be off four.
const SLOPE_TOLERANCE: f64 = 0.15;
/// Closing leaves rounding only.
const MOMENTUM_TOLERANCE: f64 = 1e-13;
/// The entropy is a sum of rounded terms; a difference of two can be off by an ulp of each.
const ENTROPY_TOLERANCE: f64 = -2.0;

// Steps that resolve the exchange of heat (c/2κ = 8 ms for `romero`) and the vibrations.
#[test]
fn double_pendulums_are_of_fourth_order() {
    for (case, step) in DoublePendulum::ALL.into_iter().zip([0.005, 0.02, 0.01]) {
        let errors = [1.0, 0.5, 0.25].map(|part| double_error(&case, SCHEME, part * step, 1.0));
        println!("{}: {errors:?}, slope {}", case.name, slope(&errors));
        assert!((slope(&errors) - 4.0).abs() <= SLOPE_TOLERANCE);
    }
}

fn assert_momenta_and_entropy(laws: &Laws) {
    assert!(laws.angular_momentum <= MOMENTUM_TOLERANCE, "{laws:?}");
    assert!(laws.entropy_ulps >= ENTROPY_TOLERANCE, "{laws:?}");
}

// The energy defect is that of the motion at its stiffest, and twice what was found.
#[test]
fn the_single_pendulum_keeps_momenta_and_the_second_law_and_stays_near_its_energy() {
    for (step, energy) in [(0.2, 3e-4), (0.1, 6e-5), (0.05, 7e-6), (0.01, 1e-8)] {
        let laws = Laws::until(&mut single_pendulum(SCHEME, step).run, 20.0);
        assert_momenta_and_entropy(&laws);
        assert!(laws.energy <= energy);
    }
}

#[test]
fn double_pendulums_keep_momenta_and_the_second_law_and_stay_near_their_energies() {
    let bounds = [
        (DoublePendulum::ROMERO, 0.3, 2e-3),
        (DoublePendulum::ROMERO, 0.075, 5e-5),
        // Chaotic: with twice the step, what is found depends on the roundings.
        (DoublePendulum::KRUEGER, 0.025, 2e-6),
        (DoublePendulum::LOGARITHMIC, 0.05, 1e-4),
        (DoublePendulum::LOGARITHMIC, 0.025, 2e-6),
    ];
    for (case, step, energy) in bounds {
        println!("{}", case.name);
        // The chaotic one takes ten times as long as all others together.
        let duration = case.duration.min(at_length(f64::INFINITY, 50.0));
        let laws = Laws::until(&mut case.simulation(SCHEME, step).run, duration);
        assert_momenta_and_entropy(&laws);
        assert!(laws.energy <= energy);
    }
}

// Momenta and entropy come from the closing evaluation: a sloppy solution costs energy only.
#[test]
fn momenta_and_the_second_law_hold_for_any_tolerance_of_newton() {
    for tolerance in [1e-2, 1e-4] {
        let mut run = DoublePendulum::LOGARITHMIC.simulation(SCHEME, 0.025).run;
        let settings = NewtonSettings {
            tolerance,
            ..run.newton_settings()
        };
        run.set_newton_settings(settings).unwrap();
        assert_momenta_and_entropy(&Laws::until(&mut run, 10.0));
    }
}

/// A mass on a Hooke spring of frequency ω on a line, and its energy.
fn growth(frequency: f64, step: f64) -> f64 {
    let mut scene = Scene::<1>::new();
    let wall = scene.anchor([0.0]);
    let mass = scene.mass(1.0, [1.0 + 1e-6], [0.0]);
    scene.spring(linear(frequency * frequency), [wall, mass]);
    let mut run = Simulation::new(scene, SCHEME, step).unwrap();
    let first = run.ledger().energy;
    let mut largest = 0.0_f64;
    for _ in 0..20 {
        run.step().unwrap();
        largest = largest.max(run.ledger().energy / first);
    }
    largest
}

// The trace of one step of x″ = −ω²x leaves [−2, 2] at ωh = √8.
#[test]
fn vibrations_are_stable_up_to_the_square_root_of_eight() {
    let limit = 8.0_f64.sqrt();
    assert!(growth(0.5 * limit, 1.0) < 2.0);
    assert!(growth(0.95 * limit, 1.0) < 100.0);
    assert!(growth(1.05 * limit, 1.0) > 1e3);
}

// κh/c = 20 … 2·10⁴ with c = 1.1 J/K.
#[test]
fn stiff_conduction_converges_and_keeps_momenta_and_the_second_law() {
    for conductance in [1e3, 1e4, 1e5, 1e6] {
        let (iterations, laws) = pendulums_in_contact(SCHEME, 0.02, conductance);
        println!("{conductance:e} W/K: {iterations} iterations, {laws:?}");
        assert!(iterations <= 600);
        assert_momenta_and_entropy(&laws);
    }
}

/// A scene with everything in it that can act on it from outside.
fn busy_scene(step: f64) -> (Simulation<2>, Vec<Node>, Vec<Element>) {
    let (mut scene, [support, bob, tail], [warm, kept]) = in_air();
    scene.prescribe_temperature(kept, |t| 310.0 + 15.0 * (8.0 * t).sin());
    scene.dead_load(tail, [1.0, 0.0]);
    scene.force(bob, |t| [10.0 * (9.0 * t).sin(), 0.2]);
    scene.move_anchor(support, |t| {
        [0.1 * (7.0 * t).sin(), 0.05 * (1.0 - (5.0 * t).cos())]
    });
    let run = Simulation::new(scene, SCHEME, step).unwrap();
    (run, vec![bob, tail], vec![warm, kept])
}

/// Everything that the busy scene has come to at t = 0.5 s, and by how much its balance is off.
fn busy_end(step: f64) -> (Vec<f64>, f64) {
    let (mut run, masses, springs) = busy_scene(step);
    let first = run.ledger();
    while run.time() < 0.5 - 0.5 * step {
        run.step().unwrap();
    }
    let mut all = Vec::new();
    for node in masses {
        all.extend(run.position(node).unwrap().iter());
        all.extend(run.momentum(node).unwrap().iter());
    }
    for spring in springs {
        all.push(run.viscous_stretch(spring, 0).unwrap());
        all.push(run.entropy(spring).unwrap());
    }
    let ledger = run.ledger();
    all.extend([ledger.work, ledger.heat, ledger.entropy, ledger.energy]);
    (all, (ledger.balance - first.balance).abs())
}

// Work, heat and the entropy of thermostats are booked to the order of the scheme.
#[test]
fn loads_moved_anchors_and_thermostats_keep_the_order() {
    let runs = [0.01, 0.005, 0.0025, 0.00125].map(busy_end);
    // Of every quantity, the change by halving the step.
    for at in 0..runs[0].0.len() {
        let changes: Vec<_> = runs
            .windows(2)
            .map(|pair| (pair[0].0[at] - pair[1].0[at]).abs())
            .collect();
        println!("{}: {changes:?}, slope {}", runs[0].0[at], slope(&changes));
        assert!((slope(&changes) - 4.0).abs() <= SLOPE_TOLERANCE);
    }
    let defects: Vec<_> = runs.iter().map(|run| run.1).collect();
    println!("balance: {defects:?}, slope {}", slope(&defects));
    assert!((slope(&defects) - 4.0).abs() <= SLOPE_TOLERANCE);
}

/// A Maxwell element without temperature beside a spring.
#[derive(Clone, Copy, Debug, FreeEnergy)]
#[free_energy(|lambda: Stretch, gamma: Viscous| {
    20.0 * (lambda - 1.0).powi(2) + 10.0 * (lambda - 1.0 - gamma).powi(2) * (1.0 + gamma.powi(2))
})]
#[viscosity(gamma = 4.0)]
struct Isothermal {}

// The heat of its dashpot is lost, and that is booked.
#[test]
fn a_dashpot_without_temperature_keeps_the_order() {
    let end = |step: f64| {
        let mut scene = Scene::<2>::new();
        let pivot = scene.anchor([0.0, 0.0]);
        let bob = scene.mass(1.0, [1.4, 0.0], [0.0, 1.0]);
        let spring = table::spring(&mut scene, Arc::new(Isothermal {}), [pivot, bob]);
        let mut run = Simulation::new(scene, SCHEME, step).unwrap();
        assert_eq!(run.unknowns(), 2 * 2);
        let first = run.ledger();
        let mut laws = Laws::new(&run);
        while run.time() < 1.0 - 0.5 * step {
            run.step().unwrap();
            laws.watch(&run);
        }
        assert!(laws.angular_momentum <= MOMENTUM_TOLERANCE);
        let defect = (run.ledger().balance - first.balance).abs();
        let stretch = run.viscous_stretch(spring, 0).unwrap();
        ([run.stretch(spring).unwrap(), stretch], defect)
    };
    let runs = [0.04, 0.02, 0.01, 0.005].map(end);
    let defects: Vec<_> = runs.iter().map(|run| run.1).collect();
    println!("balance: {defects:?}, slope {}", slope(&defects));
    assert!((slope(&defects) - 4.0).abs() <= SLOPE_TOLERANCE);
    for at in 0..2 {
        let pairs = runs.windows(2);
        let changes: Vec<_> = pairs
            .map(|pair| (pair[0].0[at] - pair[1].0[at]).abs())
            .collect();
        println!("{}: {changes:?}, slope {}", runs[0].0[at], slope(&changes));
        assert!((slope(&changes) - 4.0).abs() <= SLOPE_TOLERANCE);
    }
}

#[test]
fn the_tangent_is_exact() {
    let (mut run, ..) = busy_scene(0.05);
    run.step().unwrap();
    assert_eq!(run.unknowns(), 2 * (2 * 2 + 2));
    // Displacements of the middle, Θ_0 of both springs, and the same at the end.
    let at = [0.02, -0.01, 0.03, 0.05, 318.0, 320.0].repeat(2);
    let width = |column: usize| if column % 6 < 4 { 1e-4 } else { 1e-2 };
    assert_tangent(&mut run, &at, 0..12, (width, 1e-9));
}

#[test]
fn a_failed_step_changes_nothing() {
    let mut pendulum = single_pendulum(SCHEME, 0.2);
    let settings = pendulum.run.newton_settings();
    let hasty = NewtonSettings {
        max_iterations: 1,
        ..settings
    };
    pendulum.run.set_newton_settings(hasty).unwrap();
    let before = (pendulum.row(), pendulum.run.ledger());
    let error = pendulum.run.step().unwrap_err();
    assert!(!error.history.is_empty());
    assert_eq!(before, (pendulum.row(), pendulum.run.ledger()));
    pendulum.run.set_newton_settings(settings).unwrap();
    pendulum.run.step().unwrap();
}

#[test]
fn it_is_no_discrete_generic_system() {
    let mut pendulum = single_pendulum(SCHEME, 0.01);
    pendulum.run.step().unwrap();
    assert!(pendulum.run.generic_of_last_step().is_none());
    // The equations at a state are what they are with any scheme.
    let mut other = single_pendulum(Scheme::EemEntropy, 0.01);
    let mut own = single_pendulum(SCHEME, 0.01);
    assert_eq!(own.run.generic(), other.run.generic());
}
