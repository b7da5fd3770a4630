//! The laws over the whole of the published double pendulums.

use eem::prelude::*;
use eem_testkit::length::at_length;

use crate::support::{DoublePendulum, Laws};

const ENERGY_TOLERANCE: f64 = 4e-15;
/// The case of Krüger runs twenty times longer; the rounding of its steps adds up like a walk.
const ENERGY_TOLERANCE_LONG: f64 = 2e-14;
const ANGULAR_MOMENTUM_TOLERANCE: f64 = 1e-13;
const ENTROPY_TOLERANCE: f64 = -2.0;

/// Digits of the published initial values.
const PRINTED: f64 = 1e-5;

#[test]
fn start_at_the_published_values() {
    for case in DoublePendulum::ALL {
        let ledger = case.simulation(Scheme::EemEntropy, case.step).run.ledger();
        let [energy, entropy, momentum] = case.start;
        approx::assert_relative_eq!(ledger.energy, energy, max_relative = 1e-13);
        approx::assert_relative_eq!(ledger.entropy, entropy, max_relative = 1e-10);
        let norm = ledger.angular_momentum.norm();
        approx::assert_relative_eq!(norm, momentum, max_relative = PRINTED);
    }
}

#[test]
fn eem_schemes_keep_all_laws_at_the_published_steps_and_below() {
    for case in DoublePendulum::ALL {
        for scheme in [Scheme::EemEntropy, Scheme::EemTemperature] {
            for fraction in [1.0, 0.5, 0.25] {
                let step = case.step * fraction;
                let duration = case.duration * at_length(1.0, 0.2);
                let laws = Laws::until(&mut case.simulation(scheme, step).run, duration);
                let long = case.duration > 100.0;
                let energy = if long {
                    ENERGY_TOLERANCE_LONG
                } else {
                    ENERGY_TOLERANCE
                };
                assert!(laws.energy <= energy);
                assert!(laws.angular_momentum <= ANGULAR_MOMENTUM_TOLERANCE);
                assert!(laws.entropy_ulps >= ENTROPY_TOLERANCE);
            }
        }
    }
}

// Kern, Romero, Conde Martín & García Orden (2021): momenta exact, energy bounded.
#[test]
fn the_variational_scheme_stays_near_its_energy() {
    let case = DoublePendulum::LOGARITHMIC;
    let mut run = case.simulation(Scheme::Variational, 0.1).run;
    let laws = Laws::until(&mut run, case.duration);
    assert!(laws.energy <= 3e-4);
    assert!(laws.angular_momentum <= 1e-12);
}

/// When an ordinary rule is no longer a solution, because Newton's method finds no state or the
/// energy is off by more than 1 %, and its largest defects over the run.
fn attempt(case: &DoublePendulum, scheme: Scheme, step: f64) -> (f64, Laws) {
    let mut run = case.simulation(scheme, step).run;
    let (mut laws, mut broken) = (Laws::new(&run), f64::INFINITY);
    while run.time() < case.duration {
        if run.step().is_err() {
            broken = broken.min(run.time());
            break;
        }
        laws.watch(&run);
        if laws.energy > 0.01 {
            broken = broken.min(run.time());
        }
    }
    let (name, time) = (scheme.name(), run.time());
    println!("{name} h = {step}: broken at {broken} s, ends at {time} s, {laws:?}");
    (broken, laws)
}

// Conde Martín, Betsch & García Orden (2016), figures 12–17, and the same in entropy variables.
#[test]
fn ordinary_rules_lose_the_laws_in_the_logarithmic_case() {
    let case = DoublePendulum::LOGARITHMIC;
    let (broken, laws) = attempt(&case, Scheme::MidpointTemperature, 0.1);
    assert!(broken < 12.0);
    assert!(laws.energy > 0.1 && laws.angular_momentum < 1e-12);
    let (_, laws) = attempt(&case, Scheme::Midpoint, 0.1);
    assert!(laws.energy > 0.01 && laws.angular_momentum < 1e-12);
    let (_, laws) = attempt(&case, Scheme::TrapezoidalTemperature, 0.1);
    assert!(laws.energy > 0.1 && laws.angular_momentum > 1.0);
    let (_, laws) = attempt(&case, Scheme::Trapezoidal, 0.1);
    assert!(laws.energy > 0.01 && laws.angular_momentum > 0.1);
}
