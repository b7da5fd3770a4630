//! The energy–entropy–momentum schemes of order 4 and 6: how their errors shrink, their tangent, and the laws
//! of every step.

use eem::prelude::*;
use eem_testkit::length::at_length;

use crate::support::dashpots::{ONE_DASHPOT, TwoDashpots};
use crate::support::orders::{double_error, exact_row, slope, step_to};
use crate::support::tangents::assert_tangent;
use crate::support::{
    DoublePendulum, Laws, ThermoViscoElastic, hencky, pendulums_in_contact, single_pendulum,
};

const SCHEMES: [Scheme; 2] = [Scheme::EemEntropy4, Scheme::EemEntropy6];

/// A random walk of roundings, as with the scheme of second order.
const ENERGY_TOLERANCE: f64 = 4e-15;
const MOMENTUM_TOLERANCE: f64 = 5e-15;
/// The entropy is a sum of rounded terms; a difference of two can be off by an ulp of each.
const ENTROPY_TOLERANCE: f64 = -2.0;
/// Roundings of 200 steps, relative to the sum of the magnitudes in the balance.
const BALANCE_TOLERANCE: f64 = 4e-15;

/// Where J is a small difference of moments, and for sums over a network: what the scheme of second order
/// shows there, too.
const NETWORK_MOMENTUM_TOLERANCE: f64 = 1e-13;

/// The units of the errors of q, p, γ, θ and σ: those of q, p and γ are behind the published numbers, in
/// which θ and σ never are the largest.
const UNITS: [f64; 7] = [3.0, 3.0, 10.0, 10.0, 0.1, 300.0, 5.7];

/// The largest error of the single pendulum at the time `end`.
fn error(scheme: Scheme, step: f64, end: f64) -> f64 {
    // time, q_x, q_y, p_x, p_y, γ, θ, σ, error estimate
    let exact = exact_row("single_pendulum", end);
    let mut pendulum = single_pendulum(scheme, step);
    step_to(&mut pendulum.run, end);
    let [qx, qy, px, py, theta, gamma, sigma] = pendulum.row();
    let row = [qx, qy, px, py, gamma, theta, sigma];
    let differences = row.iter().zip(&exact[1..]).zip(UNITS);
    let errors = differences.map(|((x, exact), unit)| (x - exact).abs() / unit);
    errors.fold(0.0, f64::max)
}

#[test]
fn the_single_pendulum_shows_orders_four_and_six() {
    let orders = [
        (Scheme::EemEntropy4, 4.0, 0.15, [3.2e-5, 7.4e-9]),
        (Scheme::EemEntropy6, 6.0, 0.3, [4.6e-7, 1.9e-12]),
    ];
    for (scheme, order, tolerance, published) in orders {
        let errors = [0.05, 0.025, 0.0125, 0.00625].map(|step| error(scheme, step, 2.0));
        println!("{scheme}: {errors:?}, slope {}", slope(&errors));
        assert!((slope(&errors) - order).abs() <= tolerance);
        for (error, published) in [errors[0], errors[3]].into_iter().zip(published) {
            assert!((0.5..=2.0).contains(&(error / published)));
        }
    }
}

// Of a prototype in Python.
#[test]
fn the_single_pendulum_has_the_published_errors_after_twenty_seconds() {
    let published = [
        (Scheme::EemEntropy4, [3.3e-3, 2.2e-4, 3.0e-5]),
        (Scheme::EemEntropy6, [3.2e-4, 4.1e-5, 5.3e-7]),
    ];
    for (scheme, published) in published {
        for (step, published) in [0.2, 0.1, 0.05].into_iter().zip(published) {
            let error = error(scheme, step, 20.0);
            println!("{scheme}, h = {step}: {error:e}, published {published:e}");
            assert!((0.5..=2.0).contains(&(error / published)));
        }
    }
}

// Heat flows between the springs.
#[test]
fn double_pendulums_show_the_orders_too() {
    let cases = [
        (DoublePendulum::ROMERO, [0.005, 0.01]),
        (DoublePendulum::KRUEGER, [0.02, 0.05]),
        (DoublePendulum::LOGARITHMIC, [0.0125, 0.0125]),
    ];
    for (case, steps) in cases {
        for ((scheme, step), order) in SCHEMES.into_iter().zip(steps).zip([4.0, 6.0]) {
            let errors = [1.0, 0.5, 0.25].map(|part| double_error(&case, scheme, part * step, 1.0));
            println!(
                "{} {scheme}: {errors:?}, slope {}",
                case.name,
                slope(&errors)
            );
            assert!((slope(&errors) - order).abs() <= 0.3);
        }
    }
}

