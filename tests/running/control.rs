//! Step control: errors follow tolerances, laws hold, and everything that runs with equal steps runs with these.

use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicI32, Ordering};

use eem::materials::MaxwellDamper;
use eem::prelude::*;
use eem::{EndState, RunEnd, SceneError, StateQuantity, StepFailure, Tolerance};

use crate::support::{largest_error, single_pendulum, single_pendulum_scene};

fn controlled(scheme: Scheme, tolerance: f64) -> Simulation<2> {
    let mut run = single_pendulum(scheme, 0.05).run;
    run.control_steps(Tolerance::new(tolerance)).unwrap();
    run
}

fn to(run: &mut Simulation<2>, end: f64) {
    let reached = run.run_until(end);
    assert_eq!(reached, Ok(()));
}

/// The pendulum after 2 s by Gauss collocation in steps of 1 ms.
fn exact() -> EndState {
    let mut run = single_pendulum(Scheme::Gauss4, 1e-3).run;
    to(&mut run, 2.0);
    EndState::of(&run)
}

#[test]
fn errors_are_proportional_to_tolerances() {
    let exact = exact();
    for (scheme, tolerances) in [
        (Scheme::EemEntropy, [1e-3, 1e-5]),
        (Scheme::EemTemperature, [1e-3, 1e-5]),
        (Scheme::Gauss4, [1e-5, 1e-8]),
        (Scheme::EemEntropy4, [1e-5, 1e-8]),
    ] {
        let errors = tolerances.map(|tolerance| {
            let mut run = controlled(scheme, tolerance);
            to(&mut run, 2.0);
            let error = largest_error(&EndState::of(&run), &exact);
            assert!(error < tolerance, "{scheme}: {error:e} at {tolerance:e}");
            error
        });
        let decades = (tolerances[0] / tolerances[1]).log10();
        let slope = (errors[0] / errors[1]).log10() / decades;
        assert!((slope - 1.0).abs() < 0.2, "{scheme}: slope {slope}");
    }
}

/// Of each step, with what many small ones from the same state say.
#[test]
fn estimates_are_the_errors_of_the_steps() {
    let cases = [
        (Scheme::EemEntropy, 2.0_f64, 1e-3),
        (Scheme::EemEntropy4, 4.0, 1e-5),
        (Scheme::EemEntropy6, 6.0, 1e-7),
        (Scheme::Gauss4, 4.0, 1e-6),
    ];
    for (scheme, order, tolerance) in cases {
        let mut run = controlled(scheme, tolerance);
        let mut before = run.checkpoint();
        let mut largest_momentum = 0.0_f64;
        let mut ratios = Vec::new();
        run.run_until_with(1.0, |run, report| {
            let mut fine = single_pendulum(scheme, 1.0).run;
            fine.restore(&before).unwrap();
            fine.fix_steps();
            fine.set_step_size(report.step / 32.0).unwrap();
            to(&mut fine, report.time);
            largest_momentum = largest_momentum.max(fine.largest_momentum());
            let fine = EndState::of(&fine).with_largest_momentum(largest_momentum);
            let error = largest_error(&EndState::of(run), &fine);
            ratios.push(report.error * tolerance.powf(1.0 + 1.0 / order) / error);
            before = run.checkpoint();
            ControlFlow::Continue(())
        })
        .unwrap();
        ratios.sort_by(f64::total_cmp);
        let median = ratios[ratios.len() / 2];
        assert!((median - 1.0).abs() < 0.1, "{scheme}: {median}");
    }
}

/// Its estimate is that of a formula of lower order, so that errors stay far below tolerances.
#[test]
fn the_explicit_scheme_is_as_accurate_as_it_is_asked_to_be() {
    let exact = exact();
    for tolerance in [1e-2, 1e-3, 1e-4, 1e-6, 1e-8] {
        let mut run = controlled(Scheme::EemExplicit, tolerance);
        to(&mut run, 2.0);
        let error = largest_error(&EndState::of(&run), &exact);
        // The reference is known to 1e-12.
        assert!(error < tolerance.max(1e-11), "{error:e} at {tolerance:e}");
        assert!(run.step_statistics().unwrap().accepted < 150);
    }
}

