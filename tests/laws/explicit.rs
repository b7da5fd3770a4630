//! The explicit scheme of order 8: its laws, component by component, its order, and what it refuses.

use std::sync::Arc;

use eem::prelude::*;
use eem::{StateError, StepFailure};
use eem_testkit::length::at_length;
use eem_testkit::table;

use crate::support::dashpots::TwoDashpots;
use crate::support::orders::{slope, step_to};
use crate::support::{
    DoublePendulum, Laws, LogarithmicStiffness, ThermoViscoElastic, only_error, reference,
    single_pendulum,
};

const SCHEME: Scheme = Scheme::EemExplicit;

/// As measured over 1e5 steps by the prototype of the scheme, with its factor of safety.
const ENERGY: f64 = 6e-15;
const ANGULAR_MOMENTUM: f64 = 2e-15;
/// The same relative to the terms of the energy, of which `cθ` is the largest where stiff springs are near
/// the temperature at which their energy is zero.
const ROUNDING: f64 = 1e-15;
/// `cθ` of [`LogarithmicStiffness::FIRST`] at room temperature, J.
const HEAT: f64 = 5000.0 * 300.0;
/// The rounding of the sum of entropies.
const ENTROPY_ULPS: f64 = -2.0;

fn assert_lawful(name: &str, laws: &Laws) {
    println!("{name}: {laws:?}");
    assert!(laws.energy <= ENERGY, "{name}");
    assert!(laws.angular_momentum <= ANGULAR_MOMENTUM, "{name}");
    assert!(laws.entropy_ulps >= ENTROPY_ULPS, "{name}");
}

/// The laws over some steps.
fn laws_of<const D: usize>(run: &mut Simulation<D>, steps: usize) -> Laws {
    let mut laws = Laws::new(run);
    for _ in 0..steps {
        let report = run.step().unwrap();
        assert!(report.least_production >= 0.0);
        assert!(report.defect.abs() <= report.bound);
        laws.watch(run);
    }
    laws
}

#[test]
fn the_laws_hold_without_drift() {
    for h in [0.05, 0.02] {
        let mut single = single_pendulum(SCHEME, h).run;
        assert_lawful("single", &laws_of(&mut single, 4_000));
    }
    let mut log = DoublePendulum::LOGARITHMIC.simulation(SCHEME, 0.02).run;
    assert_lawful("log", &laws_of(&mut log, 3_000));
    let mut krueger = DoublePendulum::KRUEGER.simulation(SCHEME, 0.05).run;
    assert_lawful("krüger", &laws_of(&mut krueger, 3_000));
}

/// The energy from positions, momenta and the formula of the free energy, without the ledger.
#[test]
fn the_energy_of_the_written_state_is_kept() {
    let mut pendulum = DoublePendulum::LOGARITHMIC.simulation(SCHEME, 0.02);
    let case = DoublePendulum::LOGARITHMIC;
    let energy = |row: &[f64]| {
        let square = |at: usize| row[at..at + 3].iter().map(|x| x * x).sum::<f64>();
        let kinetic = 0.5 * (square(6) / case.masses[0] + square(9) / case.masses[1]);
        let link: f64 = (0..3).map(|axis| (row[3 + axis] - row[axis]).powi(2)).sum();
        let internal = |spring: usize, length: f64| {
            // e = (C⁰ + C¹ θr)/2 ε² + β θr ε + c (θ − θr) for C = C⁰ − C¹ θr ln(θ/θr)
            let (theta, theta_r) = (row[12 + spring], 300.0);
            let strain = (length / [2.0, 1.0][spring]).ln();
            let softening = theta_r * case.softening[spring];
            let modulus = case.stiffness[spring] - softening * (theta / theta_r).ln() + softening;
            0.5 * modulus * strain.powi(2)
                + case.coupling * theta_r * strain
                + case.capacity[spring] * (theta - theta_r)
        };
        kinetic + internal(0, square(0).sqrt()) + internal(1, link.sqrt())
    };
    let first = energy(&pendulum.row());
    assert!((first - case.start[0]).abs() < 1e-6);
    for _ in 0..500 {
        pendulum.run.step().unwrap();
        let found = energy(&pendulum.row());
        assert!((found - first).abs() <= ENERGY * first, "{found} {first}");
    }
}

/// Slopes of ln(error) over ln h.
fn slopes(values: &[f64]) -> Vec<f64> {
    let pairs = values.windows(2);
    pairs.map(|pair| (pair[0] / pair[1]).log2()).collect()
}

