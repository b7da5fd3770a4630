//! Steps end at the times at which loads jump.

use std::ops::ControlFlow;

use eem::prelude::*;

/// The tolerance of controlled steps.
const TOLERANCE: f64 = 1e-4;

/// A mass that moves freely and is pushed by 10 N from 0.7 s to 1.9 s; the function jumps, to the right of both times.
fn pushed(scheme: Scheme, step: f64, is_controlled: bool) -> (Simulation<1>, Node) {
    let mut scene = Scene::<1>::new();
    let mass = scene.mass(2.0, [1.0], [1.0]);
    scene.force(mass, |t: f64| {
        [if (0.7..1.9).contains(&t) { 10.0 } else { 0.0 }]
    });
    scene.stop_at([1.9, 0.7]);
    scene.stop_at([-3.0, 0.7, 50.0]);
    let mut run = Simulation::new(scene, scheme, step).unwrap();
    if is_controlled {
        run.control_steps(Tolerance::new(TOLERANCE)).unwrap();
    }
    (run, mass)
}

#[test]
fn steps_end_at_stop_times_to_the_last_bit() {
    for scheme in Scheme::ALL.into_iter().chain([Scheme::Auto]) {
        for is_controlled in [false, true] {
            if is_controlled && !scheme.may_change_steps() {
                continue;
            }
            let (mut run, mass) = pushed(scheme, 0.3, is_controlled);
            let mut times = Vec::new();
            let keep = |_: &Simulation<1>, report: &StepReport| {
                times.push((report.time, report.step));
                ControlFlow::Continue(())
            };
            run.run_until_with(3.0, keep).unwrap();
            for stop in [0.7_f64, 1.9, 3.0] {
                let hits = times
                    .iter()
                    .filter(|(time, _)| time.to_bits() == stop.to_bits());
                assert_eq!(hits.count(), 1, "{scheme} {stop}: {times:?}");
            }
            if !is_controlled && scheme != Scheme::Auto {
                // 0.3, 0.3, 0.1; 0.3 four times; 0.3 three times, 0.2.
                assert_eq!(
                    (times.len(), run.step_size()),
                    (11, 0.3),
                    "{scheme}: {times:?}"
                );
            }
            // No step sees the other side of a jump, so that the impulse is exact: 2 kg m/s and 12 N s, in at most 100 steps.
            let p = run.momentum(mass).unwrap()[0];
            assert!(
                (p - 14.0).abs() <= 100.0 * f64::EPSILON * 14.0,
                "{scheme}: {p}"
            );
            assert!(times.len() <= 100, "{scheme}: {}", times.len());
        }
    }
}

#[test]
fn a_run_that_is_resumed_between_stop_times_has_the_same_bits() {
    for (scheme, is_controlled) in [
        (Scheme::EemTemperature, false),
        (Scheme::EemExplicit, false),
        (Scheme::EemExplicit, true),
        (Scheme::Auto, true),
    ] {
        let (mut whole, _) = pushed(scheme, 0.3, is_controlled);
        let mut saved = Vec::new();
        let keep = |run: &Simulation<1>, _: &StepReport| {
            saved.push(run.checkpoint());
            ControlFlow::Continue(())
        };
        whole.run_until_with(3.0, keep).unwrap();
        let end = whole.checkpoint();
        for checkpoint in &saved {
            let (mut resumed, _) = pushed(scheme, 0.3, is_controlled);
            resumed.restore(checkpoint).unwrap();
            resumed.run_until(3.0).unwrap();
            assert_eq!(resumed.checkpoint(), end, "{scheme}");
        }
    }
}
