//! A load, a motion or a temperature from outside that makes no sense ends the step with its name,
//! value and time, and changes nothing.

use eem::prelude::*;
use eem::{StepError, StepFailure};

use crate::support::ThermoViscoElastic;

/// Time of the third step's end with h = 0.1 s, and a time in its middle at which all is lost.
const STEP: f64 = 0.1;
const BAD_FROM: f64 = 0.22;

/// What acts on the pendulum once all is lost: force, N, temperature, K, height of the pivot, m.
#[derive(Clone, Copy)]
struct Outside {
    force: f64,
    temperature: f64,
    pivot: f64,
}

const HARMLESS: Outside = Outside {
    force: 0.0,
    temperature: 300.0,
    pivot: 0.0,
};

/// A driven pendulum, with its mass, spring and pivot.
fn pendulum(scheme: Scheme, outside: Outside) -> (Simulation<2>, Node, Element, Node) {
    let mut scene = Scene::<2>::new();
    let pivot = scene.anchor([0.0, 0.0]);
    let bob = scene.mass(1.0, [1.5, 0.0], [0.0, 0.0]);
    let spring = scene.spring(ThermoViscoElastic::PENDULUM, [pivot, bob]);
    scene.set_temperature(spring, 300.0);
    let late = |t: f64, bad: f64, good: f64| if t > BAD_FROM { bad } else { good };
    scene.force(bob, move |t| [late(t, outside.force, 0.0), 0.0]);
    scene.prescribe_temperature(spring, move |t| late(t, outside.temperature, 300.0));
    scene.move_anchor(pivot, move |t| [0.0, late(t, outside.pivot, 0.0)]);
    let run = Simulation::new(scene, scheme, STEP).unwrap();
    (run, bob, spring, pivot)
}

/// Everything that can be asked of the state, bit for bit.
fn bits(run: &Simulation<2>, bob: Node, spring: Element, pivot: Node) -> Vec<u64> {
    let vectors = [
        run.position(bob).unwrap(),
        run.momentum(bob).unwrap(),
        run.position(pivot).unwrap(),
    ];
    let numbers = [
        run.time(),
        run.temperature(spring).unwrap(),
        run.entropy(spring).unwrap(),
        run.viscous_stretch(spring, 0).unwrap(),
        run.ledger().balance,
        run.ledger().work,
        run.ledger().heat,
    ];
    let components = vectors.iter().flat_map(|vector| vector.iter().copied());
    components.chain(numbers).map(f64::to_bits).collect()
}

/// The failure of the third step of every scheme, which leaves the state as it was; twice, so that
/// the first failure has not changed what decides about the second.
fn failures(outside: Outside) -> Vec<StepFailure> {
    let failure = |scheme: Scheme| {
        let (mut run, bob, spring, pivot) = pendulum(scheme, outside);
        run.step().unwrap();
        run.step().unwrap();
        let before = bits(&run, bob, spring, pivot);
        let [first, second]: [StepError; 2] = [(); 2].map(|()| run.step().unwrap_err());
        assert_eq!(before, bits(&run, bob, spring, pivot), "{}", scheme.name());
        assert!((first.time - 2.0 * STEP).abs() < 1e-12);
        assert_eq!(first.to_string(), second.to_string());
        println!("{}: {first}", scheme.name());
        first.failure
    };
    Scheme::ALL.into_iter().map(failure).collect()
}

#[test]
fn loads_that_are_not_finite() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let outside = Outside {
            force: bad,
            ..HARMLESS
        };
        for failure in failures(outside) {
            let StepFailure::Load {
                axis, value, time, ..
            } = failure
            else {
                panic!("{failure}");
            };
            assert_eq!((axis, value.to_bits()), (0, bad.to_bits()));
            assert!(time > BAD_FROM && time <= 3.0 * STEP + 1e-12);
        }
    }
}

#[test]
fn prescribed_temperatures_that_are_not_positive() {
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let outside = Outside {
            temperature: bad,
            ..HARMLESS
        };
        for failure in failures(outside) {
            let StepFailure::PrescribedTemperature { value, time, .. } = failure else {
                panic!("{failure}");
            };
            assert_eq!(value.to_bits(), bad.to_bits());
            assert!(time > BAD_FROM && time <= 3.0 * STEP + 1e-12);
        }
    }
}

#[test]
fn motions_that_are_not_finite() {
    for bad in [f64::NAN, f64::INFINITY] {
        let outside = Outside {
            pivot: bad,
            ..HARMLESS
        };
        for failure in failures(outside) {
            assert!(
                matches!(failure, StepFailure::Motion { axis: 1, value, .. }
                    if value.to_bits() == bad.to_bits()),
                "{failure}"
            );
        }
    }
}

#[test]
fn the_run_goes_on_when_the_load_has_come_to_its_senses() {
    let mut scene = Scene::<2>::new();
    let bob = scene.mass(1.0, [0.0, 0.0], [1.0, 0.0]);
    scene.force(bob, |t| {
        [
            if (0.2..0.4).contains(&t) {
                f64::NAN
            } else {
                0.0
            },
            0.0,
        ]
    });
    let mut run = Simulation::new(scene, Scheme::EemEntropy, STEP).unwrap();
    run.step().unwrap();
    run.step().unwrap();
    assert!(run.step().is_err());
    // A step whose middle lies behind the gap.
    run.set_step_size(0.5).unwrap();
    run.step().unwrap();
    approx::assert_relative_eq!(run.position(bob).unwrap().x, 0.7, max_relative = 1e-15);
}

#[test]
fn a_force_on_an_anchor() {
    let mut scene = Scene::<2>::new();
    let pivot = scene.anchor([0.0, 0.0]);
    scene.force(pivot, |_| [0.0, 0.0]);
    let error = Simulation::new(scene, Scheme::EemEntropy, STEP).unwrap_err();
    assert_eq!(
        error.to_string(),
        "node 0 cannot be given a force: it is an anchor"
    );
}