/// γ of a dashpot between two anchors, which relaxes as `ℓ (1 − exp(−t μ/η))`: nothing else moves, and the scale of its error
/// is that of the anchors.
#[test]
fn a_dashpot_between_anchors_counts_in_the_explicit_estimate() {
    let (stretch, rate, end): (f64, f64, f64) = (0.5, 2.0, 1.0);
    let exact = stretch * (1.0 - (-rate * end).exp());
    let accepted = [1e-3, 1e-6, 1e-9].map(|tolerance| {
        let mut scene = Scene::<1>::new();
        let ends = [scene.anchor([0.0]), scene.anchor([1.0 + stretch])];
        let damper = scene.spring(
            MaxwellDamper {
                stiffness: 100.0,
                coupling: 0.5,
                capacity: 2.0,
                natural_length: 1.0,
                theta_ref: 300.0,
                a: 500.0,
                mu: 40.0,
                eta: 40.0 / rate,
            },
            ends,
        );
        scene.set_temperature(damper, 300.0);
        scene.hold_temperature(damper, 300.0);
        // Ten relaxation times, where the scheme is stable up to 6.39.
        let mut run = Simulation::new(scene, Scheme::EemExplicit, 10.0 / rate).unwrap();
        run.control_steps(Tolerance::new(tolerance)).unwrap();
        run.run_until(end).unwrap();
        let error = (run.viscous_stretch(damper, 0).unwrap() - exact).abs();
        assert!(
            error <= tolerance * (1.0 + stretch),
            "{error:e} at {tolerance:e}"
        );
        run.step_statistics().unwrap().accepted
    });
    println!("{accepted:?}");
    assert!(accepted[0] < accepted[1] && accepted[1] < accepted[2]);
}

#[test]
fn laws_hold_whatever_the_steps() {
    for (scheme, tolerance) in [
        (Scheme::EemEntropy, 1e-2),
        (Scheme::EemTemperature, 1e-2),
        (Scheme::EemEntropy4, 1e-4),
        (Scheme::EemEntropy6, 1e-5),
        (Scheme::EemExplicit, 1e-3),
    ] {
        let mut run = controlled(scheme, tolerance);
        let first = run.ledger();
        let mut entropy = first.entropy;
        run.run_until_with(10.0, |run, _| {
            let ledger = run.ledger();
            assert!((ledger.balance - first.balance).abs() <= 4e-15 * first.energy);
            assert!(ledger.entropy >= entropy, "{scheme}");
            entropy = ledger.entropy;
            ControlFlow::Continue(())
        })
        .unwrap();
        let steps = run.step_statistics().unwrap();
        assert!(steps.accepted > 30, "{scheme}: {steps:?}");
        assert_eq!(run.time().to_bits(), 10.0_f64.to_bits());
    }
}

#[test]
fn a_resumed_run_has_the_bits_of_one_that_was_never_interrupted() {
    for scheme in [
        Scheme::EemTemperature,
        Scheme::EemEntropy4,
        Scheme::EemExplicit,
    ] {
        let mut run = controlled(scheme, 1e-3);
        for _ in 0..10 {
            run.step().unwrap();
        }
        let saved = run.checkpoint();
        let text = serde_json::to_string(&saved).unwrap();
        let mut resumed = single_pendulum(scheme, 1.0).run;
        resumed
            .restore(&serde_json::from_str(&text).unwrap())
            .unwrap();
        for run in [&mut run, &mut resumed] {
            to(run, 3.0);
        }
        assert_eq!(run.checkpoint(), resumed.checkpoint(), "{scheme}");
        assert_eq!(run.step_statistics(), resumed.step_statistics());
    }
}

/// Output at other times shortens steps, and leaves the size of those that follow.
#[test]
fn requested_times_are_hit_and_cost_one_step_each() {
    let mut plain = controlled(Scheme::EemTemperature, 1e-4);
    to(&mut plain, 1.0);
    let steps = plain.step_statistics().unwrap().accepted;
    let mut watched = controlled(Scheme::EemTemperature, 1e-4);
    let times = [0.1, 0.25, 0.3, 1.0];
    let mut seen = Vec::new();
    let end = watched.run_at(times, |run| {
        seen.push(run.time());
        ControlFlow::Continue(())
    });
    assert_eq!((end, seen), (Ok(RunEnd::Reached), times.to_vec()));
    let more = watched.step_statistics().unwrap().accepted - steps;
    assert!(more <= 3, "{more}");
}

#[test]
fn events_are_found_within_controlled_steps() {
    for scheme in [Scheme::EemEntropy, Scheme::EemExplicit] {
        let mut pendulum = single_pendulum(scheme, 0.05);
        pendulum.run.control_steps(Tolerance::new(1e-4)).unwrap();
        let bob = pendulum.bob;
        let first = pendulum.run.ledger();
        let height = |run: &Simulation<2>| run.position(bob).unwrap()[1] - 1.0;
        let passes = Event::crossing(|run| Ok(height(run))).within(1e-12);
        let end = pendulum.run.run_until_event(10.0, &mut [passes]);
        assert_eq!(end, Ok(RunEnd::Event(0)));
        assert!((0.0..1e-11).contains(&height(&pendulum.run)), "{scheme}");
        let last = pendulum.run.ledger();
        assert!((last.balance - first.balance).abs() <= 4e-15 * first.energy);
        to(&mut pendulum.run, 10.0);
    }
}

