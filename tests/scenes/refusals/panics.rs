//! A load that panics takes nothing with it: the simulation is as it was, and goes on.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use eem::prelude::*;

use super::WARM;

/// What panics while the switch is on.
const CULPRITS: [&str; 3] = ["force", "motion", "thermostat"];

/// A driven pendulum in which one of the functions of time panics while the switch is on.
fn driven(scheme: Scheme, culprit: &str, switch: &Arc<AtomicBool>) -> Simulation<2> {
    let mut scene = Scene::<2>::new();
    let support = scene.anchor([0.0, 0.0]);
    let bob = scene.mass(1.0, [1.0, 0.0], [0.0, 0.3]);
    let spring = scene.spring(WARM, [support, bob]);
    scene.set_temperature(spring, 310.0);
    let panics = |name: &str| {
        let (is_culprit, switch) = (culprit == name, Arc::clone(switch));
        move || {
            assert!(
                !(is_culprit && switch.load(Ordering::Relaxed)),
                "a load of the test"
            );
        }
    };
    let [force, motion, heat] = CULPRITS.map(panics);
    scene.force(bob, move |t| {
        force();
        [t.cos(), 0.0]
    });
    scene.move_anchor(support, move |t| {
        motion();
        [0.0, 0.1 * t.sin()]
    });
    scene.prescribe_temperature(spring, move |t| {
        heat();
        310.0 + t
    });
    Simulation::new(scene, scheme, 0.02).unwrap()
}

/// Everything that the next steps depend on.
fn bits(run: &Simulation<2>) -> String {
    format!("{:?}", run.checkpoint())
}

#[test]
fn the_simulation_is_as_it_was_and_goes_on() {
    let off = Arc::new(AtomicBool::new(false));
    for scheme in Scheme::ALL {
        for culprit in CULPRITS {
            let switch = Arc::new(AtomicBool::new(false));
            let mut run = driven(scheme, culprit, &switch);
            let mut calm = driven(scheme, culprit, &off);
            for run in [&mut run, &mut calm] {
                run.step().unwrap();
                run.step().unwrap();
            }
            let before = bits(&run);
            switch.store(true, Ordering::Relaxed);
            assert!(catch_unwind(AssertUnwindSafe(|| run.step())).is_err());
            assert_eq!(before, bits(&run), "{}: {culprit}", scheme.name());
            // A run shortens its last step, which must not outlive a panic.
            let end = run.time() + 0.005;
            let towards = AssertUnwindSafe(|| run.run_until(end));
            assert!(catch_unwind(towards).is_err());
            assert_eq!(before, bits(&run), "{}: {culprit} in a run", scheme.name());
            switch.store(false, Ordering::Relaxed);
            for run in [&mut run, &mut calm] {
                run.step().unwrap();
            }
            assert_eq!(bits(&run), bits(&calm), "{}: {culprit}", scheme.name());
        }
    }
}

/// Those of [`bits`] that say what the next steps do: what an explicit scheme predicts has no effect on them.
fn effective(run: &Simulation<2>) -> String {
    bits(run).split("past:").next().unwrap().to_owned()
}

/// Two runs that know nothing of each other, after two steps.
fn two_of(scheme: Scheme) -> [Simulation<2>; 2] {
    let off = Arc::new(AtomicBool::new(false));
    [0, 1].map(|_| {
        let mut run = driven(scheme, "none", &off);
        run.step().unwrap();
        run.step().unwrap();
        run
    })
}

#[test]
fn an_observer_that_panics_within_a_step_leaves_the_run_at_its_end() {
    for scheme in Scheme::ALL.into_iter().chain([Scheme::Auto]) {
        let [mut run, mut calm] = two_of(scheme);
        let start = run.time();
        let times = [start + 1e-3, start + 5.0];
        let sampling = AssertUnwindSafe(|| {
            run.sample_at(&times, |run| {
                assert!(run.time() >= start + 5.0, "an observer of the test");
                ControlFlow::Continue(())
            })
        });
        assert!(catch_unwind(sampling).is_err(), "{scheme}");
        calm.step().unwrap();
        assert_eq!(effective(&run), effective(&calm), "{scheme}");
        for run in [&mut run, &mut calm] {
            run.step().unwrap();
        }
        assert_eq!(effective(&run), effective(&calm), "{scheme}");
    }
}

#[test]
fn an_event_that_panics_leaves_the_run_before_the_step() {
    for scheme in Scheme::ALL.into_iter().chain([Scheme::Auto]) {
        // At the end of the step, and in the search for a change of sign within it.
        for sign in [1.0, -1.0] {
            let [mut run, calm] = two_of(scheme);
            let start = run.time();
            let mut calls = 0;
            let event = Event::crossing(move |run: &Simulation<2>| {
                calls += 1;
                assert!(sign < 0.0 && calls < 3 || calls < 2, "an event of the test");
                Ok(if run.time() > start { sign } else { 1.0 })
            });
            let mut events = [event];
            let looking = AssertUnwindSafe(|| run.run_until_event(start + 5.0, &mut events));
            assert!(catch_unwind(looking).is_err(), "{scheme}");
            assert_eq!(effective(&run), effective(&calm), "{scheme}, {sign}");
        }
    }
}