fn assert_lawful(laws: &Laws, momentum: f64) {
    assert!(laws.energy <= ENERGY_TOLERANCE, "{laws:?}");
    assert!(laws.angular_momentum <= momentum, "{laws:?}");
    assert!(laws.entropy_ulps >= ENTROPY_TOLERANCE, "{laws:?}");
}

#[test]
fn the_single_pendulum_keeps_all_laws() {
    for scheme in SCHEMES {
        for step in [0.2, 0.1, 0.05, 0.01] {
            let laws = Laws::until(&mut single_pendulum(scheme, step).run, 20.0);
            assert_lawful(&laws, MOMENTUM_TOLERANCE);
        }
    }
}

// From the published steps on, with heat between the springs.
#[test]
fn double_pendulums_keep_all_laws() {
    for case in DoublePendulum::ALL {
        for scheme in SCHEMES {
            for fraction in [1.0, 0.5] {
                let mut run = case.simulation(scheme, fraction * case.step).run;
                println!("{}", case.name);
                let laws = Laws::until(&mut run, case.duration.min(at_length(25.0, 10.0)));
                assert_lawful(&laws, NETWORK_MOMENTUM_TOLERANCE);
            }
        }
    }
}

#[test]
fn stiff_and_weak_conduction_keep_all_laws() {
    for scheme in SCHEMES {
        for conductance in [1e-6, 1.0, 1e3, 1e9] {
            let (iterations, laws) = pendulums_in_contact(scheme, 0.02, conductance);
            println!("{scheme}, {conductance} W/K: {iterations} iterations, {laws:?}");
            assert_lawful(&laws, NETWORK_MOMENTUM_TOLERANCE);
        }
    }
}

/// The sum of the magnitudes that enter the balance, whose roundings its defect is made of.
fn magnitude<const D: usize>(ledger: &Ledger<D>) -> f64 {
    let terms = [
        ledger.kinetic_energy,
        ledger.potential_energy,
        ledger.internal_energy,
        ledger.work,
        ledger.heat,
        300.0 * ledger.element_entropy,
    ];
    terms.into_iter().map(f64::abs).sum()
}

fn assert_balanced<const D: usize>(run: &mut Simulation<D>, steps: usize) {
    let first = run.ledger();
    let (mut size, mut defect, mut before) = (magnitude(&first), 0.0_f64, first.entropy);
    for _ in 0..steps {
        run.step().unwrap();
        let ledger = run.ledger();
        size = size.max(magnitude(&ledger));
        defect = defect.max((ledger.balance - first.balance).abs());
        let rounding = f64::EPSILON * ledger.entropy.abs();
        assert!(ledger.entropy - before >= ENTROPY_TOLERANCE * rounding);
        before = ledger.entropy;
    }
    println!("{}: balance off by {:e}", run.scheme(), defect / size);
    assert!(defect <= BALANCE_TOLERANCE * size);
}

/// A viscous spring under gravity from a support, pushed by forces of time.
fn pushed(scheme: Scheme, step: f64, moves: bool) -> Simulation<2> {
    let mut scene = Scene::<2>::new();
    let support = scene.anchor([0.0, 0.0]);
    let bob = scene.mass(1.0, [0.3, -1.2], [0.5, 0.0]);
    let spring = scene.spring(ThermoViscoElastic::PENDULUM, [support, bob]);
    scene.set_temperature(spring, 320.0);
    let air = scene.reservoir(300.0);
    scene.conduct(spring, air, 10.0);
    scene.set_gravity([0.0, -9.81]);
    scene.force(bob, |t| [5.0 * (3.0 * t).sin(), 2.0]);
    if moves {
        scene.move_anchor(support, |t| {
            [0.1 * (2.0 * t).sin(), 0.05 * (1.0 - (5.0 * t).cos())]
        });
    }
    Simulation::new(scene, scheme, step).unwrap()
}