#[test]
fn what_cannot_be_asked_is_refused() {
    let mut run = single_pendulum(Scheme::EemEntropy, 0.05).run;
    for relative in [0.0, -1e-3, f64::NAN, 1e-14, 1.0] {
        let error = run.control_steps(Tolerance::new(relative)).unwrap_err();
        assert!(matches!(error, SceneError::Tolerance { .. }), "{error}");
    }
    let message = run
        .control_steps(Tolerance::new(1e-14))
        .unwrap_err()
        .to_string();
    assert!(message.ends_with("at least 2e-10"), "{message}");
    assert!(run.tolerance().is_none());
    let mut variational = single_pendulum(Scheme::Variational4, 0.05).run;
    let error = variational.control_steps(Tolerance::new(1e-3)).unwrap_err();
    assert_eq!(
        error,
        SceneError::FixedSteps {
            scheme: "variational-4"
        }
    );
}

#[test]
fn steps_that_would_be_too_small_say_what_limits_them() {
    let mut run = controlled(Scheme::EemEntropy, 1e-8);
    run.limit_steps([1e-3, 1.0]).unwrap();
    let before = run.checkpoint();
    let error = run.step().unwrap_err();
    assert!(matches!(error.failure, StepFailure::TooSmall { .. }));
    let message = error.to_string();
    assert!(
        message.contains("steps of less than 0.001 s would be needed: the error"),
        "{message}"
    );
    assert_eq!(EndState::of(&run), {
        let mut again = single_pendulum(Scheme::EemEntropy, 1.0).run;
        again.restore(&before).unwrap();
        EndState::of(&again)
    });
}

/// Steps that fail are tried again, smaller: at 10 s Newton's method finds nothing.
#[test]
fn failed_steps_are_made_again() {
    let (scene, ..) = single_pendulum_scene();
    let mut run = Simulation::new(scene, Scheme::Midpoint, 10.0).unwrap();
    run.control_steps(Tolerance::new(1e-2)).unwrap();
    to(&mut run, 1.0);
    let steps = run.step_statistics().unwrap();
    assert!(
        steps.rejected_by_newton + steps.rejected_by_domain > 0,
        "{steps:?}"
    );
}

/// Where nothing moves steps grow, up to the limit that they have.
#[test]
fn steps_at_rest_grow_to_their_limit() {
    for scheme in [Scheme::EemEntropy, Scheme::EemExplicit] {
        let mut scene = Scene::<2>::new();
        scene.anchor([0.0, 0.0]);
        scene.mass(1.0, [1.0, 0.0], [0.0, 0.0]);
        let mut run = Simulation::new(scene, scheme, 0.1).unwrap();
        let refused = run.limit_steps([1e-9, 2.0]);
        assert!(matches!(
            refused,
            Err(SceneError::StepLimits {
                is_controlled: false,
                ..
            })
        ));
        run.control_steps(Tolerance::new(1e-6)).unwrap();
        run.limit_steps([1e-9, 2.0]).unwrap();
        for _ in 0..40 {
            run.step().unwrap();
        }
        let before = run.time();
        run.step().unwrap();
        assert!((run.time() - before - 2.0).abs() < 1e-12, "{scheme}");
        for limits in [[0.0, 1.0], [1.0, f64::NAN], [2.0, 1.0]] {
            let refused = run.limit_steps(limits);
            assert!(
                matches!(refused, Err(SceneError::StepLimits { .. })),
                "{limits:?}"
            );
        }
    }
}

#[test]
fn an_edited_memory_of_step_control_is_refused() {
    let mut run = controlled(Scheme::EemEntropy, 1e-3);
    run.step().unwrap();
    let saved = serde_json::to_value(run.checkpoint()).unwrap();
    for (pointer, value) in [
        ("/control/smallest", -1.0),
        ("/control/largest_momentum", -1.0),
        ("/control/controller/last/1", 0.0),
        ("/control/tolerance/relative", 0.0),
    ] {
        let mut edited = saved.clone();
        *edited.pointer_mut(pointer).unwrap() = serde_json::json!(value);
        let edited: Checkpoint = serde_json::from_value(edited).unwrap();
        assert!(run.restore(&edited).is_err(), "{pointer}");
    }
}

