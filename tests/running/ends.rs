//! Runs end where they should: at an end time, where an observer stops them, at events, at errors.

use eem::StepFailure;
use eem::prelude::*;

use crate::support::{Pendulum, single_pendulum};

const STEP: f64 = 0.05;

/// An observer that only watches.
fn watch<const D: usize>(_: &Simulation<D>, _: &StepReport<f64>) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

/// Everything that a step depends on, as text that tells all doubles apart.
fn bits<const D: usize>(run: &Simulation<D>) -> String {
    format!("{:?}", run.checkpoint())
}

// Runs to an end time.

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
    let observer = |_: &Simulation<2>, _: &StepReport<f64>| {
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
        let error = run.run_until_event(end, 0.1, |_| 1.0, watch).unwrap_err();
        assert!(matches!(error.failure, StepFailure::End { .. }), "{error}");
    }
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
        let height = |run: &Simulation<2>| run.position(bob).map_or(f64::NAN, |q| q.x);
        run.run_until_event(9.0, 1e-9, height, watch).unwrap();
    });
    assert_eq!(counted.count_total, 0, "{counted:?}");
}

#[test]
fn single_precision_reaches_its_end_too() {
    let mut scene = Scene::<2, f32>::default();
    scene.anchor([0.0, 0.0]);
    let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.1).unwrap();
    let mut steps = 0;
    let observer = |_: &Simulation<2, f32>, _: &StepReport<f32>| {
        steps += 1;
        ControlFlow::Continue(())
    };
    run.run_until_with(20.0, observer).unwrap();
    assert_eq!((run.time().to_bits(), steps), (20.0_f32.to_bits(), 200));
}

// Events.

/// The pendulum's bob below its pivot.
fn below(bob: Node) -> impl Fn(&Simulation<2>) -> f64 {
    move |run| run.position(bob).unwrap().x
}

#[test]
fn events_are_located_to_the_tolerance() {
    for scheme in Scheme::ALL {
        let mut exact = single_pendulum(scheme, STEP);
        let event = below(exact.bob);
        let end = exact.run.run_until_event(20.0, 0.0, &event, watch).unwrap();
        assert_eq!(end, RunEnd::Event);
        let time = exact.run.time();
        // Times are told apart by 4 ulp, and x moves with a speed of some metres per second.
        assert!(event(&exact.run).abs() < 1e-13, "{}", event(&exact.run));
        for tolerance in [1e-3, 1e-6, 1e-9, 1e-12] {
            let mut pendulum = single_pendulum(scheme, STEP);
            let calls = std::cell::Cell::new(0);
            let mut steps = 0;
            let event = below(pendulum.bob);
            let counted = |run: &Simulation<2>| {
                calls.set(calls.get() + 1);
                event(run)
            };
            let watch = |_: &Simulation<2>, _: &StepReport<f64>| {
                steps += 1;
                ControlFlow::Continue(())
            };
            let start = event(&pendulum.run);
            let run = &mut pendulum.run;
            let end = run.run_until_event(20.0, tolerance, counted, watch);
            assert_eq!(end.unwrap(), RunEnd::Event);
            let late = run.time() - time;
            assert!((-1e-14..=tolerance).contains(&late), "{scheme:?}: {late:e}");
            assert!(event(run) * start <= 0.0);
            approx::assert_relative_eq!(run.step_size(), STEP);
            // Once at the start, once per step, and then some trials.
            let trials = calls.get() - steps - 1;
            println!("{}: {tolerance:e} s by {trials} trials", scheme.name());
            assert!(trials <= 8, "{trials}");
        }
    }
}

#[test]
fn the_laws_hold_at_events_and_no_event_is_found_twice() {
    let mut pendulum = single_pendulum(Scheme::EemEntropy, STEP);
    let event = below(pendulum.bob);
    let mut laws = crate::support::Laws::new(&pendulum.run);
    let (mut times, mut signs) = (vec![0.0], vec![event(&pendulum.run).signum()]);
    let watch = |run: &Simulation<2>, _: &StepReport<f64>| {
        laws.watch(run);
        ControlFlow::Continue(())
    };
    let mut watch = watch;
    while pendulum
        .run
        .run_until_event(20.0, 1e-10, &event, &mut watch)
        .unwrap()
        == RunEnd::Event
    {
        times.push(pendulum.run.time());
        signs.push(event(&pendulum.run).signum());
    }
    println!("{times:?}, {laws:?}");
    assert!(times.len() > 5);
    // Between two passages the bob swings: many steps.
    assert!(times.windows(2).all(|pair| pair[1] - pair[0] > 4.0 * STEP));
    assert!(signs.windows(2).all(|pair| pair[0] * pair[1] < 0.0));
    assert_eq!(pendulum.run.time().to_bits(), 20.0_f64.to_bits());
    assert!(laws.energy <= 4e-15);
    assert!(laws.entropy_ulps >= -2.0);
}

#[test]
fn an_event_at_the_end_and_one_at_the_start() {
    // Zero exactly where the run ends.
    let mut run = single_pendulum(Scheme::EemEntropy, 0.3).run;
    let clock = |run: &Simulation<2>| run.time() - 1.0;
    let end = run.run_until_event(1.0, 1e-9, clock, watch).unwrap();
    assert_eq!(
        (end, run.time().to_bits()),
        (RunEnd::Event, 1.0_f64.to_bits())
    );
    // From there the function is zero and has no sign yet.
    let end = run.run_until_event(1.5, 1e-9, clock, watch).unwrap();
    assert_eq!(
        (end, run.time().to_bits()),
        (RunEnd::Reached, 1.5_f64.to_bits())
    );
    // A change of sign in the last step, so close to the end that the whole step is taken again.
    let mut run = single_pendulum(Scheme::EemEntropy, 0.3).run;
    let clock = |run: &Simulation<2>| run.time() - (1.0 - 1e-7);
    let end = run.run_until_event(1.0, 1e-3, clock, watch).unwrap();
    assert_eq!(
        (end, run.time().to_bits()),
        (RunEnd::Event, 1.0_f64.to_bits())
    );
}

#[test]
fn events_that_cannot_be_are_errors() {
    let mut run = single_pendulum(Scheme::EemEntropy, 0.1).run;
    let start = bits(&run);
    for (tolerance, printed) in [(f64::NAN, "NaN"), (-1e-9, "-1e-9")] {
        let error = run
            .run_until_event(1.0, tolerance, |_| 1.0, watch)
            .unwrap_err();
        let text = error.failure.to_string();
        let expected =
            format!("the tolerance of the event is {printed} s, it must not be negative");
        assert_eq!(text, expected);
    }
    let error = run
        .run_until_event(1.0, 0.1, |_| f64::NAN, watch)
        .unwrap_err();
    assert_eq!(error.failure, StepFailure::EventFunction);
    assert_eq!(start, bits(&run));

    // Not a number from 0.35 s on: the step that leads there is undone.
    let broken = |run: &Simulation<2>| if run.time() < 0.35 { 1.0 } else { f64::NAN };
    let error = run.run_until_event(1.0, 0.1, broken, watch).unwrap_err();
    assert_eq!(error.failure, StepFailure::EventFunction);
    approx::assert_relative_eq!(error.time, 0.3, max_relative = 1e-15);
    approx::assert_relative_eq!(run.time(), 0.3, max_relative = 1e-15);
    // The run goes on as if nothing had happened.
    run.run_until_with(0.8, watch).unwrap();
    let mut quiet = single_pendulum(Scheme::EemEntropy, 0.1).run;
    quiet.run_until_with(0.8, watch).unwrap();
    assert_eq!(bits(&quiet), bits(&run));
}