/// Two springs in contact, the first with a temperature that is given.
fn kept_warm(scheme: Scheme, step: f64) -> Simulation<2> {
    let mut scene = Scene::<2>::new();
    let pivot = scene.anchor([0.0, 0.0]);
    let nodes = [
        scene.mass(1.0, [1.2, 0.0], [0.0, 1.0]),
        scene.mass(1.0, [2.3, 0.3], [0.0, 0.0]),
    ];
    let ends = [[pivot, nodes[0]], [nodes[0], nodes[1]]];
    let springs = ends.map(|ends| scene.spring(ThermoViscoElastic::PENDULUM, ends));
    scene.set_temperature(springs[0], 320.0);
    scene.set_temperature(springs[1], 300.0);
    scene.conduct(springs[0], springs[1], 5.0);
    scene.prescribe_temperature(springs[0], |t| 320.0 + 20.0 * (2.0 * t).sin());
    Simulation::new(scene, scheme, step).unwrap()
}

#[test]
fn loads_moved_anchors_and_thermostats_close_the_balance() {
    for scheme in SCHEMES {
        assert_balanced(&mut pushed(scheme, 0.05, false), 200);
        assert_balanced(&mut pushed(scheme, 0.05, true), 200);
        assert_balanced(&mut kept_warm(scheme, 0.02), 200);
    }
}

// What is prescribed is interpolated between the old state and as many times as there are stages.
#[test]
fn loads_moved_anchors_and_thermostats_keep_the_order() {
    let end_of = |mut run: Simulation<2>, end: f64| {
        while run.time() < end - 0.5 * run.step_size() {
            run.step().unwrap();
        }
        let ledger = run.ledger();
        let total = ledger.work + ledger.heat;
        [ledger.kinetic_energy, ledger.internal_energy, total]
    };
    for (scheme, (order, step)) in SCHEMES.into_iter().zip([(4.0, 0.01), (6.0, 0.02)]) {
        let builders: [&dyn Fn(f64) -> Simulation<2>; 2] =
            [&|h| pushed(scheme, h, true), &|h| kept_warm(scheme, h)];
        for build in builders {
            let exact = end_of(build(step / 16.0), 0.4);
            let errors = [1.0, 0.5, 0.25].map(|part| {
                let pairs = end_of(build(part * step), 0.4).into_iter().zip(exact);
                pairs.fold(0.0_f64, |most, (x, exact)| most.max((x - exact).abs()))
            });
            println!("{scheme}: {errors:?}, slope {}", slope(&errors));
            assert!((slope(&errors) - order).abs() <= 0.4);
        }
    }
}

#[test]
fn several_dashpots_and_springs_without_temperature_keep_all_laws() {
    for scheme in SCHEMES {
        let mut scene = Scene::<3>::new();
        let places = [[0.0; 3], [1.1, 0.0, 0.0], [0.4, 0.9, 0.0], [0.3, 0.2, 0.8]];
        let nodes = places.map(|at| scene.mass(1.0, at, [0.2 - at[1], at[0], 0.1]));
        let viscous = scene.spring(TwoDashpots::DATA, [nodes[0], nodes[1]]);
        let hot = scene.spring(ONE_DASHPOT, [nodes[1], nodes[2]]);
        let hencky = || hencky(40.0, 1.0);
        scene.spring(hencky(), [nodes[2], nodes[3]]);
        scene.spring(hencky(), [nodes[3], nodes[0]]);
        scene.set_temperature(viscous, 350.0);
        scene.set_temperature(hot, 300.0);
        scene.conduct(viscous, hot, 3.0);
        let mut run = Simulation::new(scene, scheme, 0.05).unwrap();
        let first = run.ledger();
        assert_balanced(&mut run, 200);
        let last = run.ledger();
        let linear = (last.linear_momentum - first.linear_momentum).norm();
        let angular = (last.angular_momentum - first.angular_momentum).norm();
        println!("momenta off by {linear:e} and {angular:e}");
        assert!(linear <= NETWORK_MOMENTUM_TOLERANCE * first.linear_momentum.norm());
        assert!(angular <= NETWORK_MOMENTUM_TOLERANCE * first.angular_momentum.norm());
    }
}

