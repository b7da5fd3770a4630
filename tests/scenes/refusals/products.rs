//! Products and sums of the numbers of a scene that overflow are refused before the first step.

use eem::prelude::*;

use super::WARM;
use crate::support::only_error;

/// The error of a pendulum that a closure spoils, given its mass and its spring.
fn refusal(spoil: impl FnOnce(&mut Scene<2>, Node, Element)) -> SceneError {
    let mut scene = Scene::<2>::new();
    let pivot = scene.anchor([0.0, 0.0]);
    let bob = scene.mass(2.0, [1.0, 0.0], [0.0, 0.0]);
    let spring = scene.spring(WARM, [pivot, bob]);
    scene.set_temperature(spring, 320.0);
    spoil(&mut scene, bob, spring);
    only_error(Simulation::new(scene, Scheme::EemEntropy, 0.1))
}

#[test]
fn a_momentum_whose_kinetic_energy_overflows() {
    let error = refusal(|scene, bob, _| scene.set_momentum(bob, [0.0, 1e308]));
    let text = "the kinetic energy p²/2m of node 1 is inf J, it must be finite: its momentum is 1e308 kg \
                m/s, its mass 2 kg";
    assert_eq!(error.to_string(), text);
}

#[test]
fn a_momentum_that_is_not_finite_is_called_a_momentum() {
    for bad in [f64::NAN, f64::INFINITY] {
        let error = refusal(|scene, bob, _| scene.set_momentum(bob, [0.0, bad]));
        assert!(
            matches!(error, SceneError::Momentum { axis: 1, .. }),
            "{error}"
        );
    }
    let error = refusal(|scene, _, _| {
        scene.mass(1e200, [5.0, 0.0], [0.0, 1e200]);
    });
    assert!(
        matches!(error, SceneError::Momentum { axis: 1, .. }),
        "{error}"
    );
}

#[test]
fn a_weight_that_overflows() {
    let error = refusal(|scene, _, _| {
        scene.set_gravity([0.0, -1e200]);
        scene.mass(1e200, [5.0, 0.0], [0.0, 0.0]);
    });
    let text = "component 1 of the weight m g of node 2 is -inf N, it must be finite";
    assert_eq!(error.to_string(), text);
    // The weight is finite, its potential energy is not.
    let error = refusal(|scene, _, _| {
        scene.set_gravity([0.0, -1e200]);
        scene.mass(1e10, [5.0, 1e150], [0.0, 0.0]);
    });
    let SceneError::Total { quantity, .. } = error else {
        panic!("{error}");
    };
    assert_eq!(quantity, "potential energy");
}

#[test]
fn heat_flows_that_overflow_alone_or_together() {
    let error = refusal(|scene, _, spring| {
        let room = scene.reservoir(1e200);
        scene.conduct(spring, room, 1e200);
    });
    let text = "the heat flow from reservoir 0 to element 0 (Warm) at the start is inf W, it must be finite, \
                and so must the sum of all flows to an element";
    assert_eq!(error.to_string(), text);
    let error = refusal(|scene, _, spring| {
        let room = scene.reservoir(1e-310);
        scene.conduct(spring, room, 1.0);
    });
    let text = "the flow of entropy from reservoir 0 to element 0 (Warm) at the start is -inf W/K, it must be \
                finite, and so must the sum of all flows to an element";
    assert_eq!(error.to_string(), text);
    let error = refusal(|scene, _, spring| {
        let room = scene.reservoir(300.0);
        for _ in 0..20 {
            scene.conduct(spring, room, 8e306);
        }
    });
    assert!(matches!(error, SceneError::HeatFlow { .. }), "{error}");
}

#[test]
fn sums_over_the_scene_that_overflow() {
    let error = refusal(|scene, _, _| {
        for place in [3.0, 5.0] {
            scene.mass(0.5, [place, 0.0], [2.6e154, 0.0]);
        }
    });
    let SceneError::Total { quantity, unit, .. } = error else {
        panic!("{error}");
    };
    assert_eq!((quantity, unit), ("kinetic energy", "J"));
}