/// The largest difference of two rows, relative to sizes of one and more.
fn difference(found: &[f64], exact: &[f64]) -> f64 {
    let pairs = found.iter().zip(exact);
    pairs.fold(0.0, |most, (found, exact)| {
        most.max((found - exact).abs() / exact.abs().max(1.0))
    })
}

/// Steps to a time; the mean correction.
fn end_of<const D: usize>(run: &mut Simulation<D>, end: f64) -> f64 {
    let steps = (end / run.step_size()).round();
    step_to(run, end);
    run.corrections().total / steps
}

fn assert_order(name: &str, errors: &[f64], corrections: &[f64]) {
    let [of_errors, of_corrections] = [errors, corrections].map(slope);
    println!("{name}: {errors:?} slope {of_errors}, {corrections:?} slope {of_corrections}");
    assert!((of_errors - 8.0).abs() <= 0.8, "{name}: {of_errors}");
    assert!(
        (of_corrections - 9.0).abs() <= 1.5,
        "{name}: {of_corrections}"
    );
}

#[test]
fn it_is_of_order_8_and_its_correction_of_order_9() {
    let single = |h: f64| {
        let mut pendulum = single_pendulum(SCHEME, h);
        let correction = end_of(&mut pendulum.run, 5.0);
        (pendulum.row().to_vec(), correction)
    };
    let double = |case: DoublePendulum| {
        move |h: f64| {
            let mut pendulum = case.simulation(SCHEME, h);
            let correction = end_of(&mut pendulum.run, 5.0);
            (pendulum.row(), correction)
        }
    };
    let assert_converges = |name: &str, run: &dyn Fn(f64) -> (Vec<f64>, f64), first: f64| {
        let (exact, _) = run(first / 16.0);
        let found = [1.0, 0.5, 0.25].map(|part| run(part * first));
        let errors = found.clone().map(|(row, _)| difference(&row, &exact));
        assert_order(name, &errors, &found.map(|(_, correction)| correction));
    };
    assert_converges("single", &single, 0.05);
    assert_converges("log", &double(DoublePendulum::LOGARITHMIC), 0.05);
    assert_converges("krüger", &double(DoublePendulum::KRUEGER), 0.1);
}

/// A solution found by another method in high precision.
#[test]
fn it_converges_to_the_exact_solution() {
    let rows = reference("single_pendulum_exact.csv");
    let exact = rows.iter().find(|row| row[0] >= 5.0).unwrap();
    let mut pendulum = single_pendulum(SCHEME, 0.01);
    end_of(&mut pendulum.run, 5.0);
    // time, q_x, q_y, p_x, p_y, γ, θ, σ, error estimate
    let [qx, qy, px, py, theta, gamma, sigma] = pendulum.row();
    let error = difference(&[qx, qy, px, py, gamma, theta, sigma], &exact[1..8]);
    println!("{error:e}");
    assert!(error < 1e-11);

    let rows = reference("double_pendulum_log_exact.csv");
    let exact = rows.iter().find(|row| row[0] >= 1.0).unwrap();
    let mut pendulum = DoublePendulum::LOGARITHMIC.simulation(SCHEME, 0.003_125);
    end_of(&mut pendulum.run, 1.0);
    let error = difference(&pendulum.row(), &exact[1..15]);
    println!("{error:e}");
    assert!(error < 1e-10);
}

// Components.

