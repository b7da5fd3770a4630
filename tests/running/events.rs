//! Events are found where they are, in the order of their times, and in the sense that is asked for.

use eem::StepFailure;
use eem::prelude::*;

use crate::support::{bits, single_pendulum, watch};

const STEP: f64 = 0.05;

/// The event that a function which cannot fail changes its sign.
fn crossing<'f>(function: impl Fn(&Simulation<2>) -> f64 + 'f) -> Event<'f, 2> {
    Event::crossing(move |run| Ok(function(run)))
}

/// The pendulum's bob below its pivot.
fn below(bob: Node) -> impl Fn(&Simulation<2>) -> f64 {
    move |run| run.position(bob).unwrap().x
}

#[test]
fn events_are_located_to_the_tolerance() {
    for scheme in Scheme::ALL {
        let mut exact = single_pendulum(scheme, STEP);
        let event = below(exact.bob);
        let end = exact
            .run
            .run_until_event(20.0, &mut [crossing(&event)])
            .unwrap();
        assert_eq!(end, RunEnd::Event(0));
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
            let watch = |_: &Simulation<2>, _: &StepReport| {
                steps += 1;
                ControlFlow::Continue(())
            };
            let start = event(&pendulum.run);
            let run = &mut pendulum.run;
            let mut events = [crossing(counted).within(tolerance)];
            let end = run.run_until_event_with(20.0, &mut events, watch);
            assert_eq!(end.unwrap(), RunEnd::Event(0));
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
    let watch = |run: &Simulation<2>, _: &StepReport| {
        laws.watch(run);
        ControlFlow::Continue(())
    };
    let mut watch = watch;
    while pendulum
        .run
        .run_until_event_with(20.0, &mut [crossing(&event).within(1e-10)], &mut watch)
        .unwrap()
        == RunEnd::Event(0)
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
    let end = run
        .run_until_event(1.0, &mut [crossing(clock).within(1e-9)])
        .unwrap();
    assert_eq!(
        (end, run.time().to_bits()),
        (RunEnd::Event(0), 1.0_f64.to_bits())
    );
    // From there the function is zero and has no sign yet.
    let end = run
        .run_until_event(1.5, &mut [crossing(clock).within(1e-9)])
        .unwrap();
    assert_eq!(
        (end, run.time().to_bits()),
        (RunEnd::Reached, 1.5_f64.to_bits())
    );
    // A change of sign in the last step, so close to the end that the whole step is taken again.
    let mut run = single_pendulum(Scheme::EemEntropy, 0.3).run;
    let clock = |run: &Simulation<2>| run.time() - (1.0 - 1e-7);
    let end = run
        .run_until_event(1.0, &mut [crossing(clock).within(1e-3)])
        .unwrap();
    assert_eq!(
        (end, run.time().to_bits()),
        (RunEnd::Event(0), 1.0_f64.to_bits())
    );
}

#[test]
fn events_that_cannot_be_are_errors() {
    let mut run = single_pendulum(Scheme::EemEntropy, 0.1).run;
    let start = bits(&run);
    for (tolerance, printed) in [(f64::NAN, "NaN"), (-1e-9, "-1e-9")] {
        let error = run
            .run_until_event(1.0, &mut [crossing(|_| 1.0).within(tolerance)])
            .unwrap_err();
        let text = error.failure.to_string();
        let expected = format!("the tolerance of event 0 is {printed} s, it must not be negative");
        assert_eq!(text, expected);
    }
    let error = run
        .run_until_event(1.0, &mut [crossing(|_| f64::NAN)])
        .unwrap_err();
    assert_eq!(error.failure, StepFailure::EventFunction { event: 0 });
    assert_eq!(start, bits(&run));

    // Not a number from 0.35 s on: the step that leads there is undone.
    let broken = |run: &Simulation<2>| if run.time() < 0.35 { 1.0 } else { f64::NAN };
    let error = run
        .run_until_event(1.0, &mut [crossing(broken)])
        .unwrap_err();
    assert_eq!(error.failure, StepFailure::EventFunction { event: 0 });
    approx::assert_relative_eq!(error.time, 0.3, max_relative = 1e-15);
    approx::assert_relative_eq!(run.time(), 0.3, max_relative = 1e-15);
    // The run goes on as if nothing had happened.
    run.run_until_with(0.8, watch).unwrap();
    let mut quiet = single_pendulum(Scheme::EemEntropy, 0.1).run;
    quiet.run_until_with(0.8, watch).unwrap();
    assert_eq!(bits(&quiet), bits(&run));
}

#[test]
fn the_first_of_several_events_ends_a_run_wherever_it_stands_in_the_list() {
    let clock = |time: f64| crossing(move |run| run.time() - time);
    let times = [0.83, 0.21, 0.215, 0.71, 0.705];
    let mut order = vec![1, 2, 4, 3, 0];
    let mut events = times.map(clock);
    for step in [0.05, 0.3, 3.0] {
        let mut run = free(step);
        for &expected in &order {
            let end = run.run_until_event(2.0, &mut events).unwrap();
            assert_eq!(end, RunEnd::Event(expected), "step {step}");
            assert!((run.time() - times[expected]).abs() < 1e-14);
            let happened = events.iter().filter(|event| event.has_happened());
            assert_eq!(happened.count(), 1);
        }
        assert_eq!(run.run_until_event(2.0, &mut events), Ok(RunEnd::Reached));
        assert!(!events.iter().any(Event::has_happened));
    }
    // The same in the reverse order.
    let mut events = times.map(clock);
    events.reverse();
    order = order.iter().map(|place| times.len() - 1 - place).collect();
    let mut run = free(3.0);
    for expected in order {
        let end = run.run_until_event(2.0, &mut events).unwrap();
        assert_eq!(end, RunEnd::Event(expected));
    }
}

#[test]
fn events_at_one_time_have_all_happened() {
    let clock = |time: f64| crossing(move |run| run.time() - time);
    let mut events = [clock(0.9), clock(0.5), clock(0.5)];
    let mut run = free(0.3);
    assert_eq!(run.run_until_event(2.0, &mut events), Ok(RunEnd::Event(1)));
    assert_eq!(
        events.each_ref().map(Event::has_happened),
        [false, true, true]
    );
    assert_eq!(run.run_until_event(2.0, &mut events), Ok(RunEnd::Event(0)));
}

#[test]
fn only_the_sense_that_is_asked_for_counts() {
    let wave = |run: &Simulation<2>| Ok((3.0 * run.time() + 0.1).sin());
    let zero = |number: f64| (number * std::f64::consts::PI - 0.1) / 3.0;
    for (event, expected) in [
        (Event::crossing(wave), [1.0, 2.0, 3.0]),
        (Event::falling(wave), [1.0, 3.0, 5.0]),
        (Event::rising(wave), [2.0, 4.0, 6.0]),
    ] {
        let mut run = free(0.05);
        let mut events = [event];
        for number in expected {
            run.run_until_event(20.0, &mut events).unwrap();
            assert!((run.time() - zero(number)).abs() < 1e-14);
        }
    }
}

#[test]
fn an_event_function_may_fail() {
    let foreign = Scene::<2>::new().mass(1.0, [0.0; 2], [0.0; 2]);
    let mut run = free(0.1);
    let before = bits(&run);
    let fails = Event::crossing(|run: &Simulation<2>| Ok(run.position(foreign)?[0]));
    let error = run.run_until_event(1.0, &mut [fails]).unwrap_err();
    let reason = "node 0 belongs to another scene".to_owned();
    let expected = StepFailure::EventError { event: 0, reason };
    assert_eq!(error.failure, expected);
    assert_eq!(bits(&run), before);
    // On the way, and behind one that does not fail.
    let late = Event::rising(|run: &Simulation<2>| {
        let time = run.time();
        if time > 0.55 {
            Err("too late".into())
        } else {
            Ok(1.0)
        }
    });
    let error = run.run_until_event(1.0, &mut [crossing(|_| 1.0), late]);
    let failure = error.unwrap_err().failure;
    assert_eq!(
        failure.to_string(),
        "the function of event 1 failed: too late"
    );
    assert!((run.time() - 0.5).abs() < 1e-15);
}

/// A mass that flies.
fn free(step: f64) -> Simulation<2> {
    let mut scene = Scene::<2>::new();
    scene.mass(1.0, [0.0; 2], [1.0, 0.0]);
    Simulation::new(scene, Scheme::EemEntropy, step).unwrap()
}

#[test]
fn an_event_that_fails_in_the_first_step_leaves_no_trace() {
    for scheme in [Scheme::EemEntropy, Scheme::EemExplicit, Scheme::Auto] {
        let run = |fails: bool| {
            let mut run = single_pendulum(scheme, 0.01).run;
            if scheme == Scheme::Auto {
                run.control_steps(Tolerance::new(1e-3)).unwrap();
            }
            if fails {
                let before = bits(&run);
                let later = |run: &Simulation<2>| match run.time() {
                    time if time > 0.0 => Err("no".into()),
                    _ => Ok(1.0),
                };
                let failed = run.run_until_event(9.0, &mut [Event::crossing(later)]);
                assert!(failed.is_err());
                assert_eq!(bits(&run), before);
            }
            run.run_until(1.0).unwrap();
            bits(&run)
        };
        assert_eq!(run(true), run(false), "{scheme}");
    }
}
