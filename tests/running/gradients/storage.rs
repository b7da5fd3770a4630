//! Histories in limited memory.

use core::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};

use eem::prelude::*;
use eem::{Gradient, GradientError, History, Objective};

use super::{FORMS, INPUTS, net, objective};
use crate::support::single_pendulum_scene;

/// All bits of a gradient.
fn bits<const D: usize>(gradient: &Gradient<D>) -> Vec<u64> {
    let numbers = gradient.numbers().into_iter();
    let numbers = numbers.chain([gradient.value(), gradient.growth()]);
    numbers.map(f64::to_bits).collect()
}

/// The bits of the gradient of [`objective`], after which the run goes on with the same bits.
fn bits_with(
    history: History,
    scheme: Scheme,
    tolerance: Option<Tolerance>,
) -> Result<Vec<u64>, GradientError> {
    let net = net(&INPUTS);
    let mut run = Simulation::new(net.scene.clone(), scheme, 0.025).unwrap();
    if let Some(tolerance) = tolerance {
        run.control_steps(tolerance).unwrap();
    }
    run.run_until(0.05).unwrap();
    run.keep_history(history);
    let times = [0.1, 0.2, 0.3, 0.4];
    run.run_at(times, |_| ControlFlow::Continue(())).unwrap();
    let before = run.checkpoint();
    let [first, again] = [(); 2].map(|()| run.gradient(&objective(&net)));
    assert_eq!(before, run.checkpoint());
    let first = bits(&first?);
    assert_eq!(first, bits(&again?));
    run.step().unwrap();
    let after = run.checkpoint();
    run.restore(&before).unwrap();
    run.step().unwrap();
    assert_eq!(after, run.checkpoint());
    Ok(first)
}

#[test]
fn gradients_have_the_same_bits_however_states_are_kept() {
    let tolerance = Some(Tolerance::new(1e-3));
    // Snapshots of all states; some states between; recursion. A state takes 144 bytes, a snapshot about 1 kB.
    for scheme in FORMS {
        for (tolerance, bytes, snapshots) in [
            (None, &[][..], &[64, 5, 3][..]),
            (tolerance, &[12_000, 8_000][..], &[200, 20, 12][..]),
        ] {
            let all = bits_with(History::default(), scheme, tolerance).unwrap();
            let bytes = bytes.iter().copied().map(History::bytes);
            let snapshots = snapshots.iter().copied().map(History::snapshots);
            for history in bytes.chain(snapshots) {
                let some = bits_with(history, scheme, tolerance);
                let is_same = some.as_ref().is_ok_and(|some| *some == all);
                assert!(is_same, "{scheme}, {tolerance:?}, {history:?}: {some:?}");
            }
        }
    }
}

#[test]
fn long_runs_need_little_memory() {
    let (scene, bob, ..) = single_pendulum_scene();
    let gradient = |history: History| {
        let mut run = Simulation::new(scene.clone(), Scheme::EemTemperature, 0.01).unwrap();
        run.keep_history(history);
        for _ in 0..5000 {
            run.step().unwrap();
        }
        run.gradient(&Objective::at_end(Quantity::Position(bob)))
    };
    let all = bits(&gradient(History::default()).unwrap());
    // All states take megabytes.
    assert_eq!(all, bits(&gradient(History::bytes(100_000)).unwrap()));
    let error = gradient(History::bytes(40_000)).unwrap_err();
    let fewer = |most: &usize| *most < 5000;
    assert!(matches!(&error, GradientError::HistoryTooLarge { most } if fewer(most)));
}

#[test]
fn steps_are_made_again_as_often_as_room_is_missing() {
    static CALLS: AtomicUsize = AtomicUsize::new(0);
    const STEPS: usize = 64;
    let calls = |history: History| {
        let mut scene = Scene::<1>::new();
        let mass = scene.mass(1.0, [0.0], [0.0]);
        scene.force(mass, |t| {
            CALLS.fetch_add(1, Ordering::Relaxed);
            [t]
        });
        let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.1).unwrap();
        run.keep_history(history);
        let count = || CALLS.swap(0, Ordering::Relaxed);
        count();
        for _ in 0..STEPS {
            run.step().unwrap();
        }
        let steps = count();
        let velocity = Objective::at_end(Quantity::Velocity(mass));
        run.gradient(&velocity).unwrap();
        (count(), steps / STEPS)
    };
    let (all, per_step) = calls(History::default());
    // The run keeps every state, every second one, every fourth one; from each on, steps are made again once more up to the
    // last one of them.
    for (snapshots, expected) in [(64, 64), (40, 64 + 32), (20, 64 + 3 * 16)] {
        let again = (calls(History::snapshots(snapshots)).0 - all) / per_step;
        assert_eq!(again, expected, "{snapshots} snapshots");
    }
}

