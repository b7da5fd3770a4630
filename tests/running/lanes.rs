//! Experiments: with the feature `lanes` several members move together, with the bits that each of
//! them has alone, and whoever cannot keep company runs alone.

mod bits;
mod counting;
mod scenes;
mod turning;
mod watched;

use bits::{SCHEMES, check, ensemble, inputs, one_by_one};
use counting::Until;
use eem::MemberFailure;
use eem::prelude::*;
use scenes::{Chain, Damped, Driven, Elastic, Pendulum, Sweep, Thermoelastic};
use turning::Turning;
use watched::{Case, Input, Watched};

// Bits.

#[test]
fn elastic_springs_have_the_bits_of_one_by_one() {
    let inputs = inputs(|i| [0.3 + 0.4 * i, 0.0, 0.0]);
    for scheme in SCHEMES {
        check(Elastic, (scheme, 0.05, 100), &inputs);
        check(Elastic, (scheme, 0.05, 10), &inputs[..6]);
    }
}

#[test]
fn thermoelastic_springs_have_the_bits_of_one_by_one() {
    let inputs = inputs(|i| [0.2 + 0.3 * i, 290.0 + 10.0 * i, 0.0]);
    for scheme in SCHEMES {
        check(Thermoelastic, (scheme, 0.02, 100), &inputs);
    }
}

#[cfg(feature = "typed")]
#[test]
fn springs_of_texts_have_the_bits_of_one_by_one() {
    let source = eem::typed::Source::new(
        "|lambda: Stretch, theta: Temperature| {
            let strain = ln(lambda / 2);
            0.5 * (1250 - 50 * ln(theta / 300)) * strain.powi(2) - 5 * (theta - 300) * strain
                + c * (theta - 300 - theta * ln(theta / 300))
        }",
    );
    let compiled = eem::typed::compile(&source.parameter("c", None)).unwrap();
    let law = eem::typed::Law::new(compiled, &[("c", 1250.0)]).unwrap();
    let inputs = inputs(|i| [0.2 + 0.3 * i, 290.0 + 10.0 * i, 0.0]);
    for scheme in SCHEMES {
        check(scenes::OfTexts(law.clone()), (scheme, 0.02, 50), &inputs);
    }
}

#[test]
fn parameters_of_a_material_may_differ() {
    let inputs = inputs(|i| [400.0 + 50.0 * i, i, 1.0 + 0.01 * i]);
    for scheme in SCHEMES {
        check(Sweep, (scheme, 0.01, 100), &inputs);
    }
}

#[test]
fn dashpots_beside_springs_have_the_bits_of_one_by_one() {
    let inputs = inputs(|i| [1.0 + 0.5 * i, 290.0 + 10.0 * i, 0.01 * 3.0_f64.powf(i)]);
    for scheme in [Scheme::EemEntropy, Scheme::EemTemperature] {
        check(Damped, (scheme, 0.02, 100), &inputs);
        check(Damped, (scheme, 0.2, 30), &inputs[..6]);
    }
}

#[test]
fn loads_supports_and_thermostats_may_differ() {
    // The first member is not driven at all.
    let inputs = inputs(|i| [0.01 * i, 5.0 * i, 0.5 * i]);
    for scheme in SCHEMES {
        check(Driven, (scheme, 0.02, 60), &inputs);
    }
}

#[test]
fn members_may_need_different_numbers_of_iterations() {
    let inputs = inputs(|i| [0.01 * 3.0_f64.powf(i), 310.0, 0.0]);
    for scheme in [Scheme::EemEntropy, Scheme::EemTemperature] {
        let iterations = check(Thermoelastic, (scheme, 0.1, 60), &inputs[..8]);
        let bundles = iterations.chunks_exact(4);
        let differ = |bundle: &[usize]| bundle.iter().any(|count| *count != bundle[0]);
        assert!(bundles.clone().all(differ), "{iterations:?}");
    }
}