/// In the second half of a step, too.
#[test]
fn a_load_that_panics_leaves_state_and_control() {
    for scheme in [Scheme::EemEntropy, Scheme::EemExplicit] {
        for calm in 0..8 {
            let mut scene = Scene::<2>::new();
            let mass = scene.mass(1.0, [1.0, 0.0], [0.0, 0.0]);
            let calls = Arc::new(AtomicI32::new(-1000));
            let own = Arc::clone(&calls);
            scene.force(mass, move |_| {
                assert!(own.fetch_add(1, Ordering::Relaxed) != 0);
                [1.0, 0.0]
            });
            let mut run = Simulation::new(scene, scheme, 0.1).unwrap();
            run.control_steps(Tolerance::new(1e-4)).unwrap();
            run.step().unwrap();
            let before = EndState::of(&run);
            calls.store(-calm, Ordering::Relaxed);
            if catch_unwind(AssertUnwindSafe(|| run.step())).is_err() {
                assert_eq!(EndState::of(&run), before, "{scheme}, after {calm} calls");
            }
            assert!(run.tolerance().is_some());
        }
    }
}

/// A mass that nothing holds flies straight on, however small the step.
#[test]
fn a_lone_free_mass_is_no_reason_to_refuse_an_explicit_step() {
    for step in [1e-12, 1e-3, 1.0] {
        let mut scene = Scene::<2>::new();
        scene.mass(1.5, [5.8, 0.0], [-1.6, -3.1]);
        let mut run = Simulation::new(scene, Scheme::EemExplicit, step).unwrap();
        run.step().unwrap();
    }
}

#[test]
fn samples_between_steps_leave_the_steps_as_they_are() {
    let times: Vec<f64> = (1..=40).map(|k| 0.05 * f64::from(k)).collect();
    let mut exact = single_pendulum(Scheme::Gauss4, 1e-3).run;
    for scheme in [
        Scheme::EemEntropy,
        Scheme::EemTemperature,
        Scheme::EemEntropy4,
        Scheme::EemExplicit,
        Scheme::Variational,
        Scheme::Auto,
    ] {
        let build = || {
            let mut run = single_pendulum(scheme, 0.03).run;
            if scheme.may_change_steps() {
                run.control_steps(Tolerance::new(1e-4)).unwrap();
            }
            run
        };
        let (mut alone, mut sampled) = (build(), build());
        to(&mut alone, 2.0);
        let mut rows = Vec::new();
        let first = sampled.ledger();
        let end = sampled.sample_at(&times, |run| {
            let ledger = run.ledger();
            if scheme.is_exact() {
                assert!((ledger.balance / first.balance - 1.0).abs() < 1e-14);
            }
            rows.push((run.time(), EndState::of(run)));
            ControlFlow::Continue(())
        });
        assert_eq!(end, Ok(RunEnd::Reached));
        assert_eq!(sampled.checkpoint(), alone.checkpoint(), "{scheme}");
        let seen: Vec<f64> = rows.iter().map(|(time, _)| *time).collect();
        assert_eq!(seen, times);
        if scheme != Scheme::Variational {
            let mut reference = single_pendulum(Scheme::Gauss4, 1e-3).run;
            for (time, state) in rows.iter().take(12) {
                to(&mut reference, *time);
                let error = state.difference(&EndState::of(&reference), StateQuantity::Positions);
                assert!(error.unwrap() < 1e-3, "{scheme} at {time}: {error:?}");
            }
        }
    }
    // Not in order, or in the past.
    let error = exact
        .sample_at(&[0.2, 0.1], |_| ControlFlow::Continue(()))
        .unwrap_err();
    assert!(matches!(error.failure, StepFailure::End { .. }), "{error}");
    // Where the observer stops it.
    let mut run = controlled(Scheme::EemExplicit, 1e-4);
    let stop = |run: &Simulation<2>| {
        if run.time() > 0.1 {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    };
    assert_eq!(run.sample_at(&times, stop), Ok(RunEnd::Stopped));
    assert_eq!(run.time().to_bits(), times[2].to_bits());
    run.step().unwrap();
}

#[test]
fn a_failed_search_for_an_event_leaves_the_control_as_it_was() {
    let mut run = controlled(Scheme::EemEntropy, 1e-4);
    to(&mut run, 0.5);
    let before = (run.step_statistics(), run.step_size(), run.time());
    let function = |run: &Simulation<2>| Ok(if run.time() > 0.5 { f64::NAN } else { 1.0 });
    let error = run.run_until_event(2.0, &mut [Event::crossing(function)]);
    assert!(error.is_err());
    assert_eq!((run.step_statistics(), run.step_size(), run.time()), before);
}