#[test]
fn bodies_that_do_not_touch_keep_their_own_energy_and_momentum() {
    let mut scene = Scene::<3>::new();
    let pivots = [scene.anchor([0.0; 3]), scene.anchor([4.0, 0.0, 0.0])];
    let log = DoublePendulum::LOGARITHMIC;
    let upper = scene.mass(log.masses[0], log.positions[0], [0.0, 1.0, 0.0]);
    let lower = scene.mass(log.masses[1], log.positions[1], [0.0, 0.0, -1.0]);
    let ends = [[pivots[0], upper], [upper, lower]];
    let hot = ends.map(|ends| scene.spring(LogarithmicStiffness::FIRST, ends));
    let alone = scene.mass(2.0, [5.5, 0.3, 0.0], [0.0, 1.0, 0.7]);
    let soft = LogarithmicStiffness {
        stiffness: 100.0,
        softening: 0.0,
        coupling: 0.2,
        capacity: 100.0,
        ..LogarithmicStiffness::FIRST
    };
    let elastic = scene.spring(soft, [pivots[1], alone]);
    for (spring, theta) in hot.into_iter().zip([380.0, 298.0]) {
        scene.set_temperature(spring, theta);
    }
    scene.set_temperature(elastic, 380.0);
    scene.conduct(hot[0], hot[1], 300.0);
    let mut run = Simulation::new(scene, SCHEME, 0.02).unwrap();

    let own = |run: &Simulation<3>, masses: &[(Node, f64)], springs: &[Element], pivot: Node| {
        let origin = run.position(pivot).unwrap();
        let mut energy: f64 = springs
            .iter()
            .map(|&spring| run.internal_energy(spring).unwrap())
            .sum();
        let mut momentum = nalgebra::SVector::<f64, 3>::zeros();
        for &(node, mass) in masses {
            let p = run.momentum(node).unwrap();
            energy += p.norm_squared() / (2.0 * mass);
            momentum += (run.position(node).unwrap() - origin).cross(&p);
        }
        (energy, momentum)
    };
    let both = |run: &Simulation<3>| {
        let heavy = [(upper, log.masses[0]), (lower, log.masses[1])];
        [
            own(run, &heavy, &hot, pivots[0]),
            own(run, &[(alone, 2.0)], &[elastic], pivots[1]),
        ]
    };
    let first = both(&run);
    let entropy = run.entropy(elastic).unwrap();
    for _ in 0..2_000 {
        run.step().unwrap();
        for ((energy, momentum), (energy0, momentum0)) in both(&run).into_iter().zip(first) {
            assert!((energy - energy0).abs() <= 1e-14 * energy0.abs());
            assert!((momentum - momentum0).norm() <= 1e-14 * momentum0.norm());
        }
        // An insulated elastic element keeps its entropy bit for bit.
        let kept = run.entropy(elastic).unwrap();
        assert_eq!(kept.to_bits(), entropy.to_bits());
    }
}

/// Conduction, an insulated element in the same body, and two kinds of dashpots.
#[test]
fn an_insulated_element_keeps_its_entropy_beside_others() {
    let mut scene = Scene::<2>::new();
    let pivot = scene.anchor([0.0; 2]);
    let nodes = [1.0, 2.2, 3.1].map(|x| scene.mass(1.0, [x, 0.1 * x], [0.0, 0.3 * x]));
    let warm = [[pivot, nodes[0]], [nodes[0], nodes[1]]]
        .map(|ends| scene.spring(ThermoViscoElastic::PENDULUM, ends));
    let alone = scene.spring(LogarithmicStiffness::FIRST, [nodes[1], nodes[2]]);
    let dashpots = scene.spring(TwoDashpots::DATA, [nodes[2], nodes[0]]);
    for (spring, theta) in warm
        .into_iter()
        .chain([alone, dashpots])
        .zip([380.0, 320.0, 300.0, 290.0])
    {
        scene.set_temperature(spring, theta);
    }
    scene.conduct(warm[0], warm[1], 10.0);
    let mut run = Simulation::new(scene, SCHEME, 0.01).unwrap();
    let entropy = run.entropy(alone).unwrap();
    let laws = laws_of(&mut run, 2_000);
    println!("{laws:?}");
    assert!(laws.energy * run.ledger().energy <= ROUNDING * HEAT);
    assert!(laws.angular_momentum <= ANGULAR_MOMENTUM);
    assert!(laws.entropy_ulps >= ENTROPY_ULPS);
    assert_eq!(run.entropy(alone).unwrap().to_bits(), entropy.to_bits());
}

// Weak dissipation: heat gives energy only where little of the production is needed.
#[test]
fn weak_conduction_is_not_drowned_in_corrections() {
    let grown = |h: f64| {
        let weak = DoublePendulum {
            conductance: 1e-4,
            ..DoublePendulum::KRUEGER
        };
        let mut run = weak.simulation(SCHEME, h).run;
        let first = run.ledger().entropy;
        end_of(&mut run, 100.0);
        run.ledger().entropy - first
    };
    let [coarse, fine] = [0.1, 0.05].map(grown);
    println!("{coarse:e} {fine:e}");
    assert!((coarse - fine).abs() <= 1e-3 * fine);
}

// Degenerate cases.

