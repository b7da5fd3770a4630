//! Motions and thermostats begin where the scene does.

use eem::prelude::*;

use super::WARM;

/// A spring whose support moves and whose temperature is prescribed.
fn build(
    motion: impl Fn(f64) -> [f64; 2] + Send + Sync + 'static,
    temperature: impl Fn(f64) -> f64 + Send + Sync + 'static,
) -> Result<Simulation<2>, SceneError> {
    let mut scene = Scene::<2>::new();
    let support = scene.anchor([0.7, 0.0]);
    let bob = scene.mass(1.0, [0.7, -1.0], [0.0, 0.0]);
    let spring = scene.spring(WARM, [support, bob]);
    scene.set_temperature(spring, 310.0);
    scene.move_anchor(support, motion);
    scene.prescribe_temperature(spring, temperature);
    Ok(Simulation::new(scene, Scheme::EemEntropy, 0.1)?)
}

#[test]
fn an_anchor_that_jumps_at_the_start_is_refused_with_both_places() {
    let error = build(|_| [1.0, 0.0], |_| 310.0).unwrap_err();
    let SceneError::AnchorJump { axis: 0, .. } = error else {
        panic!("{error}");
    };
    assert_eq!(
        error.to_string(),
        "coordinate 0 of the motion of node 0 is 1 m at the start, but the anchor was created at 0.7 m: \
         create it where its motion begins"
    );
    for bad in [f64::NAN, f64::INFINITY, 1e-12] {
        let error = build(move |_| [0.7, bad], |_| 310.0).unwrap_err();
        assert!(
            matches!(error, SceneError::AnchorJump { axis: 1, .. }),
            "{error}"
        );
    }
}

#[test]
fn a_thermostat_that_jumps_at_the_start_is_refused_with_both_temperatures() {
    let error = build(|_| [0.7, 0.0], |t| 330.0 + t).unwrap_err();
    assert_eq!(
        error.to_string(),
        "the temperature prescribed on element 0 (Warm) is 330 K at the start, but its initial temperature is \
         310 K: set the temperature with which the thermostat begins"
    );
    for bad in [f64::NAN, f64::INFINITY, -310.0, 0.0, 310.0 + 1e-9] {
        let error = build(|_| [0.7, 0.0], move |_| bad).unwrap_err();
        assert!(
            matches!(error, SceneError::TemperatureJump { .. }),
            "{error}"
        );
    }
}

#[test]
fn roundings_of_a_function_are_no_jump() {
    // 0.1 · 7 is not 0.7, nor is 310.1 − 0.1 exactly 310; sin π is not zero.
    let motion = |t: f64| [0.1 * 7.0 + t, (core::f64::consts::PI + t).sin()];
    build(motion, |t| 310.1 - 0.1 + t).unwrap();

    let mut scene = Scene::<1>::new();
    let support = scene.anchor([0.7]);
    let bob = scene.mass(1.0, [1.7], [0.0]);
    let spring = scene.spring(WARM, [support, bob]);
    scene.set_temperature(spring, 310.0);
    scene.move_anchor(support, |t| [0.1 * 7.0 + t]);
    scene.prescribe_temperature(spring, |t| 310.1 - 0.1 + t);
    let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.01).unwrap();
    run.step().unwrap();
}
