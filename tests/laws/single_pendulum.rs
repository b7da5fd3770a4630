//! Both laws and the momentum balance, at every step and for any step size.

use eem::prelude::*;

use crate::support::{DoublePendulum, Laws, LogarithmicStiffness, Pendulum, single_pendulum};

/// A few roundings of a sum of a handful of terms; the closing evaluation leaves no drift.
const ENERGY_TOLERANCE: f64 = 4e-15;
const ANGULAR_MOMENTUM_TOLERANCE: f64 = 5e-15;
/// The entropy is a sum of rounded terms; a difference of two can be off by an ulp of each.
const ENTROPY_TOLERANCE: f64 = -2.0;

/// García Orden & Romero (2012), §4.1.
const DURATION: f64 = 20.0;

fn assert_laws(laws: &Laws, what: &str) {
    println!("{what}: {laws:?}");
    assert!(laws.energy <= ENERGY_TOLERANCE, "{what}: {laws:?}");
    assert!(
        laws.angular_momentum <= ANGULAR_MOMENTUM_TOLERANCE,
        "{what}: {laws:?}"
    );
    assert!(laws.entropy_ulps >= ENTROPY_TOLERANCE, "{what}: {laws:?}");
}

/// The last printed digit of the energy, 14 digits; the entropy is printed with two less.
const PRINTED: f64 = 1e-13;

#[test]
fn initial_state_is_the_published_one() {
    let ledger = single_pendulum(Scheme::EemEntropy, 0.2).run.ledger();
    approx::assert_relative_eq!(ledger.energy, 1_704.623_703_153_6, max_relative = PRINTED);
    approx::assert_relative_eq!(
        ledger.entropy,
        5.425_832_690_2,
        max_relative = 100.0 * PRINTED
    );
    approx::assert_relative_eq!(ledger.angular_momentum[2], 3.0, max_relative = f64::EPSILON);
}

/// The schemes that keep all laws.
const STRUCTURE_PRESERVING: [Scheme; 3] = [
    Scheme::EemEntropy,
    Scheme::EemTemperature,
    Scheme::Staggered,
];

#[test]
fn hold_at_every_step_for_each_scheme_and_step_size() {
    for (scheme, step) in STRUCTURE_PRESERVING
        .into_iter()
        .flat_map(|scheme| [0.2, 0.1, 0.05].map(|step| (scheme, step)))
    {
        let Pendulum { mut run, .. } = single_pendulum(scheme, step);
        let mut laws = Laws::new(&run);
        let mut iterations = 0;
        while run.time() < DURATION {
            iterations += run.step().unwrap().iterations;
            laws.watch(&run);
        }
        let what = format!("{}, h = {step}, {iterations} iterations", scheme.name());
        assert_laws(&laws, &what);
    }
}

#[test]
fn hold_for_random_step_sizes() {
    for scheme in STRUCTURE_PRESERVING {
        hold_for_random_steps_of(scheme);
    }
}

fn hold_for_random_steps_of(scheme: Scheme) {
    let Pendulum { mut run, .. } = single_pendulum(scheme, 0.1);
    let mut laws = Laws::new(&run);
    // Steps of 10⁻⁶ … 0.2 s, uniform in the logarithm, from a fixed sequence (Knuth's LCG).
    let mut seed = 1_u64;
    for _ in 0..2_000 {
        seed = seed
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        #[expect(clippy::cast_precision_loss, reason = "53 random bits fit")]
        let uniform = (seed >> 11) as f64 / (1_u64 << 53) as f64;
        run.set_step_size(1e-6 * 2e5_f64.powf(uniform)).unwrap();
        run.step().unwrap();
        laws.watch(&run);
    }
    println!("t = {} s", run.time());
    assert_laws(&laws, &format!("{}, random steps", scheme.name()));
}

/// Roundings of the terms of an entropy by which the kept one may differ from that of the state.
const ENTROPY_ROUNDINGS: f64 = 4.0;