#[test]
fn equilibrium_at_rest_stays_where_it_is() {
    let mut scene = Scene::<3>::new();
    let pivot = scene.anchor([0.0; 3]);
    let bob = scene.mass(1.0, [2.0, 0.0, 0.0], [0.0; 3]);
    let spring = scene.spring(LogarithmicStiffness::FIRST, [pivot, bob]);
    scene.set_temperature(spring, 300.0);
    let mut run = Simulation::new(scene, SCHEME, 0.1).unwrap();
    for _ in 0..100 {
        run.step().unwrap();
    }
    assert_eq!(run.position(bob).unwrap().as_slice(), [2.0, 0.0, 0.0]);
    assert_eq!(run.temperature(spring), Ok(300.0));
}

#[test]
fn release_from_rest_and_motion_that_begins_with_heat() {
    for (positions, theta) in [([1.6, 0.0], 300.0), ([1.0, 0.0], 380.0)] {
        let mut scene = Scene::<2>::new();
        let pivot = scene.anchor([0.0; 2]);
        let bob = scene.mass(1.0, positions, [0.0; 2]);
        let spring = scene.spring(ThermoViscoElastic::PENDULUM, [pivot, bob]);
        scene.set_temperature(spring, theta);
        let air = scene.reservoir(300.0);
        scene.conduct(spring, air, 10.0);
        let mut run = Simulation::new(scene, SCHEME, 0.02).unwrap();
        let first = run.ledger();
        for _ in 0..2_000 {
            run.step().unwrap();
            let ledger = run.ledger();
            let scale = ledger.kinetic_energy + 400.0;
            assert!((ledger.energy - first.energy).abs() <= ENERGY * scale);
            // On a line with the pivot there is no angular momentum, and none appears.
            assert!(ledger.angular_momentum[2].abs() <= 1e-15);
        }
    }
}

#[test]
fn pure_conduction() {
    let mut scene = Scene::<2>::new();
    let nodes = [0.0, 1.0, 2.0].map(|x| scene.anchor([x, 0.0]));
    let springs = [[nodes[0], nodes[1]], [nodes[1], nodes[2]]]
        .map(|ends| scene.spring(ThermoViscoElastic::PENDULUM, ends));
    scene.set_temperature(springs[0], 350.0);
    scene.set_temperature(springs[1], 300.0);
    scene.conduct(springs[0], springs[1], 3.0);
    let mut run = Simulation::new(scene, SCHEME, 0.1).unwrap();
    let laws = laws_of(&mut run, 2_000);
    println!("{laws:?}");
    assert!(laws.energy <= ENERGY);
    assert!(laws.entropy_ulps >= ENTROPY_ULPS);
    let [one, other] = springs.map(|spring| run.temperature(spring).unwrap());
    assert!((one - other).abs() < 1e-6, "{one} {other}");
}

/// Nothing produces entropy: energy is given by motion, or by the shape at turning points.
#[test]
fn adiabatic_motion_keeps_its_entropy() {
    let mut scene = Scene::<3>::new();
    let pivot = scene.anchor([0.0; 3]);
    let masses = [
        scene.mass(1.0, [2.3, 0.0, 0.0], [0.0; 3]),
        scene.mass(2.0, [2.3, 2.2, 0.1], [0.0; 3]),
    ];
    let springs = [[pivot, masses[0]], [masses[0], masses[1]]]
        .map(|ends| scene.spring(LogarithmicStiffness::FIRST, ends));
    for (spring, theta) in springs.into_iter().zip([320.0, 300.0]) {
        scene.set_temperature(spring, theta);
    }
    let mut run = Simulation::new(scene, SCHEME, 0.004).unwrap();
    let entropies = springs.map(|spring| run.entropy(spring).unwrap().to_bits());
    let first = run.ledger().energy;
    for _ in 0..3_000 {
        run.step().unwrap();
        let energy = run.ledger().energy;
        assert!(
            (energy - first).abs() <= ROUNDING * 2.0 * HEAT,
            "{energy} {first}"
        );
        let kept = springs.map(|spring| run.entropy(spring).unwrap().to_bits());
        assert_eq!(kept, entropies);
    }
}

