//! Entropy form for a material whose s(θ) has no closed inverse, on one mass.

use eem::prelude::*;
use eem::{StateError, StepFailure};

use crate::support::{Laws, LogarithmicStiffness, only_error};

const ENERGY_TOLERANCE: f64 = 4e-15;
/// Relative to |q||p|, whose products J is a difference of.
const ANGULAR_MOMENTUM_TOLERANCE: f64 = 5e-15;
const ENTROPY_TOLERANCE: f64 = -2.0;

fn pendulum(temperature: f64, step: f64) -> (Simulation<3>, Node, Element) {
    let mut scene = Scene::<3>::new();
    let pivot = scene.anchor([0.0; 3]);
    let bob = scene.mass(10.0, [3.0, 0.0, 0.5], [0.0, 1.0, 0.0]);
    let spring = scene.spring(LogarithmicStiffness::FIRST, [pivot, bob]);
    scene.set_temperature(spring, temperature);
    let air = scene.reservoir(300.0);
    scene.conduct(spring, air, 300.0);
    let run = Simulation::new(scene, Scheme::EemEntropy, step).unwrap();
    (run, bob, spring)
}

#[test]
fn keeps_all_laws_over_25_seconds() {
    let (mut run, bob, spring) = pendulum(380.0, 0.1);
    let mut laws = Laws::new(&run);
    let mut products = 0.0_f64;
    let mut temperatures = (f64::INFINITY, 0.0_f64);
    while run.time() < 25.0 {
        run.step().unwrap();
        laws.watch(&run);
        let (q, p) = (run.position(bob).unwrap(), run.momentum(bob).unwrap());
        products = products.max(q.norm() * p.norm());
        let theta = run.temperature(spring).unwrap();
        temperatures = (temperatures.0.min(theta), temperatures.1.max(theta));
    }
    println!("{laws:?}, temperatures {temperatures:?}");
    assert!(laws.energy <= ENERGY_TOLERANCE);
    let angular_momentum = run.ledger().angular_momentum.norm();
    println!("|q||p| up to {products}, J = {angular_momentum}");
    assert!(laws.angular_momentum <= ANGULAR_MOMENTUM_TOLERANCE * products / angular_momentum);
    assert!(laws.entropy_ulps >= ENTROPY_TOLERANCE);
    // Heat flows to the air: the run is not an isothermal one.
    assert!(temperatures.1 - temperatures.0 > 1.0);
}

// C = c − C¹ θ_r L²/(2θ)·…: at a large strain and a low temperature the heat capacity is negative.
#[test]
fn a_state_beyond_the_spinodal_is_refused() {
    let mut scene = Scene::<3>::new();
    let pivot = scene.anchor([0.0; 3]);
    let bob = scene.mass(10.0, [200.0, 0.0, 0.0], [0.0; 3]);
    let spring = scene.spring(LogarithmicStiffness::FIRST, [pivot, bob]);
    scene.set_temperature(spring, 10.0);
    let error = only_error(Simulation::new(scene, Scheme::EemEntropy, 0.1));
    let SceneError::State(StateError::HeatCapacity {
        element,
        value,
        temperature,
    }) = error
    else {
        panic!("{error}");
    };
    assert_eq!(element, spring);
    assert!(value < 0.0);
    approx::assert_relative_eq!(temperature, 10.0);
}

// C = c − C¹ θ_r L²/2θ vanishes at θ_c = C¹ θ_r L²/2c ≈ 150 K here; the air is colder than that.
#[test]
fn a_run_that_cools_to_the_spinodal_ends_there() {
    let mut scene = Scene::<3>::new();
    let model = LogarithmicStiffness {
        capacity: 50.0,
        natural_length: 1.0,
        ..LogarithmicStiffness::FIRST
    };
    // The masses are too heavy to move much: the strain stays ln e = 1.
    let ends = [0.0, std::f64::consts::E].map(|x| scene.mass(1e6, [x, 0.0, 0.0], [0.0; 3]));
    let spring = scene.spring(model, ends);
    scene.set_temperature(spring, 300.0);
    let air = scene.reservoir(100.0);
    scene.conduct(spring, air, 20.0);
    let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.01).unwrap();
    let mut laws = Laws::new(&run);
    let error = loop {
        match run.step() {
            Ok(_) => laws.watch(&run),
            Err(error) => break error,
        }
        assert!(run.time() < 100.0, "the spring cools below 150 K");
    };
    let theta = run.temperature(spring).unwrap();
    println!("{theta} K: {error}");
    assert!((149.0..170.0).contains(&theta));
    assert!(matches!(
        error.failure,
        StepFailure::State(StateError::NoSuchTemperature { .. } | StateError::HeatCapacity { .. })
    ));
    assert!(laws.entropy_ulps >= ENTROPY_TOLERANCE);
}
