//! Ensembles: results in the order of the inputs, with the bits of one run after the other,
//! whatever happens to a neighbour and whoever does the work.

use std::error::Error;
use std::num::ParseFloatError;
use std::panic::{AssertUnwindSafe, catch_unwind};

use eem::prelude::*;
use eem::{MemberError, MemberFailure, StepFailure};

use crate::support::ThermoViscoElastic;

/// The published step of the single pendulum, s.
const STEP: f64 = 0.2;

/// One, several, more than this machine may have, and what rayon thinks right.
const THREADS: [usize; 4] = [1, 2, 4, 0];

/// What the members of these ensembles differ in.
#[derive(Clone, Copy, Debug)]
struct Start {
    /// m/s
    speed: f64,
    /// N m
    stiffness: f64,
    steps: usize,
}

impl Start {
    /// Members of very different length: the first ones take the longest.
    fn various(members: u32) -> Vec<Self> {
        let start = |i: u32| Self {
            speed: 0.5 + 0.1 * f64::from(i),
            stiffness: 80.0 + f64::from(i),
            steps: if i.is_multiple_of(5) { 60 } else { 3 },
        };
        (0..members).map(start).collect()
    }
}

/// The single pendulum of García Orden & Romero (2012), §4.1, with another start.
fn pendulum(start: &Start) -> (Scene<2>, Element) {
    let mut scene = Scene::<2>::new();
    let pivot = scene.anchor([0.0, 0.0]);
    let bob = scene.mass(1.0, [3.0, 0.0], [0.0, start.speed]);
    let law = ThermoViscoElastic {
        k0: start.stiffness,
        ..ThermoViscoElastic::PENDULUM
    };
    let spring = scene.spring(law, [pivot, bob]);
    scene.set_temperature(spring, 380.0);
    let air = scene.reservoir(300.0);
    scene.conduct(spring, air, 10.0);
    (scene, spring)
}

/// Steps, and returns all that the next step depends on, as text that tells all doubles apart.
fn bits(run: &mut Simulation<2>, start: &Start) -> Result<String, MemberFailure> {
    for _ in 0..start.steps {
        run.step()?;
    }
    Ok(format!("{:?}", run.checkpoint()))
}

/// The bits of the members by an ensemble.
fn by_ensemble(ensemble: Ensemble<'_>, starts: &[Start]) -> Vec<Result<String, MemberError>> {
    ensemble.run(starts, pendulum, |run, _, start| bits(run, start))
}

/// The bits of one member without an ensemble.
fn by_hand(scheme: Scheme, start: &Start) -> String {
    let mut run = Simulation::new(pendulum(start).0, scheme, STEP).unwrap();
    bits(&mut run, start).unwrap()
}

// Order and bits.

#[test]
fn bits_are_those_of_one_by_one_for_any_number_of_threads() {
    let starts = Start::various(23);
    for scheme in [
        Scheme::EemEntropy,
        Scheme::EemTemperature,
        Scheme::Variational,
    ] {
        let expected: Vec<_> = starts.iter().map(|start| by_hand(scheme, start)).collect();
        for threads in THREADS {
            let ensemble = Ensemble::new(scheme, STEP).threads(threads);
            let found: Result<Vec<_>, _> = by_ensemble(ensemble, &starts).into_iter().collect();
            assert_eq!(found.unwrap(), expected, "{scheme:?}, {threads} threads");
        }
    }
}

#[test]
fn members_find_their_own_input_and_handles() {
    let starts = Start::various(10);
    let results = Ensemble::new(Scheme::EemTemperature, STEP).run(
        &starts,
        |start| {
            let (scene, spring) = pendulum(start);
            (scene, (spring, start.stiffness))
        },
        |run, (spring, stiffness), start| Ok((run.stretch(spring)?, stiffness - start.stiffness)),
    );
    let found: Result<Vec<_>, _> = results.into_iter().collect();
    assert_eq!(found.unwrap(), [(3.0, 0.0); 10]);
}

#[test]
fn no_input_is_no_work() {
    for threads in THREADS {
        let ensemble = Ensemble::new(Scheme::EemEntropy, STEP)
            .threads(threads)
            .watch(|_, _| unreachable!());
        assert!(by_ensemble(ensemble, &[]).is_empty());
    }
}

// Failures.