#[test]
fn steady_rotation_at_the_largest_entropy() {
    // Without conduction the dashpot brings the pendulum to a rotation of constant length.
    let mut scene = Scene::<2>::new();
    let pivot = scene.anchor([0.0; 2]);
    let bob = scene.mass(1.0, [1.2, 0.0], [0.0, 2.0]);
    let spring = scene.spring(ThermoViscoElastic::PENDULUM, [pivot, bob]);
    scene.set_temperature(spring, 300.0);
    let mut run = Simulation::new(scene, SCHEME, 0.05).unwrap();
    let laws = laws_of(&mut run, at_length(20_000, 5_000));
    println!("{laws:?}");
    assert!(laws.energy * run.ledger().energy.abs() <= ENERGY * 300.0);
    assert!(laws.angular_momentum <= ANGULAR_MOMENTUM);
    assert!(laws.entropy_ulps >= ENTROPY_ULPS);
}

// Loads.

/// Everything that acts: weight, a force of time, a moved anchor, a thermostat.
fn busy(h: f64) -> (Simulation<2>, [Node; 3], [Element; 3]) {
    let mut scene = Scene::<2>::new();
    let support = scene.anchor([0.0, 0.0]);
    let nodes = [[1.2, 0.1], [2.1, -0.4], [3.0, 0.2]].map(|at| scene.mass(1.0, at, [0.0, 0.4]));
    let ends = [
        [support, nodes[0]],
        [nodes[0], nodes[1]],
        [nodes[1], nodes[2]],
    ];
    let springs = ends.map(|ends| scene.spring(ThermoViscoElastic::PENDULUM, ends));
    for (spring, theta) in springs.into_iter().zip([320.0, 310.0, 300.0]) {
        scene.set_temperature(spring, theta);
    }
    scene.conduct(springs[0], springs[1], 3.0);
    scene.conduct(springs[1], springs[2], 2.0);
    let air = scene.reservoir(300.0);
    scene.conduct(springs[2], air, 1.0);
    scene.prescribe_temperature(springs[1], |t| 310.0 + 8.0 * (2.0 * t).sin());
    scene.set_gravity([0.0, -9.81]);
    scene.force(nodes[2], |t| [3.0 * (3.0 * t).sin(), 0.5]);
    scene.move_anchor(support, |t| [0.1 * (2.0 * t).sin(), 0.05 * (1.0 - t.cos())]);
    (Simulation::new(scene, SCHEME, h).unwrap(), nodes, springs)
}

#[test]
fn loads_are_booked_with_order_8() {
    let row = |h: f64| {
        let (mut run, nodes, springs) = busy(h);
        end_of(&mut run, 1.0);
        let ledger = run.ledger();
        let mut row = vec![ledger.work, ledger.heat, ledger.thermostat_entropy];
        for node in nodes {
            row.extend(run.position(node).unwrap().iter());
            row.extend(run.momentum(node).unwrap().iter());
        }
        row.extend(springs.map(|spring| run.entropy(spring).unwrap()));
        row
    };
    let exact = row(1.0 / 1024.0);
    let errors = [64.0, 128.0, 256.0].map(|steps| difference(&row(1.0 / steps), &exact));
    let found = slopes(&errors);
    println!("{errors:?} {found:?}");
    assert!(found.iter().all(|slope| *slope > 7.2), "{found:?}");
    assert!(errors[2] < 1e-10);
}

#[test]
fn weight_has_no_torque_about_the_vertical() {
    let mut scene = Scene::<3>::new();
    let pivot = scene.anchor([0.0; 3]);
    let masses =
        [[1.9, 0.3, -0.5], [2.5, 1.8, -1.0]].map(|at| scene.mass(1.0, at, [0.0, 1.0, 0.4]));
    let springs = [[pivot, masses[0]], [masses[0], masses[1]]]
        .map(|ends| scene.spring(LogarithmicStiffness::FIRST, ends));
    for spring in springs {
        scene.set_temperature(spring, 300.0);
    }
    scene.conduct(springs[0], springs[1], 10.0);
    scene.set_gravity([0.0, 0.0, -9.81]);
    let mut run = Simulation::new(scene, SCHEME, 0.005).unwrap();
    let first = run.ledger();
    for _ in 0..1_000 {
        run.step().unwrap();
    }
    let last = run.ledger();
    let change = last.angular_momentum[2] - first.angular_momentum[2];
    assert!(
        change.abs() <= 1e-13 * first.angular_momentum.norm(),
        "{change:e}"
    );
    assert!((last.balance - first.balance).abs() <= ROUNDING * 2.0 * HEAT);
}

