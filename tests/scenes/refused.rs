//! A scene that is refused comes back with everything that is wrong with it.

use eem::prelude::*;
use eem::{RefusedScene, StateError};

use crate::support::ThermoViscoElastic;

const MODEL: ThermoViscoElastic = ThermoViscoElastic::PENDULUM;

fn refused(scene: Scene<2>, scheme: Scheme, step: f64) -> RefusedScene<2> {
    Simulation::new(scene, scheme, step).unwrap_err()
}

#[test]
fn all_errors_of_a_scene_are_named_at_once() {
    let mut scene = Scene::<2>::new();
    let anchor = scene.anchor([0.0, f64::NAN]);
    let mass = scene.mass(-1.0, [f64::INFINITY, 0.0], [f64::NAN, f64::NAN]);
    let wrong = ThermoViscoElastic {
        capacity: f64::NAN,
        ..MODEL
    };
    let spring = scene.spring(wrong, [anchor, mass]);
    scene.set_viscous_stretch(spring, 3, f64::NAN);
    let air = scene.reservoir(0.0);
    scene.conduct(spring, air, -1.0);
    scene.conduct(spring, spring, 1.0);
    scene.set_gravity([f64::NAN, 0.0]);
    scene.set_momentum(anchor, [0.0; 2]);
    scene.move_anchor(anchor, |_| [0.0; 2]);
    scene.move_anchor(anchor, |_| [0.0; 2]);
    scene.dead_load(mass, [0.0, f64::NAN]);
    let own = scene.spring(MODEL, [mass, mass]);
    scene.set_temperature(own, 300.0);
    // Only one part of each is named.
    let cold = scene.spring(Cold { k: 1.0 }, [anchor, mass]);
    scene.set_temperature(cold, 300.0);
    scene.conduct(cold, air, 1.0);
    let refused = refused(scene, Scheme::EemEntropy, -0.1);
    let text = refused.to_string();
    println!("{text}");
    for part in [
        "18 things are wrong with the scene:",
        "node 0 cannot be given a momentum",
        "coordinate 1 of the position of node 0 is NaN m",
        "coordinate 0 of the position of node 1 is inf m",
        "component 0 of the velocity of node 1 is NaN m/s",
        "component 1 of the velocity of node 1 is NaN m/s",
        "the mass of node 1 is -1 kg",
        "the temperature of reservoir 0 is 0 K",
        "parameter `capacity` of element 0 (ThermoViscoElastic) is NaN",
        "element 0 (ThermoViscoElastic) has 1 dashpot, there is no dashpot 3",
        "element 0 (ThermoViscoElastic) was never given a temperature",
        "component 0 of gravity is NaN m/s²",
        "the motion of node 0 is prescribed twice",
        "the conductance between element 0 (ThermoViscoElastic) and reservoir 0 is -1 W/K",
        "element 0 (ThermoViscoElastic) conducts heat to itself",
        "component 1 of the constant force on node 1 is NaN N",
        "element 1 (ThermoViscoElastic) connects node 1 with itself",
        "element 2 (Cold) has no temperature",
        "the time step is -0.1 s",
    ] {
        assert!(text.contains(part), "{part}");
    }
    assert_eq!(text.lines().count(), refused.errors().len() + 1);
}

/// A spring without temperature.
#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| 0.5 * k * lambda.powi(2))]
struct Cold {
    k: f64,
}

#[test]
fn a_refused_scene_can_be_mended() {
    let build = |temperature: Option<f64>, eta0: f64| {
        let mut scene = Scene::<2>::new();
        let pivot = scene.anchor([0.0, 0.0]);
        let bob = scene.mass(1.0, [3.0, 0.0], [0.0, 1.0]);
        let spring = scene.spring(ThermoViscoElastic { eta0, ..MODEL }, [pivot, bob]);
        if let Some(temperature) = temperature {
            scene.set_temperature(spring, temperature);
        }
        (scene, spring)
    };
    let bits = |scene| {
        let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.1).unwrap();
        run.run_until(1.0).unwrap();
        format!("{:?}", run.checkpoint())
    };
    let expected = bits(build(Some(380.0), MODEL.eta0).0);

    let (scene, spring) = build(None, MODEL.eta0);
    let mut scene = refused(scene, Scheme::EemEntropy, 0.1).into_scene();
    scene.set_temperature(spring, 380.0);
    assert_eq!(bits(scene), expected);

    // Refused for its initial state, when its elements are ready for the scheme.
    for scheme in [Scheme::EemEntropy, Scheme::EemEntropy4, Scheme::EemExplicit] {
        let (scene, spring) = build(Some(1e-3), MODEL.eta0);
        let refused = refused(scene, scheme, 0.1);
        let [SceneError::State(StateError::Viscosity { element, .. })] = refused.errors() else {
            panic!("{refused}")
        };
        assert_eq!(*element, spring);
        let mut scene = refused.into_scene();
        scene.set_temperature(spring, 380.0);
        assert_eq!(bits(scene), expected);
    }
}

#[test]
fn every_element_that_cannot_be_in_its_initial_state_is_named() {
    let mut scene = Scene::<2>::new();
    let pivot = scene.anchor([0.0, 0.0]);
    let mut springs = Vec::new();
    for number in 0..30 {
        let bob = scene.mass(1.0, [3.0 + f64::from(number), 0.0], [0.0, 1.0]);
        let spring = scene.spring(MODEL, [pivot, bob]);
        // At 1 mK the viscosity of the model is infinite.
        scene.set_temperature(spring, if number % 2 == 0 { 1e-3 } else { 300.0 });
        springs.push(spring);
    }
    let refused = refused(scene, Scheme::EemEntropy, 0.1);
    let named = refused.errors().iter().map(|error| match error {
        SceneError::State(StateError::Viscosity { element, .. }) => *element,
        error => panic!("{error}"),
    });
    let expected: Vec<_> = springs.into_iter().step_by(2).collect();
    assert_eq!(named.collect::<Vec<_>>(), expected);
    let first = refused.errors()[0].clone();
    assert_eq!(SceneError::from(refused), first);
}