/// The scale of the entropy of a spring, `|s| + |∂s/∂λ| λ + c`, J/K.
fn entropy_scale(run: &Simulation<3>, law: &LogarithmicStiffness, spring: Element) -> f64 {
    let lambda = run.stretch(spring).unwrap();
    let x = [lambda, run.temperature(spring).unwrap()];
    // ∂s/∂λ = −∂²ψ/∂λ∂θ.
    let (_, [_, [by_lambda, _]]) = law.hessian(&x);
    let heat_capacity = law.caloric(&x).heat_capacity;
    run.entropy(spring).unwrap().abs() + (by_lambda * lambda).abs() + heat_capacity
}

#[test]
fn the_kept_entropy_is_that_of_the_state() {
    let case = DoublePendulum::LOGARITHMIC;
    let laws = [0, 1].map(|i| LogarithmicStiffness {
        stiffness: case.stiffness[i],
        softening: case.softening[i],
        coupling: case.coupling,
        capacity: case.capacity[i],
        natural_length: [2.0, 1.0][i],
        theta_ref: 300.0,
    });
    for (scheme, step) in [
        (Scheme::EemEntropy, case.step),
        (Scheme::EemTemperature, case.step),
        (Scheme::EemExplicit, 0.02),
    ] {
        let mut double = case.simulation(scheme, step);
        let mut worst = 0.0_f64;
        for _ in 0..1_000 {
            double.run.step().unwrap();
            let springs = laws.iter().zip(double.springs);
            let scale: f64 = springs
                .map(|(law, spring)| entropy_scale(&double.run, law, spring))
                .sum();
            let ledger = double.run.ledger();
            let difference = ledger.element_entropy_of_state - ledger.element_entropy;
            worst = worst.max(difference.abs() / (f64::EPSILON * scale));
        }
        println!("{}: {worst:.2} ε of the terms", scheme.name());
        assert!(worst <= ENTROPY_ROUNDINGS, "{}: {worst}", scheme.name());
    }
}

/// When a run is no longer one: the time at which Newton's method finds no state, and the first time
/// at which the energy is off by more than 1 %.
fn breakdown(scheme: Scheme) -> (f64, f64) {
    let Pendulum { mut run, .. } = single_pendulum(scheme, 0.2);
    let (mut laws, mut off) = (Laws::new(&run), f64::INFINITY);
    while run.time() < DURATION {
        if let Err(error) = run.step() {
            println!("{}: {error}, {laws:?}", scheme.name());
            return (error.time, off);
        }
        laws.watch(&run);
        if laws.energy > 0.01 {
            off = off.min(run.time());
        }
    }
    (f64::INFINITY, off)
}

// García Orden & Romero (2012), figure 7: the solutions by the ordinary rules end within the run.
#[test]
fn ordinary_rules_break_down_where_they_are_known_to() {
    let (failed, off) = breakdown(Scheme::Midpoint);
    let time = failed.min(off);
    assert!((12.0..=16.0).contains(&time), "midpoint at {time} s");
    // The energy of the trapezoidal rule is off from the first steps on; what ends it is Newton.
    let (failed, off) = breakdown(Scheme::Trapezoidal);
    assert!((14.0..=17.0).contains(&failed), "trapezoidal at {failed} s");
    assert!(off < 1.0);
}

#[test]
fn a_failed_step_changes_nothing() {
    let mut pendulum = single_pendulum(Scheme::Trapezoidal, 0.2);
    while pendulum.run.time() < DURATION {
        let before = (pendulum.run.time(), pendulum.row(), pendulum.run.ledger());
        if let Err(error) = pendulum.run.step() {
            assert_eq!(
                before,
                (pendulum.run.time(), pendulum.row(), pendulum.run.ledger())
            );
            assert!((error.time - before.0).abs() <= 0.0);
            assert!(!error.history.is_empty());
            // The state is sound: a smaller step goes on from it.
            pendulum.run.set_step_size(0.001).unwrap();
            pendulum.run.step().unwrap();
            return;
        }
    }
    panic!("the trapezoidal rule is known to fail");
}