#[test]
fn several_anchors_keep_the_energy() {
    let mut scene = Scene::<2>::new();
    let anchors = [[0.0, 0.0], [4.0, 0.0]].map(|at| scene.anchor(at));
    let bob = scene.mass(1.0, [1.9, 0.7], [0.5, 0.0]);
    let springs = anchors.map(|anchor| scene.spring(LogarithmicStiffness::FIRST, [anchor, bob]));
    scene.set_temperature(springs[0], 330.0);
    scene.set_temperature(springs[1], 300.0);
    scene.conduct(springs[0], springs[1], 20.0);
    let mut run = Simulation::new(scene, SCHEME, 0.005).unwrap();
    let laws = laws_of(&mut run, 2_000);
    println!("{laws:?}");
    assert!(laws.energy <= ENERGY);
    assert!(laws.entropy_ulps >= ENTROPY_ULPS);
}

// What it refuses.

#[test]
fn a_step_far_above_stability_says_so() {
    let mut run = single_pendulum(SCHEME, 1.0).run;
    let before = format!("{:?}", run.checkpoint());
    let error = loop {
        if let Err(error) = run.step() {
            break error;
        }
    };
    println!("{error}");
    let StepFailure::Unstable {
        rate,
        product,
        limit,
        scheme,
        ..
    } = error.failure
    else {
        panic!("{error}")
    };
    assert_eq!((rate, scheme), ("ωh", "eem-entropy"));
    assert!(product > limit);
    // The first step fails already, and leaves everything as it was.
    assert_eq!(before, format!("{:?}", run.checkpoint()));
    run.set_step_size(0.01).unwrap();
    run.step().unwrap();
}

#[test]
fn fast_conduction_says_so() {
    let mut scene = Scene::<2>::new();
    let nodes = [0.0, 1.0].map(|x| scene.anchor([x, 0.0]));
    let spring = scene.spring(ThermoViscoElastic::PENDULUM, nodes);
    scene.set_temperature(spring, 380.0);
    let air = scene.reservoir(300.0);
    scene.conduct(spring, air, 1e4);
    let mut run = Simulation::new(scene, SCHEME, 0.1).unwrap();
    let error = run.step().unwrap_err();
    println!("{error}");
    let is_heat = matches!(error.failure, StepFailure::Unstable { rate: "κh/c", .. });
    assert!(is_heat, "{error}");
}

/// A Debye solid: its heat capacity vanishes at absolute zero.
#[derive(Clone, Debug, FreeEnergy)]
#[free_energy(|lambda: Stretch, theta: Temperature| {
    0.5 * stiffness * (lambda - length).powi(2) - capacity * theta.powi(4) * lambda
})]
struct Debye {
    stiffness: f64,
    length: f64,
    capacity: f64,
}

#[test]
fn an_element_near_absolute_zero_is_named_with_its_capacity() {
    let debye = Debye {
        stiffness: 100.0,
        length: 1.0,
        capacity: 1e-9,
    };
    let mut scene = Scene::<2>::new();
    let nodes = [0.0, 1.0].map(|x| scene.anchor([x, 0.0]));
    let spring = table::spring(&mut scene, Arc::new(debye), nodes);
    scene.set_temperature(spring, 1.0);
    let ice = scene.reservoir(0.01);
    scene.conduct(spring, ice, 2e-9);
    let mut run = Simulation::new(scene, SCHEME, 1.0).unwrap();
    let error = loop {
        if let Err(error) = run.step() {
            break error;
        }
        assert!(run.time() < 1e4);
    };
    println!("{error}");
    let is_named = match error.failure {
        StepFailure::Unstable { rate: "κh/c", .. } => true,
        StepFailure::TooCold {
            element,
            heat_capacity,
            ..
        } => element == spring && heat_capacity > 0.0,
        StepFailure::State(StateError::Temperature { element, .. }) => element == spring,
        _ => false,
    };
    assert!(is_named, "{error}");
}

#[test]
fn solids_are_refused_with_the_reason() {
    use crate::support::solids::{SECTION, ThermoelasticSolid};
    let mut scene = Scene::<2>::new();
    let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let nodes = corners.map(|at| scene.node(at, [0.0; 2]));
    for point in scene.quadrilateral(ThermoelasticSolid::RUBBER, nodes, SECTION) {
        scene.set_temperature(point, 300.0);
    }
    let error = only_error(Simulation::new(scene, SCHEME, 0.01));
    println!("{error}");
    assert!(matches!(error, SceneError::NotForSolids { .. }));
}