#[test]
fn steps_that_end_elsewhere_when_made_again_are_an_error() {
    static CALLS: AtomicU64 = AtomicU64::new(0);
    let mut scene = Scene::<1>::new();
    let mass = scene.mass(1.0, [0.0], [0.0]);
    scene.force(mass, |_| {
        let calls = CALLS.fetch_add(1, Ordering::Relaxed);
        [if calls == 0 { 1.0 } else { 2.0 }]
    });
    let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.1).unwrap();
    run.keep_history(History::snapshots(10));
    run.run_until(1.0).unwrap();
    let before = run.checkpoint();
    let error = run.gradient(&Objective::at_end(Quantity::Position(mass)));
    assert!(
        matches!(error, Err(GradientError::NotRepeatable { .. })),
        "{error:?}"
    );
    assert_eq!(run.checkpoint(), before);
}

#[test]
fn a_panic_of_a_load_leaves_the_history() {
    static PANICS: AtomicBool = AtomicBool::new(false);
    let mut scene = Scene::<1>::new();
    let mass = scene.mass(1.0, [0.0], [0.0]);
    scene.force(mass, |t| {
        assert!(!PANICS.load(Ordering::Relaxed), "no force");
        [t]
    });
    let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.1).unwrap();
    run.keep_history(History::snapshots(3));
    run.run_until(1.0).unwrap();
    let place = Objective::at_end(Quantity::Position(mass));
    let expected = bits(&run.gradient(&place).unwrap());
    let before = run.checkpoint();
    PANICS.store(true, Ordering::Relaxed);
    assert!(catch_unwind(AssertUnwindSafe(|| run.gradient(&place))).is_err());
    PANICS.store(false, Ordering::Relaxed);
    assert_eq!(before, run.checkpoint());
    assert_eq!(expected, bits(&run.gradient(&place).unwrap()));
}

#[test]
fn whoever_watches_ends_steps_that_are_made_again() {
    let (scene, bob, ..) = single_pendulum_scene();
    let mut run = Simulation::new(scene, Scheme::EemTemperature, 0.1).unwrap();
    run.keep_history(History::snapshots(2));
    run.run_until(1.0).unwrap();
    let place = Objective::at_end(Quantity::Position(bob));
    let (expected, before) = (bits(&run.gradient(&place).unwrap()), run.checkpoint());
    // 10 steps back, and more that are made again.
    for calls in 1..15 {
        let mut left = calls;
        run.watch_gradients(move || {
            left -= 1;
            if left > 0 {
                ControlFlow::Continue(())
            } else {
                ControlFlow::Break(())
            }
        });
        assert_eq!(run.gradient(&place).unwrap_err(), GradientError::Stopped);
        assert_eq!(before, run.checkpoint());
    }
    run.watch_gradients(|| ControlFlow::Continue(()));
    assert_eq!(expected, bits(&run.gradient(&place).unwrap()));
}

#[test]
fn values_that_controllers_have_set_need_all_states() {
    let end = |history: History| {
        let (scene, bob, ..) = single_pendulum_scene();
        let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.1).unwrap();
        run.keep_history(history);
        for force in [1.0, 2.0, 0.0] {
            run.set_force(bob, [force, 0.0]).unwrap();
            run.step().unwrap();
        }
        run.gradient(&Objective::at_end(Quantity::Position(bob)))
    };
    assert!(end(History::default()).is_ok());
    let some = end(History::snapshots(10));
    assert!(matches!(some, Err(GradientError::NotRepeatable { .. })));
}

#[test]
fn energies_beside_an_oven_have_the_same_derivatives_from_snapshots() {
    let gradient = |history| {
        let (mut scene, _, spring, _) = single_pendulum_scene();
        let oven = scene.oven(|t: f64| 290.0 + 5.0 * t);
        scene.conduct(spring, oven, 1.0);
        let mut run = Simulation::new(scene, Scheme::EemTemperature, 0.1).unwrap();
        run.keep_history(history);
        run.run_until(1.0).unwrap();
        let at_end = [[run.time(), 0.0, 1.0]];
        let objective = Objective::integral(Quantity::TotalEnergy)
            + Objective::misfit(Quantity::TotalEnergy, at_end);
        let gradient = run.gradient(&objective).unwrap();
        run.check_gradient(&gradient, &objective).unwrap();
        bits(&gradient)
    };
    assert_eq!(
        gradient(History::default()),
        gradient(History::snapshots(3))
    );
}