#[test]
fn an_ensemble_of_closures_has_the_same_bits() {
    let inputs = inputs(|i| [0.8 + 0.05 * i, 350.0 + 4.0 * i, 2.0 * i]);
    let (scheme, step) = (Scheme::EemTemperature, 0.2);
    let by_closures = ensemble(scheme, step).run(
        &inputs,
        |&input| {
            let (scene, parts) = Case::<2>::scene::<f64>(&Pendulum, input);
            (scene, parts.nodes[0])
        },
        |run, bob, _| {
            for _ in 0..25 {
                run.step()?;
            }
            Ok(run.position(bob)?.map(f64::to_bits))
        },
    );
    let experiment = Watched::new(Pendulum, 25);
    let found = ensemble(scheme, step).run_experiment(&experiment, &inputs);
    for (found, expected) in found.iter().zip(by_closures) {
        let bits = &found.as_ref().unwrap().bits;
        let last_step = &bits[bits.len() / 25 * 24..];
        assert_eq!(last_step[3..5], *expected.unwrap().as_slice());
    }
}

#[test]
fn threads_do_not_matter() {
    let inputs = inputs(|i| [0.8 + 0.05 * i, 350.0 + 4.0 * i, 2.0 * i]);
    let experiment = Watched::new(Pendulum, 10);
    let run = |threads: usize| {
        let ensemble = Ensemble::new(Scheme::EemTemperature, 0.2).threads(threads);
        let seen = ensemble.run_experiment(&experiment, &inputs);
        seen.into_iter().map(Result::unwrap).collect::<Vec<_>>()
    };
    let expected = run(1);
    assert_eq!(run(2), expected);
    assert_eq!(run(0), expected);
}

// Who cannot keep company.

/// Asserts the outcome of one by one, whoever moves together.
fn check_outcome<const D: usize, C: Case<D>>(
    case: C,
    (scheme, step, steps): (Scheme, f64, usize),
    inputs: &[Input],
) -> Vec<Option<MemberFailure>> {
    let experiment = Watched::new(case, steps);
    let expected = one_by_one(&experiment, (scheme, step), inputs);
    let found = ensemble(scheme, step).run_experiment(&experiment, inputs);
    assert_eq!(found.len(), inputs.len());
    let mut failures = Vec::new();
    for (member, (found, expected)) in found.into_iter().zip(expected).enumerate() {
        match (found, expected) {
            (Ok(found), Ok(expected)) => {
                assert!(found.bits == expected.bits, "member {member}");
                failures.push(None);
            }
            (Err(found), Err(expected)) => {
                assert_eq!(found.member, member);
                assert_eq!(found.failure.to_string(), expected.failure.to_string());
                failures.push(Some(found.failure));
            }
            (found, expected) => panic!("{found:?} instead of {expected:?}"),
        }
    }
    failures
}

#[test]
fn a_refused_scene_is_its_members_own() {
    let mut inputs = inputs(|i| [0.8 + 0.05 * i, 350.0 + 4.0 * i, 2.0 * i]);
    inputs[1][0] = f64::NAN;
    inputs[5][1] = -3.0;
    let failures = check_outcome(Pendulum, (Scheme::EemTemperature, 0.2, 10), &inputs);
    for (member, failure) in failures.into_iter().enumerate() {
        match (member, failure) {
            (1 | 5, Some(failure)) => assert!(matches!(failure, MemberFailure::Scene(_))),
            (1 | 5, None) => panic!("member {member}"),
            (_, failure) => assert!(failure.is_none()),
        }
    }
}

#[test]
fn a_failed_step_is_its_members_own() {
    let mut inputs = inputs(|i| [0.01 * i, 5.0 * i, 0.5 * i]);
    // Cooled below 0 K after 0.3 s.
    inputs[3][2] = -1000.0;
    for scheme in [Scheme::EemTemperature, Scheme::EemExplicit] {
        let failures = check_outcome(Driven, (scheme, 0.02, 30), &inputs);
        for (member, failure) in failures.into_iter().enumerate() {
            let has_failed = matches!(failure, Some(MemberFailure::Step(_)));
            assert_eq!(has_failed, member == 3, "{failure:?}");
        }
    }
}

#[test]
fn what_is_halved_or_followed_alone_is_so_in_company() {
    // Large steps: some corrections lead beyond the admissible states.
    let inputs = inputs(|i| [1.0 + 4.0 * i, 380.0, 10.0]);
    for scheme in [Scheme::EemEntropy, Scheme::EemTemperature] {
        check_outcome(Pendulum, (scheme, 1.0, 30), &inputs);
    }
}