#[test]
fn a_failure_is_its_members_own() {
    let mut starts = Start::various(9);
    let healthy: Vec<_> = starts
        .iter()
        .map(|start| by_hand(Scheme::EemTemperature, start))
        .collect();
    starts[2].stiffness = f64::NAN;
    starts[6].speed = f64::INFINITY;
    for threads in THREADS {
        let ensemble = Ensemble::new(Scheme::EemTemperature, STEP).threads(threads);
        for (member, result) in by_ensemble(ensemble, &starts).into_iter().enumerate() {
            match result {
                Ok(bits) => assert_eq!(bits, healthy[member]),
                Err(error) => {
                    assert_eq!(error.member, member);
                    let expected = match member {
                        2 => {
                            "member 2: parameter `k0` of element 0 (ThermoViscoElastic) is NaN, it must be finite"
                        }
                        6 => {
                            "member 6: component 1 of the velocity of node 1 is inf m/s, \
                             it must be finite"
                        }
                        _ => panic!("{error}"),
                    };
                    assert_eq!(error.to_string(), expected);
                    assert!(matches!(error.failure, MemberFailure::Scene(_)));
                }
            }
        }
    }
}

#[test]
fn a_failed_step_is_reported_with_its_numbers() {
    let results = Ensemble::new(Scheme::EemEntropy, 0.5).run(
        &[10.0, 1.0],
        |&end| {
            let mut scene = Scene::<2>::new();
            let stone = scene.mass(1.0, [0.0; 2], [1.0, 0.0]);
            scene.force(stone, move |time: f64| {
                [if time < end { 0.0 } else { f64::NAN }, 0.0]
            });
            (scene, stone)
        },
        |run, stone, _| {
            run.run_until(3.0)?;
            Ok(run.position(stone)?.x)
        },
    );
    assert_eq!(results[0].as_ref().unwrap().to_bits(), 3.0_f64.to_bits());
    let error = results[1].as_ref().unwrap_err();
    let MemberFailure::Step(step) = &error.failure else {
        panic!("{error}")
    };
    assert!(matches!(step.failure, StepFailure::Load { value, .. } if value.is_nan()));
    assert_eq!(error.to_string(), format!("member 1: {step}"));
    // The message has the cause; a chain of errors would print it twice.
    assert!(error.source().is_none());
    assert!(step.source().is_none());
}

#[test]
fn errors_of_the_caller_pass_through() {
    let results = Ensemble::new(Scheme::EemEntropy, STEP).run(
        &["2.5", "two"],
        |_| (Scene::<2>::new(), ()),
        |_, (), text| text.parse::<f64>().map_err(MemberFailure::other),
    );
    assert_eq!(results[0].as_ref().unwrap().to_bits(), 2.5_f64.to_bits());
    let MemberFailure::Other(own) = &results[1].as_ref().unwrap_err().failure else {
        panic!("another failure")
    };
    assert!(own.downcast_ref::<ParseFloatError>().is_some());
}

#[test]
fn what_no_member_can_work_with_fails_in_every_member() {
    let starts = Start::various(3);
    let useless = NewtonSettings {
        max_iterations: 0,
        tolerance: 1e-8,
    };
    let settings = Ensemble::new(Scheme::EemEntropy, STEP).newton(useless);
    let step = Ensemble::new(Scheme::EemEntropy, -STEP);
    for (ensemble, refused) in [
        (settings, "at least one iteration"),
        (step, "the time step"),
    ] {
        for result in by_ensemble(ensemble, &starts) {
            let error = result.unwrap_err();
            assert!(error.to_string().contains(refused), "{error}");
            assert!(matches!(error.failure, MemberFailure::Scene(_)));
        }
    }
}

#[test]
fn settings_of_newton_reach_the_members() {
    let settings = NewtonSettings {
        max_iterations: 7,
        tolerance: 1e-6,
    };
    let ensemble = Ensemble::new(Scheme::EemEntropy, STEP).newton(settings);
    let found = ensemble.run(&Start::various(1), pendulum, |run, _, _| {
        Ok(run.newton_settings())
    });
    assert_eq!(*found[0].as_ref().unwrap(), settings);
}

// What one member leaves to the next.

/// Pendulums of one spring or two, alone, in contact, with weight or pushed; three members of a kind follow each other.
fn of_several_kinds(member: u32) -> (Scene<2>, Node) {
    let (kind, own) = (member / 3 % 5, 1.0 + 0.01 * f64::from(member));
    let mut scene = Scene::<2>::new();
    let pivot = scene.anchor([0.0, 0.0]);
    let bob = scene.mass(own, [3.0 * own, 0.0], [0.0, own]);
    let spring = scene.spring(ThermoViscoElastic::PENDULUM, [pivot, bob]);
    scene.set_temperature(spring, 350.0 * own);
    scene.set_viscous_stretch(spring, 0, 0.1 * own);
    let air = scene.reservoir(300.0 * own);
    scene.conduct(spring, air, 10.0 * own);
    if kind != 0 {
        let end = scene.mass(2.0 * own, [5.0, own], [0.0, 0.0]);
        let other = scene.spring(ThermoViscoElastic::PENDULUM, [bob, end]);
        scene.set_temperature(other, 300.0 * own);
        match kind {
            1 => {}
            2 => drop(scene.conduct(spring, other, own)),
            3 => scene.set_gravity([0.0, -9.8 * own]),
            _ => scene.force(end, |time: f64| [time, 1.0]),
        }
    }
    (scene, bob)
}

