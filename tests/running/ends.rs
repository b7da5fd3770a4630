//! Runs end where they should: at an end time, where an observer stops them, at errors.

use eem::materials::ThermoelasticSpring;
use eem::prelude::*;
use eem::{NewtonIteration, StepFailure};

use crate::support::{Pendulum, bits, single_pendulum, watch};

#[test]
fn the_end_is_hit_to_the_last_bit_and_the_step_size_stays() {
    for end in [0.3, 1.0, std::f64::consts::PI, 7.78] {
        let mut run = single_pendulum(Scheme::EemEntropy, 0.07).run;
        let mut sizes = Vec::new();
        let reached = run.run_until_with(end, |run, report| {
            assert_eq!(run.time().to_bits(), report.time.to_bits());
            assert_eq!(run.step_size().to_bits(), 0.07_f64.to_bits());
            sizes.push(report.step);
            ControlFlow::Continue(())
        });
        assert_eq!(reached.unwrap(), RunEnd::Reached);
        assert_eq!(run.time().to_bits(), end.to_bits());
        let (last, others) = sizes.split_last().unwrap();
        assert!(0.0 < *last && *last < 0.07);
        assert!(
            others
                .iter()
                .all(|size| size.to_bits() == 0.07_f64.to_bits())
        );
        // No step is left to make.
        run.run_until_with(end, |_, _| unreachable!()).unwrap();
    }
}

// Neither 0.1 s nor most of the ends are doubles: what is left for the last step is off by a rounding.
#[test]
fn whole_numbers_of_steps_are_full_steps() {
    for (step, steps) in [(0.1, 3), (0.1, 200), (0.05, 77), (0.2, 31), (0.7, 43)] {
        let mut by_hand = single_pendulum(Scheme::EemTemperature, step);
        for _ in 0..steps {
            by_hand.run.step().unwrap();
        }
        let mut in_one_call = single_pendulum(Scheme::EemTemperature, step);
        let end = step * f64::from(steps);
        in_one_call.run.run_until_with(end, watch).unwrap();
        assert_eq!(in_one_call.run.time().to_bits(), end.to_bits());
        let [one, other] = [by_hand, in_one_call].map(|pendulum| pendulum.row().map(f64::to_bits));
        assert_eq!(one, other, "{steps} steps of {step} s");
    }
}

#[test]
fn an_observer_stops_a_run() {
    let mut run = single_pendulum(Scheme::EemEntropy, 0.1).run;
    let mut seen = 0;
    let observer = |_: &Simulation<2>, _: &StepReport| {
        seen += 1;
        match seen {
            5 => ControlFlow::Break(()),
            _ => ControlFlow::Continue(()),
        }
    };
    let end = run.run_until_with(f64::INFINITY, observer).unwrap();
    assert_eq!((end, seen), (RunEnd::Stopped, 5));
    approx::assert_relative_eq!(run.time(), 0.5);
}

#[test]
fn impossible_ends_are_errors() {
    let mut run = single_pendulum(Scheme::EemEntropy, 0.1).run;
    run.step().unwrap();
    let before = bits(&run);
    for end in [f64::NAN, 0.0, -1.0, f64::NEG_INFINITY] {
        let error = run.run_until_with(end, watch).unwrap_err();
        assert!(matches!(error.failure, StepFailure::End { .. }), "{error}");
        let text = error.to_string();
        assert!(text.starts_with("at t = 0.1 s: the end time is "), "{text}");
        let error = run.run_until_event(end, &mut []).unwrap_err();
        assert!(matches!(error.failure, StepFailure::End { .. }), "{error}");
    }
    // Nothing would end it.
    for error in [
        run.run_until(f64::INFINITY),
        run.run_until_event(f64::INFINITY, &mut []).map(drop),
        run.run_at([f64::INFINITY], |_| ControlFlow::Continue(()))
            .map(drop),
        run.sample_at(&[0.2, f64::INFINITY], |_| ControlFlow::Continue(()))
            .map(drop),
    ] {
        let failure = error.unwrap_err().failure;
        assert!(
            matches!(failure, StepFailure::End { end } if end == f64::INFINITY),
            "{failure}"
        );
    }
    // 1e16 steps.
    let failure = run.run_until(1e15).unwrap_err().failure;
    assert!(matches!(failure, StepFailure::End { .. }), "{failure}");
    assert_eq!(before, bits(&run));
}

#[test]
fn a_failed_step_ends_a_run_where_it_was() {
    let mut run = single_pendulum(Scheme::EemEntropy, 0.1).run;
    run.run_until_with(0.5, watch).unwrap();
    let settings = run.newton_settings();
    run.set_newton_settings(NewtonSettings {
        max_iterations: 1,
        ..settings
    })
    .unwrap();
    let before = bits(&run);
    let error = run.run_until_with(2.05, watch).unwrap_err();
    assert!(matches!(error.failure, StepFailure::NotConverged { .. }));
    assert_eq!(before, bits(&run));
}

