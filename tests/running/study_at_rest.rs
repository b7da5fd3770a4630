//! Studies of scenes in which nothing moves, or which begin without energy, have errors of finite size.

use eem::materials::{MaxwellDamper, ThermoelasticSpring};
use eem::prelude::*;
use eem::{Advice, Setting, StateQuantity, Study};

use crate::support::hooke;

/// A damper between two anchors: nothing moves, and its dashpot relaxes within 0.5 s.
fn held_damper() -> Scene<1> {
    let mut scene = Scene::new();
    let ends = [scene.anchor([0.0]), scene.anchor([1.2])];
    let damper = MaxwellDamper {
        stiffness: 100.0,
        coupling: 0.5,
        capacity: 2.0,
        natural_length: 1.0,
        theta_ref: 300.0,
        a: 0.0,
        mu: 40.0,
        eta: 20.0,
    };
    let damper = scene.spring(damper, ends);
    scene.set_temperature(damper, 300.0);
    scene
}

// γ = 0.2 (1 − e^(−2t)), over the 1.2 m of the anchors. One step of the midpoint rule relaxes by (1 − h)/(1 + h).
#[test]
fn errors_of_dashpots_between_anchors_are_relative_to_their_lengths() {
    let settings = Setting::halved(Scheme::EemTemperature, 0.1, 2);
    let report = Study::new(held_damper, 1.0)
        .settings(settings)
        .run()
        .unwrap();
    for (row, step) in report.rows.iter().zip([0.1_f64, 0.05]) {
        let left = ((1.0 - step) / (1.0 + step)).powf(1.0 / step);
        let expected = 0.2 * ((-2.0_f64).exp() - left).abs() / 1.2;
        let error = row.error(StateQuantity::ViscousStretches).unwrap();
        assert!((error / expected - 1.0).abs() < 1e-3, "{error} {expected}");
    }
    let quantities = [StateQuantity::ViscousStretches];
    let advice = report.recommend_for(&quantities, 1e-3).unwrap().advice;
    assert!(matches!(advice, Advice::Take { .. }), "{report}");
}

/// A mass at rest on a spring without force, pushed by 5 t²: the scene has no energy at first.
fn pushed() -> Scene<1> {
    let mut scene = Scene::new();
    let [anchor, mass] = [scene.anchor([0.0]), scene.mass(1.0, [1.0], [0.0])];
    let spring = hooke(100.0, 1.0);
    scene.spring(spring, [anchor, mass]);
    scene.force(mass, |t| [5.0 * t * t]);
    scene
}

#[test]
fn the_energy_defect_of_a_run_from_rest_is_relative_to_what_it_gains() {
    let settings =
        [Scheme::EemEntropy, Scheme::Midpoint].map(|scheme| Setting::fixed(scheme, 0.01));
    let report = Study::new(pushed, 1.0).settings(settings).run().unwrap();
    let [exact, _] = &report.rows[..] else {
        panic!("{report}");
    };
    let defect = exact.energy_defect;
    assert!(defect > 0.0 && defect < 100.0 * f64::EPSILON, "{defect}");
    assert!(exact.step_bound < 1e-11, "{}", exact.step_bound);
}

/// A mass at rest between two equal springs in warm air.
fn nothing_moves() -> Scene<1> {
    let mut scene = Scene::new();
    let [left, right] = [-1.3, 1.3].map(|at| scene.anchor([at]));
    let mass = scene.mass(1.0, [0.0], [0.0]);
    let air = scene.reservoir(350.0);
    for anchor in [left, right] {
        let spring = ThermoelasticSpring {
            stiffness: 40.0,
            coupling: 0.1,
            capacity: 10.0,
            natural_length: 1.0,
            theta_ref: 300.0,
        };
        let spring = scene.spring(spring, [anchor, mass]);
        scene.set_temperature(spring, 310.0);
        scene.conduct(spring, air, 3.0);
    }
    scene
}

#[test]
fn positions_that_do_not_change_have_no_order() {
    let settings = Setting::halved(Scheme::EemEntropy, 0.1, 3);
    let report = Study::new(nothing_moves, 1.0)
        .settings(settings)
        .run()
        .unwrap();
    let order = |quantity| report.order(Scheme::EemEntropy, quantity);
    assert_eq!(order(StateQuantity::Positions), None);
    assert!((order(StateQuantity::Temperatures).unwrap() - 2.0).abs() < 0.1);
    assert!(!report.to_string().contains("NaN"), "{report}");
}
