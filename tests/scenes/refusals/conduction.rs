//! Paths of heat between the same two are parallel: their conductances add.

use eem::prelude::*;

use super::WARM;

/// Temperatures, and the entropy of the room, after a run in which two springs exchange heat along
/// given paths: from the first to the second, from the second to the first, to the room.
fn temperatures(scheme: Scheme, [there, back, room]: [&[f64]; 3]) -> [f64; 3] {
    let mut scene = Scene::<2>::new();
    let pivot = scene.anchor([0.0, 0.0]);
    let bob = scene.mass(1.0, [1.0, 0.2], [0.0, 1.0]);
    let springs = [(); 2].map(|()| scene.spring(WARM, [pivot, bob]));
    let air = scene.reservoir(290.0);
    for (spring, theta) in springs.into_iter().zip([350.0, 300.0]) {
        scene.set_temperature(spring, theta);
    }
    for &conductance in there {
        scene.conduct(springs[0], springs[1], conductance);
    }
    for &conductance in back {
        scene.conduct(springs[1], springs[0], conductance);
    }
    for &conductance in room {
        scene.conduct(springs[0], air, conductance);
    }
    let mut run = Simulation::new(scene, scheme, 0.05).unwrap();
    for _ in 0..100 {
        run.step().unwrap();
    }
    let [first, second] = springs.map(|spring| run.temperature(spring).unwrap());
    [first, second, run.reservoir_entropy(air).unwrap()]
}

#[test]
fn parallel_paths_add_in_either_order_of_the_partners() {
    for scheme in Scheme::ALL {
        let one = temperatures(scheme, [&[1.5], &[], &[0.3]]);
        for other in [
            temperatures(scheme, [&[0.75, 0.75], &[], &[0.15, 0.15]]),
            temperatures(scheme, [&[0.75], &[0.75], &[0.1, 0.1, 0.1]]),
            temperatures(scheme, [&[], &[1.5], &[0.3]]),
        ] {
            for (one, other) in one.into_iter().zip(other) {
                // Newton's method stops with √ε; a hundred steps of its square and of roundings.
                let bound = 1e-11 * one.abs().max(1.0);
                assert!(
                    (one - other).abs() <= bound,
                    "{}: {one} and {other}",
                    scheme.name()
                );
            }
        }
        assert!(one[0] < 345.0 && one[1] > 301.0 && one[2] > 0.0);
    }
}
