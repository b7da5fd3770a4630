//! Wrong input is an error that names the thing, the value and the time; nothing panics.

use eem::prelude::*;
use eem::{StateError, StepFailure};

use crate::support::{ThermoViscoElastic, hencky, only_error, single_pendulum};

const NAN: f64 = f64::NAN;

/// A pendulum that one closure spoils.
struct Draft {
    mass: f64,
    position: [f64; 2],
    velocity: [f64; 2],
    model: ThermoViscoElastic,
    temperature: Option<f64>,
    viscous_stretch: f64,
    reservoir: f64,
    conductance: f64,
    step: f64,
}

/// The error of a spoiled pendulum, and its text.
fn error(spoil: impl FnOnce(&mut Draft)) -> (SceneError, String) {
    let mut draft = Draft {
        mass: 1.0,
        position: [3.0, 0.0],
        velocity: [0.0, 1.0],
        model: ThermoViscoElastic::PENDULUM,
        temperature: Some(380.0),
        viscous_stretch: 0.0,
        reservoir: 300.0,
        conductance: 10.0,
        step: 0.2,
    };
    spoil(&mut draft);
    let mut scene = Scene::<2>::new();
    let pivot = scene.anchor([0.0, 0.0]);
    let bob = scene.mass(draft.mass, draft.position, draft.velocity);
    let spring = scene.spring(draft.model, [pivot, bob]);
    if let Some(temperature) = draft.temperature {
        scene.set_temperature(spring, temperature);
    }
    scene.set_viscous_stretch(spring, 0, draft.viscous_stretch);
    let air = scene.reservoir(draft.reservoir);
    scene.conduct(spring, air, draft.conductance);
    let error = only_error(Simulation::new(scene, Scheme::EemEntropy, draft.step));
    let text = error.to_string();
    (error, text)
}

macro_rules! assert_error {
    ($spoil:expr, $pattern:pat, $text:literal) => {
        let (error, text) = error($spoil);
        assert!(matches!(error, $pattern), "{error:?}");
        assert_eq!(text, $text);
    };
}

#[test]
fn masses_and_positions() {
    assert_error!(
        |draft| draft.mass = 0.0,
        SceneError::Mass { .. },
        "the mass of node 1 is 0 kg, it must be positive and finite, or the node one of a solid"
    );
    assert_error!(
        |draft| draft.mass = -2.0,
        SceneError::Mass { .. },
        "the mass of node 1 is -2 kg, it must be positive and finite"
    );
    assert_error!(
        |draft| draft.position[1] = NAN,
        SceneError::Position { axis: 1, .. },
        "coordinate 1 of the position of node 1 is NaN m, it must be finite"
    );
    assert_error!(
        |draft| draft.velocity[0] = f64::INFINITY,
        SceneError::Velocity { axis: 0, .. },
        "component 0 of the velocity of node 1 is inf m/s, it must be finite"
    );
    assert_error!(
        |draft| draft.position = [0.0, 0.0],
        SceneError::State(StateError::Stretch { .. }),
        "at the start: the stretch of element 0 (ThermoViscoElastic) is 0 m, it must lie between 1.5e-154 m and 1.3e154 m, so that its square neither underflows nor overflows"
    );
}

#[test]
fn temperatures_and_heat() {
    assert_error!(
        |draft| draft.temperature = None,
        SceneError::MissingTemperature { .. },
        "element 0 (ThermoViscoElastic) was never given a temperature, call `set_temperature`"
    );
    assert_error!(
        |draft| draft.temperature = Some(0.0),
        SceneError::State(StateError::Temperature { .. }),
        "at the start: the temperature of element 0 (ThermoViscoElastic) is 0 K, it must be positive and finite"
    );
    assert_error!(
        |draft| draft.temperature = Some(-3.0),
        SceneError::State(StateError::Temperature { .. }),
        "at the start: the temperature of element 0 (ThermoViscoElastic) is -3 K, it must be positive and finite"
    );
    assert_error!(
        |draft| draft.reservoir = NAN,
        SceneError::ReservoirTemperature { .. },
        "the temperature of reservoir 0 is NaN K, it must be positive and finite"
    );
    assert_error!(
        |draft| draft.conductance = -1.0,
        SceneError::Conductance { .. },
        "the conductance between element 0 (ThermoViscoElastic) and reservoir 0 is -1 W/K, it must be finite and not negative"
    );
}