/// Settings with which steps fail.
const HASTY: NewtonSettings = NewtonSettings {
    max_iterations: 1,
    tolerance: 1e-15,
};

/// Steps in different ways, of which some fail; returns what each step says, and all that the next one depends on.
fn life(run: &mut Simulation<2>, bob: Node, member: u32) -> Result<String, MemberFailure> {
    let mut said = String::new();
    let mut say = |text: String| said += &text;
    if member % 4 == 1 {
        run.meter_heat();
    }
    if member % 7 == 2 {
        say(format!("{:?}", run.control_steps(Tolerance::new(1e-3))));
    }
    (0..5).for_each(|_| say(format!("{:?}", run.step())));
    if member % 5 == 4 {
        say(format!("{:?}", run.set_force(bob, [0.5, 0.0])));
    }
    // A step fails in the middle of the life, or at its end.
    let usual = run.newton_settings();
    for fails in [!member.is_multiple_of(2), false, member.is_multiple_of(2)] {
        run.set_newton_settings(if fails { HASTY } else { usual })?;
        say(format!("{:?}", run.step()));
    }
    say(format!("{:?} {:?}", run.checkpoint(), run.ledger()));
    Ok(said)
}

#[test]
fn a_member_leaves_no_trace_in_the_next() {
    let members: Vec<u32> = (0..12).collect();
    for scheme in Scheme::ALL.into_iter().chain([Scheme::Auto]) {
        let alone = |member: &u32| {
            let (scene, bob) = of_several_kinds(*member);
            let mut run = Simulation::new(scene, scheme, 0.05).unwrap();
            life(&mut run, bob, *member).unwrap()
        };
        let ensemble = Ensemble::new(scheme, 0.05).threads(1);
        let found = ensemble.run(
            &members,
            |&member| of_several_kinds(member),
            |run, bob, member| life(run, bob, *member),
        );
        for (member, found) in members.iter().zip(found) {
            assert_eq!(found.unwrap(), alone(member), "{scheme:?}, {member}");
        }
    }
}

// Watching and stopping.

#[test]
fn the_watch_counts_every_member_in_order() {
    let mut starts = Start::various(20);
    starts[3].stiffness = f64::NAN;
    for threads in THREADS {
        let mut calls = Vec::new();
        let ensemble = Ensemble::new(Scheme::EemTemperature, STEP)
            .threads(threads)
            .watch(|done, total| {
                calls.push((done, total));
                ControlFlow::Continue(())
            });
        assert_eq!(by_ensemble(ensemble, &starts).len(), 20);
        let expected: Vec<_> = (1..=20).map(|done| (done, 20)).collect();
        assert_eq!(calls, expected);
    }
}

#[test]
fn members_that_have_not_begun_can_be_called_off() {
    let starts = Start::various(50);
    for threads in [1, 2, 4] {
        let ensemble = Ensemble::new(Scheme::EemTemperature, STEP)
            .threads(threads)
            .watch(|done, _| match done {
                10.. => ControlFlow::Break(()),
                _ => ControlFlow::Continue(()),
            });
        let results = by_ensemble(ensemble, &starts);
        assert_eq!(results.len(), 50);
        let finished = results.iter().flatten().count();
        // Those at work finish: at most one for each further thread.
        assert!((10..10 + threads).contains(&finished), "{finished}");
        for (start, result) in starts.iter().zip(results) {
            match result {
                Ok(bits) => assert_eq!(bits, by_hand(Scheme::EemTemperature, start)),
                Err(error) => assert!(matches!(error.failure, MemberFailure::Stopped)),
            }
        }
    }
}

#[test]
fn a_panic_reaches_the_caller() {
    for threads in THREADS {
        let ensemble = Ensemble::new(Scheme::EemTemperature, STEP).threads(threads);
        let panicking = || {
            ensemble.run(&Start::various(8), pendulum, |_, _, start| {
                assert!(start.stiffness < 83.0, "too stiff");
                Ok(())
            })
        };
        let payload = catch_unwind(AssertUnwindSafe(panicking)).unwrap_err();
        assert_eq!(payload.downcast_ref::<&str>(), Some(&"too stiff"));
    }
}