// Energy comes back by heat, by motion, by shape or not at all: steps near the limit of stability.
#[test]
fn members_may_close_their_steps_in_different_ways() {
    let inputs = inputs(|i| [1.0 + 4.0 * i, 380.0, 10.0]);
    for step in [0.03, 0.05, 0.07, 0.1] {
        check_outcome(Pendulum, (Scheme::EemExplicit, step, 60), &inputs);
    }
    let inputs = self::inputs(|i| [1e-3 * 4.0_f64.powf(i), 310.0, 0.0]);
    check(Thermoelastic, (Scheme::EemExplicit, 0.1, 200), &inputs);
    let inputs = self::inputs(|i| [0.2 + 0.4 * i, 0.0, 0.0]);
    check_outcome(Elastic, (Scheme::EemExplicit, 0.1, 200), &inputs);
}

#[test]
fn scenes_and_schemes_that_do_not_suit_lanes_run_alone() {
    let inputs = inputs(|i| [0.1 * i, 380.0, 10.0]);
    check_outcome(Chain, (Scheme::EemTemperature, 0.02, 5), &inputs);
    check_outcome(Pendulum, (Scheme::Variational4, 0.02, 5), &inputs);
}

#[test]
fn an_experiment_may_depend_on_its_numbers() {
    let inputs = inputs(|i| [0.0, 1.0, -1000.0 - 100.0 * i]);
    // The temperature is 300 K + rate t at the end of a step, and 0 K is refused.
    let expected = |limit: f64| {
        let steps = |input: &Input| ((limit - 300.0) / (input[2] * 0.02)).floor();
        inputs.iter().map(steps).collect::<Vec<_>>()
    };
    for (until, limit) in [(Until::StepFails, 0.5), (Until::Colder(200.5), 200.5)] {
        let results = ensemble(Scheme::EemTemperature, 0.02).run_experiment(&until, &inputs);
        let counts = results.into_iter().map(Result::unwrap);
        let counts: Vec<_> = counts
            .map(|count| f64::from(u32::try_from(count).unwrap()))
            .collect();
        assert_eq!(counts, expected(limit), "{until:?}");
    }
}

#[test]
fn what_never_comes_for_all_at_once_comes_for_each() {
    for turning in [Turning::ByDecision, Turning::ByRecord] {
        let results = ensemble(Scheme::EemEntropy, 0.1).run_experiment(&turning, &[0.5, -0.5]);
        let steps: Vec<_> = results.into_iter().map(Result::unwrap).collect();
        // The momentum falls from its start, in one case to zero a quarter of a period later: with a
        // frequency of 1/s that is after π/2 s, a thousandth later in steps of 0.1 s.
        assert_eq!(steps, [16, 1], "{turning:?}");
    }
}

#[test]
fn the_watch_counts_members() {
    let inputs = inputs(|i| [0.8 + 0.05 * i, 350.0, 2.0]);
    let mut calls = Vec::new();
    let watched = ensemble(Scheme::EemTemperature, 0.2).watch(|done, total| {
        calls.push((done, total));
        ControlFlow::Continue(())
    });
    watched.run_experiment(&Watched::new(Pendulum, 3), &inputs);
    let expected: Vec<_> = (1..=9).map(|done| (done, 9)).collect();
    assert_eq!(calls, expected);
}

#[test]
fn members_that_have_not_begun_can_be_called_off() {
    let inputs = inputs(|i| [0.8 + 0.05 * i, 350.0, 2.0]);
    let watched = ensemble(Scheme::EemTemperature, 0.2).watch(|done, _| match done {
        2.. => ControlFlow::Break(()),
        _ => ControlFlow::Continue(()),
    });
    let results = watched.run_experiment(&Watched::new(Pendulum, 3), &inputs);
    // Those at work finish.
    let finished = if cfg!(feature = "lanes") { 4 } else { 2 };
    for (member, result) in results.into_iter().enumerate() {
        match result {
            Ok(_) => assert!(member < finished),
            Err(error) => {
                assert!(member >= finished);
                assert!(matches!(error.failure, MemberFailure::Stopped));
            }
        }
    }
}