#[test]
fn parameters_and_steps() {
    assert_error!(
        |draft| draft.model.mu1 = NAN,
        SceneError::Parameter {
            parameter: "mu1",
            ..
        },
        "parameter `mu1` of element 0 (ThermoViscoElastic) is NaN, it must be finite"
    );
    assert_error!(
        |draft| draft.viscous_stretch = NAN,
        SceneError::State(StateError::ViscousStretch { .. }),
        "at the start: the viscous stretch of dashpot 0 of element 0 (ThermoViscoElastic) is NaN m, it must be finite"
    );
    assert_error!(
        |draft| draft.step = 0.0,
        SceneError::Step { .. },
        "the time step is 0 s, it must be finite and at least 1.5e-154 s"
    );
    assert_error!(
        |draft| draft.step = -0.1,
        SceneError::Step { .. },
        "the time step is -0.1 s, it must be finite and at least 1.5e-154 s"
    );
    assert_error!(
        |draft| (draft.model.eta0, draft.model.a) = (-100.0, 0.0),
        SceneError::State(StateError::Viscosity { dashpot: 0, .. }),
        "at the start: the viscosity of dashpot 0 of element 0 (ThermoViscoElastic) is -100 N s/m at 380 K, \
         it must be positive and finite"
    );
    assert_error!(
        |draft| draft.model.capacity = -1.0,
        SceneError::State(StateError::HeatCapacity { .. }),
        "at the start: the heat capacity of element 0 (ThermoViscoElastic) is -1.1 J/K at 380 K, \
         it must be positive and finite"
    );
}

#[test]
fn handles() {
    let mut other = Scene::<2>::new();
    let foreign = other.anchor([0.0, 0.0]);
    let mut scene = Scene::<2>::new();
    let bob = scene.mass(1.0, [1.0, 0.0], [0.0, 0.0]);
    let hencky = hencky(1.0, 1.0);
    scene.spring(hencky.clone(), [foreign, bob]);
    let error = only_error(Simulation::new(scene, Scheme::EemEntropy, 0.1));
    assert_eq!(error.to_string(), "node 0 belongs to another scene");

    let mut scene = Scene::<2>::new();
    let pivot = scene.anchor([0.0, 0.0]);
    let bob = scene.mass(1.0, [1.0, 0.0], [0.0, 0.0]);
    let spring = scene.spring(hencky, [pivot, bob]);
    scene.set_temperature(spring, 300.0);
    let error = only_error(Simulation::new(scene, Scheme::EemEntropy, 0.1));
    assert_eq!(error, SceneError::NotThermal { element: spring });

    let pendulum = single_pendulum(Scheme::EemEntropy, 0.1);
    assert!(pendulum.run.position(foreign).is_err());
    assert!(pendulum.run.viscous_stretch(pendulum.spring, 1).is_err());
}

#[test]
fn a_step_size_can_be_refused() {
    let mut run = single_pendulum(Scheme::EemEntropy, 0.1).run;
    for bad in [0.0, -1.0, NAN, f64::INFINITY] {
        assert!(matches!(
            run.set_step_size(bad),
            Err(SceneError::Step { .. })
        ));
    }
    approx::assert_relative_eq!(run.step_size(), 0.1);
}

/// The viscosity is positive at the start and vanishes as the element cools.
#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, gamma: Viscous, theta: Temperature| {
    0.5 * k * (lambda - gamma - 1.0).powi(2) + c * (theta - theta * ln(theta / 300.0))
})]
#[viscosity(gamma = theta - 310.0)]
struct Freezing {
    k: f64,
    c: f64,
}