/// Of two pendulums in contact.
#[test]
fn the_tangent_is_that_of_the_residual() {
    for scheme in SCHEMES {
        let mut scene = Scene::<2>::new();
        let pivot = scene.anchor([0.0, 0.0]);
        let nodes = [
            scene.mass(1.0, [1.2, 0.0], [0.0, 1.0]),
            scene.mass(1.0, [2.3, 0.3], [0.3, -0.7]),
        ];
        let ends = [[pivot, nodes[0]], [nodes[0], nodes[1]]];
        let springs = ends.map(|ends| scene.spring(ThermoViscoElastic::PENDULUM, ends));
        scene.set_temperature(springs[0], 380.0);
        scene.set_temperature(springs[1], 300.0);
        scene.conduct(springs[0], springs[1], 7.0);
        let air = scene.reservoir(290.0);
        scene.conduct(springs[1], air, 3.0);
        let mut run = Simulation::new(scene, scheme, 0.15).unwrap();
        let count = run.unknowns();
        let per_set = count / if scheme == Scheme::EemEntropy4 { 2 } else { 3 };
        let at: Vec<_> = (0..count)
            .map(|index| {
                #[expect(clippy::cast_precision_loss, reason = "a handful of unknowns")]
                let wave = (1.3 * index as f64).sin();
                match index % per_set {
                    4 => 350.0 + 5.0 * wave,
                    5 => 310.0 + 5.0 * wave,
                    _ => 0.12 * wave,
                }
            })
            .collect();
        let width = |column: usize| if column % per_set < 4 { 1e-4 } else { 1e-2 };
        assert_tangent(&mut run, &at, 0..count, (width, 1e-8));
    }
}

// The temperature falls by a factor of a thousand or more within the step.
#[test]
fn a_mean_temperature_that_is_not_positive_is_refused_with_the_reason() {
    for (scheme, theta) in SCHEMES.into_iter().zip([1e5, 1e4]) {
        let mut scene = Scene::<2>::new();
        let pivot = scene.anchor([0.0, 0.0]);
        let bob = scene.mass(1.0, [1.0, 0.0], [0.0, 0.0]);
        let spring = scene.spring(ONE_DASHPOT, [pivot, bob]);
        scene.set_temperature(spring, theta);
        let cold = scene.reservoir(10.0);
        scene.conduct(spring, cold, 1e3);
        let mut run = Simulation::new(scene, scheme, 0.1).unwrap();
        let before = run.ledger();
        let error = run.step().unwrap_err().to_string();
        println!("{error}");
        assert!(error.contains(
            "the mean temperature of element 0 (MaxwellDamper) at a stage of the step is -"
        ));
        assert_eq!(run.ledger(), before);
        assert_eq!(run.position(bob).unwrap().x.to_bits(), 1.0_f64.to_bits());
    }
}

/// By how much a pendulum on a nearly rigid spring, released horizontally, is late after the period of the
/// rigid one, s.
fn lag(scheme: Scheme, steps: u32) -> f64 {
    // 4 K(½) √(l/g)
    const PERIOD: f64 = 2.367_841_947_576_24;
    const GRAVITY: f64 = 9.81;
    let mut scene = Scene::<2>::new();
    let pivot = scene.anchor([0.0, 0.0]);
    let bob = scene.mass(1.0, [1.0, 0.0], [0.0, 0.0]);
    let rod = hencky(1e8, 1.0);
    scene.spring(rod, [pivot, bob]);
    scene.set_gravity([0.0, -GRAVITY]);
    let mut run = Simulation::new(scene, scheme, PERIOD / f64::from(steps)).unwrap();
    for _ in 0..steps {
        run.step().unwrap();
    }
    // At rest again, and falling from then on.
    run.momentum(bob).unwrap().y / GRAVITY
}

// The steps are 80 times the period of the vibrations of the spring, which no scheme resolves.
#[test]
fn a_nearly_rigid_pendulum_swings_with_the_order_of_the_scheme() {
    let [second, fourth, sixth] = [Scheme::EemEntropy, Scheme::EemEntropy4, Scheme::EemEntropy6]
        .map(|scheme| lag(scheme, 48));
    println!("late by {second:e}, {fourth:e}, {sixth:e} s");
    assert!((5e-3..1e-2).contains(&second.abs()));
    assert!(fourth.abs() <= 2e-5);
    assert!(sixth.abs() <= 1e-6);
}
