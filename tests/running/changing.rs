//! Another scheme and another step in the middle of a run.

use eem::prelude::*;
use eem_testkit::length::at_length;
use eem_testkit::random::Random;

use crate::support::springs::Braked;
use crate::support::{EXACT, busy, hencky, hooke};

/// The stored state in all bits; energies are evaluated again by another scheme.
fn bits<const D: usize>(run: &Simulation<D>) -> String {
    let state = format!("{:?}", run.checkpoint());
    let [_, state] = state
        .split_once("state: State")
        .map(<[&str; 2]>::from)
        .unwrap();
    let [state, _] = state
        .split_once("energies: ")
        .map(<[&str; 2]>::from)
        .unwrap();
    state.to_owned()
}

#[test]
fn every_scheme_goes_on_from_the_state_of_every_other() {
    for from in EXACT.into_iter().chain(Scheme::ALL) {
        for to in EXACT.into_iter().chain(Scheme::ALL) {
            let mut run = Simulation::new(busy(), from, 0.01).unwrap();
            if from == Scheme::Auto {
                run.fix_steps();
            }
            run.run_until(0.05).unwrap();
            let before = bits(&run);
            let mut run = run.with_scheme(to).unwrap();
            assert_eq!(run.scheme(), to);
            assert_eq!(bits(&run), before, "{from} to {to}");
            let saved = run.checkpoint();
            run.run_until(0.1).unwrap();

            // A run that began with the other scheme goes on in the same way.
            let mut other = Simulation::new(busy(), to, 0.3).unwrap();
            other.restore(&saved).unwrap();
            other.run_until(0.1).unwrap();
            assert_eq!(bits(&other), bits(&run), "{from} to {to}");
        }
    }
}

#[test]
fn the_balance_holds_over_random_changes_of_scheme_and_step() {
    let mut random = Random::new(31);
    let mut run = Simulation::new(busy(), Scheme::EemEntropy, 0.01).unwrap();
    let start = run.ledger().balance;
    let mut bound = 0.0;
    for _ in 0..at_length(10_000, 3_000) {
        let scheme = EXACT[random.below(EXACT.len())];
        run = run.with_scheme(scheme).unwrap();
        if random.below(2) == 0 {
            run.fix_steps();
        }
        run.set_step_size(1e-3 * 10.0_f64.powf(random.unit()))
            .unwrap();
        let (time, size) = (run.time(), run.step_size());
        let report = run.step().unwrap();
        if run.tolerance().is_none() {
            assert_eq!(report.step.to_bits(), size.to_bits());
        }
        assert!(run.time() > time);
        // Of the step, and of the sum that the ledger forms from the new state.
        bound += 2.0 * report.bound;
        let defect = (run.ledger().balance - start).abs();
        assert!(defect <= bound, "{scheme}: {defect:e} above {bound:e}");
    }
}

#[test]
fn tolerances_stay_and_choose_steps_for_the_new_scheme() {
    let mut run = Simulation::new(busy(), Scheme::EemExplicit, 0.01).unwrap();
    run.control_steps(Tolerance::new(1e-5)).unwrap();
    run.run_until(0.2).unwrap();
    let accepted = run.step_statistics().unwrap().accepted;
    let mut run = run.with_scheme(Scheme::EemEntropy4).unwrap();
    assert_eq!(run.tolerance(), Some(Tolerance::new(1e-5)));
    run.run_until(0.4).unwrap();
    assert!(run.step_statistics().unwrap().accepted > accepted);

    let refused = run.with_scheme(Scheme::Variational).unwrap_err();
    assert!(matches!(refused.error(), SceneError::FixedSteps { .. }));
    let mut run = refused.into_run();
    run.fix_steps();
    assert!(run.with_scheme(Scheme::Variational).is_ok());
}

#[test]
fn a_refused_scheme_leaves_the_run_as_it_was() {
    let mut scene = Scene::<1>::new();
    let ends = [scene.anchor([0.0]), scene.mass(1.0, [1.1], [0.0])];
    let spring = scene.spring(
        Braked {
            k: 4.0,
            eta: 0.1,
            length: 1.0,
        },
        ends,
    );
    let mut run = Simulation::new(scene, Scheme::EemTemperature, 0.1).unwrap();
    run.run_until(1.0).unwrap();
    let before = format!("{:?}", run.checkpoint());
    for scheme in [Scheme::EemExplicit, Scheme::Staggered, Scheme::Gauss4] {
        let refused = run.with_scheme(scheme).unwrap_err();
        let expected = SceneError::NoDrag {
            scheme: scheme.name(),
            element: spring,
        };
        assert_eq!(refused.error(), &expected);
        run = refused.into_run();
        assert_eq!(format!("{:?}", run.checkpoint()), before);
    }
    // The choice takes what can step it.
    let run = run.with_scheme(Scheme::Auto).unwrap();
    assert_eq!(run.scheme_in_use(), Scheme::EemTemperature);
    assert_eq!(run.tolerance(), Some(Tolerance::default()));
}

#[test]
fn missing_memory_leaves_the_run_as_it_was() {
    let mut scene = Scene::<2>::new();
    let mut last = scene.anchor([0.0, 0.0]);
    for index in 1..=100 {
        let next = scene.mass(1.0, [f64::from(index), 0.0], [0.0, 0.0]);
        let spring = hooke(1.0, 1.0);
        scene.spring(spring, [last, next]);
        last = next;
    }
    scene.limit_memory(1_000);
    let mut run = Simulation::new(scene, Scheme::EemExplicit, 0.1).unwrap();
    run.step().unwrap();
    let refused = run.with_scheme(Scheme::EemEntropy).unwrap_err();
    assert!(matches!(refused.error(), SceneError::TooLarge(_)));
    assert!(refused.into_run().step().is_ok());
}

#[test]
fn a_run_may_start_at_any_time() {
    let build = |start: f64, shift: f64| {
        let mut scene = Scene::<1>::new();
        let support = scene.anchor([0.0]);
        let mass = scene.mass(1.0, [1.1], [0.0]);
        let spring = hencky(30.0, 1.0);
        scene.spring(spring, [support, mass]);
        scene.force(mass, move |t: f64| [(t - shift).sin()]);
        scene.move_anchor(support, move |t: f64| [0.1 * (t - shift).sin()]);
        scene.start_at(start);
        (
            Simulation::new(scene, Scheme::EemTemperature, 0.125).unwrap(),
            mass,
        )
    };
    // With steps and times that have few digits the functions get the same arguments.
    let place = |start: f64| {
        let (mut run, mass) = build(start, start);
        assert_eq!(run.time().to_bits(), start.to_bits());
        run.run_until(start + 1.0).unwrap();
        let saved = run.checkpoint();
        let (mut resumed, _) = build(start, start);
        resumed.restore(&saved).unwrap();
        assert_eq!(resumed.checkpoint(), saved);
        run.position(mass).unwrap()[0].to_bits()
    };
    assert_eq!(place(-2.0), place(0.0));
    assert_eq!(place(4.0), place(0.0));

    let mut scene = Scene::<1>::new();
    scene.mass(1.0, [0.0], [0.0]);
    scene.start_at(f64::NAN);
    let refused = Simulation::new(scene, Scheme::EemTemperature, 0.1).unwrap_err();
    assert!(matches!(refused.errors(), [SceneError::StartTime { .. }]));
}