#[test]
fn a_viscosity_that_vanishes_on_the_way_ends_the_run_with_its_name() {
    let mut scene = Scene::<2>::new();
    let pivot = scene.anchor([0.0, 0.0]);
    let bob = scene.mass(1.0, [1.0, 0.0], [0.0, 0.1]);
    let spring = scene.spring(Freezing { k: 1.0, c: 1.0 }, [pivot, bob]);
    scene.set_temperature(spring, 350.0);
    let air = scene.reservoir(300.0);
    scene.conduct(spring, air, 1.0);
    let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.1).unwrap();
    let error = loop {
        let temperature = run.temperature(spring).unwrap();
        if let Err(error) = run.step() {
            approx::assert_relative_eq!(temperature, run.temperature(spring).unwrap());
            break error;
        }
        assert!(run.time() < 100.0, "the element cools below 310 K");
    };
    println!("{error}");
    assert!(error.time > 0.0);
    let StepFailure::State(StateError::Viscosity { element, value, .. }) = error.failure else {
        panic!("{error}");
    };
    assert_eq!(element, spring);
    assert!(value <= 0.0);
    assert!(run.ledger().energy.is_finite());
}

#[test]
fn a_hopeless_step_fails_and_the_run_goes_on_with_a_smaller_one() {
    let mut pendulum = single_pendulum(Scheme::EemEntropy, 1e6);
    let before = pendulum.row();
    let error = pendulum.run.step().unwrap_err();
    println!("{error}");
    assert_eq!(before.map(f64::to_bits), pendulum.row().map(f64::to_bits));
    pendulum.run.set_step_size(0.01).unwrap();
    pendulum.run.step().unwrap();
    assert!(pendulum.row().iter().all(|value| value.is_finite()));
}

/// ψ is not a number below the offset.
#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| stiffness * (lambda - offset * ln(lambda / natural_length)))]
struct Broken {
    stiffness: f64,
    offset: f64,
    natural_length: f64,
}

#[test]
fn an_energy_that_is_not_a_number_is_refused() {
    let mut scene = Scene::<2>::new();
    let pivot = scene.anchor([0.0, 0.0]);
    let bob = scene.mass(1.0, [1.0, 0.0], [0.0, 0.0]);
    let model = Broken {
        stiffness: 1.0,
        offset: 1.0,
        natural_length: -1.0,
    };
    scene.spring(model, [pivot, bob]);
    let error = only_error(Simulation::new(scene, Scheme::EemEntropy, 0.1));
    let text = "at the start: the free energy of element 0 (Broken) is NaN, it must be finite";
    assert_eq!(error.to_string(), text);
}

#[test]
fn what_is_prescribed_twice_and_wild_settings_are_refused() {
    let mut scene = Scene::<1>::new();
    let road = scene.anchor([0.0]);
    scene.move_anchor(road, |t| [t]);
    scene.move_anchor(road, |t| [2.0 * t]);
    let error = only_error(Simulation::new(scene, Scheme::EemEntropy, 0.1));
    assert_eq!(
        error.to_string(),
        "the motion of node 0 is prescribed twice"
    );

    let mut run = single_pendulum(Scheme::EemEntropy, 0.1).run;
    let good = run.newton_settings();
    for bad in [
        NewtonSettings {
            max_iterations: 0,
            ..good
        },
        NewtonSettings {
            tolerance: NAN,
            ..good
        },
        NewtonSettings {
            tolerance: 0.0,
            ..good
        },
        NewtonSettings {
            tolerance: f64::INFINITY,
            ..good
        },
    ] {
        let refused = run.set_newton_settings(bad);
        assert!(matches!(refused, Err(SceneError::NewtonSettings { .. })));
    }
    assert_eq!(run.newton_settings(), good);
    let endless = NewtonSettings {
        max_iterations: usize::MAX,
        ..good
    };
    run.set_newton_settings(endless).unwrap();
    run.step().unwrap();
}
