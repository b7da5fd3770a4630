//! Lengths far from a metre work; where their squares leave the range of the scalar, a message says
//! the true length.

use eem::StateError;
use eem::prelude::*;

use super::Elastic;
use crate::support::only_error;

/// The positions of a pendulum of this length, in units of it, after some steps.
fn trajectory(scheme: Scheme, length: f64) -> Vec<[f64; 2]> {
    let mut scene = Scene::<2>::new();
    let pivot = scene.anchor([0.0, 0.0]);
    let bob = scene.mass(
        1.0,
        [0.8 * length, 0.7 * length],
        [-0.3 * length, 0.4 * length],
    );
    let spring = Elastic {
        stiffness: 3.0,
        length,
    };
    scene.spring(spring, [pivot, bob]);
    let mut run = Simulation::new(scene, scheme, 0.1).unwrap();
    let step = |_| {
        run.step()
            .unwrap_or_else(|error| panic!("{}: {error}", scheme.name()));
        let position = run.position(bob).unwrap();
        [position.x / length, position.y / length]
    };
    (0..50).map(step).collect()
}

#[test]
fn a_pendulum_moves_the_same_at_every_scale() {
    for scheme in Scheme::ALL {
        let expected = trajectory(scheme, 1.0);
        for length in [1e-100, 1e-30, 1e30, 1e100] {
            for (found, expected) in trajectory(scheme, length).iter().zip(&expected) {
                for (found, expected) in found.iter().zip(expected) {
                    // 50 steps of a few roundings each.
                    assert!(
                        (found - expected).abs() < 1e-12,
                        "{} at {length:e} m: {found} instead of {expected}",
                        scheme.name()
                    );
                }
            }
        }
    }
}

/// The error of a spring between two points of the plane.
fn refusal(first: [f64; 2], second: [f64; 2]) -> StateError {
    let mut scene = Scene::<2>::new();
    let ends = [scene.anchor(first), scene.anchor(second)];
    let spring = Elastic {
        stiffness: 1.0,
        length: 1.0,
    };
    scene.spring(spring, ends);
    match only_error(Simulation::new(scene, Scheme::EemEntropy, 0.1)) {
        SceneError::State(error) => error,
        error => panic!("{error}"),
    }
}

#[test]
fn a_stretch_whose_square_underflows_or_overflows_is_refused_with_its_true_length() {
    for (ends, length) in [
        ([[0.0, 0.0], [3e-170, 4e-170]], 5e-170),
        ([[0.0, 0.0], [0.0, -1e-154]], 1e-154),
        ([[0.0, 0.0], [-3e160, 4e160]], 5e160),
        ([[-1e307, 0.0], [1e307, 0.0]], 2e307),
        ([[1.0, 2.0], [1.0, 2.0]], 0.0),
    ] {
        let error = refusal(ends[0], ends[1]);
        let StateError::Stretch {
            value, least, most, ..
        } = error
        else {
            panic!("{error}");
        };
        assert!(
            (value - length).abs() <= 4.0 * f64::EPSILON * length,
            "{value:e}"
        );
        assert!(!(least..=most).contains(&value));
    }
    assert_eq!(
        refusal([0.0, 0.0], [0.0, 1e-170]).to_string(),
        "the stretch of element 0 (Elastic) is 1e-170 m, it must lie between 1.5e-154 m and 1.3e154 m, so \
         that its square neither underflows nor overflows"
    );
}