#[test]
fn a_run_allocates_nothing() {
    let Pendulum { mut run, bob, .. } = single_pendulum(Scheme::EemEntropy, 0.01);
    run.step().unwrap();
    let counted = allocation_counter::measure(|| {
        run.run_until_with(1.003, watch).unwrap();
    });
    assert_eq!(counted.count_total, 0, "{counted:?}");
    let mut events = [Event::crossing(|run: &Simulation<2>| {
        Ok(run.position(bob)?[0])
    })];
    let counted = allocation_counter::measure(|| {
        let end = run.run_until_event(9.0, &mut events).unwrap();
        assert_eq!(end, RunEnd::Event(0));
    });
    assert_eq!(counted.count_total, 0, "{counted:?}");
}

#[test]
fn a_failed_step_says_which_shorter_one_can_be_made() {
    for (scheme, size) in [
        (Scheme::EemEntropy, 40.0),
        (Scheme::EemEntropy4, 40.0),
        (Scheme::EemExplicit, 3.0),
    ] {
        let mut run = single_pendulum(scheme, 0.01).run;
        run.run_until(0.1).unwrap();
        run.set_step_size(size).unwrap();
        let before = (bits(&run), run.worst_step().copied(), *run.corrections());
        let error = run.step().unwrap_err();
        assert_eq!(run.run_until(9.0 * size).unwrap_err(), error);
        assert_eq!(
            (bits(&run), run.worst_step().copied(), *run.corrections()),
            before
        );
        println!("{error}");
        let shorter = error.shorter.unwrap();
        let text = format!("(a step of {shorter} s would do)");
        assert!(error.to_string().ends_with(&text), "{error}");
        run.set_step_size(2.0 * shorter).unwrap();
        assert_eq!(run.step().unwrap_err().shorter, Some(shorter));
        run.set_step_size(shorter).unwrap();
        assert_eq!(run.step().unwrap().step.to_bits(), shorter.to_bits());
    }
    // A load that is right until 0.3 s.
    let mut scene = Scene::<2>::new();
    let mass = scene.mass(1.0, [0.0; 2], [0.0; 2]);
    scene.force(mass, |t| [if t > 0.3 { f64::NAN } else { 1.0 }, 0.0]);
    let mut run = Simulation::new(scene, Scheme::EemEntropy, 1.0).unwrap();
    assert_eq!(run.step().unwrap_err().shorter, Some(0.5));
    // Nothing to try where the step is not to blame.
    let mut scene = Scene::<2>::new();
    let mass = scene.mass(1.0, [0.0; 2], [0.0; 2]);
    scene.force(mass, |_| [f64::NAN, 0.0]);
    let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.1).unwrap();
    assert_eq!(run.step().unwrap_err().shorter, None);
}

/// Two masses on strongly coupled springs, at 10 m/s.
fn coupled(coupling: f64) -> Scene<2> {
    let mut scene = Scene::<2>::new();
    let hook = scene.anchor([0.0, 0.0]);
    let masses = [
        scene.mass(1.0, [1.3, 0.0], [2.0, 3.0]),
        scene.mass(1.0, [2.0, 1.0], [-2.0, 3.0]),
    ];
    let make = |natural_length| ThermoelasticSpring {
        stiffness: 500.0,
        coupling,
        capacity: 2.0,
        natural_length,
        theta_ref: 300.0,
    };
    let springs = [
        scene.spring(make(1.0), [hook, masses[0]]),
        scene.spring(make(1.2), masses),
    ];
    for (spring, theta) in springs.into_iter().zip([300.0, 320.0]) {
        scene.set_temperature(spring, theta);
    }
    scene.conduct(springs[0], springs[1], 5.0);
    scene
}

/// Iterations of the attempts are told apart by the bits of their residuals and updates.
#[test]
fn no_attempt_at_a_step_that_fails_is_made_twice() {
    let bits = |iteration: &NewtonIteration| {
        let NewtonIteration { residual, update } = iteration;
        [residual.to_bits(), update.to_bits()]
    };
    for scheme in [
        Scheme::EemTemperature,
        Scheme::EemEntropy,
        Scheme::EemEntropy4,
        Scheme::EemEntropy6,
    ] {
        let mut failures = 0;
        for (coupling, step) in [(20.0, 1.0), (60.0, 1.0), (60.0, 10.0)] {
            let mut run = Simulation::new(coupled(coupling), scheme, step).unwrap();
            let Err(error) = run.step() else {
                continue;
            };
            failures += 1;
            let all: Vec<_> = error.history.iter().map(bits).collect();
            println!("{scheme}, {coupling}, {step} s: {} iterations", all.len());
            for count in 2..=all.len() / 2 {
                let (first, rest) = all.split_at(count);
                assert_ne!(first, &rest[..count], "{scheme}: the second is the first");
                // An attempt may be given up after ten iterations, and be made to its end at last.
                let is_repeated = count < 10 && rest.ends_with(first);
                assert!(!is_repeated, "{scheme}: the last is the first");
            }
        }
        assert!(failures > 0, "{scheme}");
    }
}
