//! Studies state errors that are right, refuse those that nobody knows, and recommend what holds when it is run.

use std::ops::ControlFlow;

use eem::prelude::*;
use eem::{
    Advice, EndState, ReferenceEnd, Setting, StateQuantity, Statement, Study, StudyError,
    StudyReport, StudyRow,
};

use crate::support::{DoublePendulum, single_pendulum, single_pendulum_scene};

const END: f64 = 1.0;
const STEP: f64 = 0.05;

fn pendulum() -> Scene<2> {
    single_pendulum_scene().0
}

/// The pendulum with some schemes in steps of 1/20 s, 1/40 s, …, timed once.
fn study(schemes: &[Scheme], halvings: u32) -> Study<'static, 2> {
    study_until(END, schemes, halvings)
}

fn study_until(end: f64, schemes: &[Scheme], halvings: u32) -> Study<'static, 2> {
    let settings = schemes.iter();
    let settings = settings.flat_map(|&scheme| Setting::halved(scheme, STEP, halvings + 1));
    Study::new(pendulum, end).settings(settings).repeats(1)
}

/// All that a report says of errors and laws, as text that tells all doubles apart.
fn bits(report: &StudyReport) -> String {
    let rows = report.rows.iter().map(|row| {
        let statements = StateQuantity::ALL.map(|quantity| row.statement(quantity));
        let laws = [row.energy_defect, row.least_entropy_change].map(f64::to_bits);
        let counts = [row.evaluations, row.iterations as u64, row.steps.into()];
        format!("{} {statements:?} {laws:?} {counts:?}\n", row.setting)
    });
    let rows: String = rows.collect();
    format!("{rows}{:?}", report.reference)
}

#[test]
fn two_runs_give_the_same_errors_bit_for_bit() {
    let schemes = [Scheme::EemEntropy, Scheme::Gauss4];
    let [first, second] = [0, 1].map(|_| study(&schemes, 2).run().unwrap());
    assert_eq!(bits(&first), bits(&second));
    let cells = |report: &StudyReport| {
        let rows = report.csv_rows();
        let rows = rows.map(|row| row[..10].to_vec());
        rows.collect::<Vec<_>>()
    };
    assert_eq!(cells(&first), cells(&second));
}

// At 5 s; at 1 s the two largest parts of the error of p cancel in steps of 6 ms.
#[test]
fn the_orders_of_the_schemes_show() {
    let schemes = [
        (Scheme::Staggered, 1.0),
        (Scheme::EemEntropy, 2.0),
        (Scheme::EemTemperature, 2.0),
        (Scheme::Variational4, 4.0),
        (Scheme::Gauss4, 4.0),
    ];
    let names = schemes.map(|(scheme, _)| scheme);
    let report = study_until(5.0, &names, 4).run().unwrap();
    assert_eq!(report.reference.end, ReferenceEnd::Agreed, "{report}");
    for (scheme, order) in schemes {
        for quantity in StateQuantity::ALL {
            let slope = report.order(scheme, quantity).unwrap();
            assert!((slope - order).abs() < 0.2, "{scheme}, {quantity}: {slope}");
        }
    }
}

// Errors and laws of one row, each found in another way.
#[test]
fn a_row_says_what_its_run_does() {
    let report = study(&[Scheme::EemTemperature], 0).run().unwrap();
    let row = &report.rows[0];
    let [mut run, mut fine] =
        [STEP, STEP / 256.0].map(|step| single_pendulum(Scheme::EemTemperature, step));
    let (mut iterations, mut defect, mut least) = (0, 0.0_f64, f64::INFINITY);
    let start = run.run.ledger();
    let mut entropy = start.entropy;
    for _ in 0..20 {
        iterations += run.run.step().unwrap().iterations;
        let ledger = run.run.ledger();
        defect = defect.max((ledger.balance - start.balance).abs() / start.energy.abs());
        least = least.min(ledger.entropy - entropy);
        entropy = ledger.entropy;
    }
    let norm = |x: &[f64]| x.iter().map(|x| x * x).sum::<f64>().sqrt();
    for _ in 0..20 * 256 {
        fine.run.step().unwrap();
    }
    let reference = &report.reference;
    let (first, step) = (reference.schemes.unwrap()[0], reference.step.unwrap());
    let (_, largest_momentum) = end_of(first, step);
    assert_eq!(
        (row.steps, row.rejected, row.iterations),
        (20, 0, iterations)
    );
    assert!(row.evaluations >= row.iterations as u64 + 20);
    assert_eq!(row.energy_defect.to_bits(), defect.to_bits());
    assert_eq!(row.least_entropy_change.to_bits(), least.to_bits());
    let [values, exact] = [run.row(), fine.row()];
    let length = norm(&exact[0..2]);
    let sizes = [length, largest_momentum, exact[4], length];
    let ranges = [0..2, 2..4, 4..5, 5..6];
    // The fine run of second order is off by 1/256² of it.
    for (quantity, (range, size)) in StateQuantity::ALL
        .into_iter()
        .zip(ranges.into_iter().zip(sizes))
    {
        let error = row.error(quantity).unwrap();
        let parts = range.map(|i| (values[i] - exact[i]).abs() / size);
        let expected = parts.fold(0.0, f64::max);
        assert!(
            (error / expected - 1.0).abs() < 1e-3,
            "{quantity}: {error} {expected}"
        );
    }
    assert!(row.seconds > 0.0 && row.seconds <= row.median_seconds && row.setup_seconds > 0.0);
}

// The motion amplifies a difference by e^(t/τ); after 40 s nothing is left of what two schemes agree on.
#[test]
fn errors_of_a_chaotic_motion_are_refused() {
    let scene = || DoublePendulum::LOGARITHMIC.scene().0;
    let report = Study::new(scene, 40.0)
        .settings([Setting::fixed(Scheme::EemTemperature, 0.1)])
        .repeats(1)
        .refinement(8)
        .run()
        .unwrap();
    let row = &report.rows[0];
    assert!(row.failure.is_none());
    let position = row.statement(StateQuantity::Positions);
    assert!(
        matches!(position, Statement::Refused { doubt, .. } if doubt > 1e-4),
        "{report}"
    );
    assert!(row.energy_defect < 4e-15);
    assert!(report.front().is_empty());
    let recommendation = report.recommend(1e-3).unwrap();
    assert!(matches!(recommendation.advice, Advice::Refused { .. }));
    let words = recommendation.to_string();
    assert!(
        words.starts_with("For errors of at most 0.001: refused. The two references differ by ")
    );
    assert_eq!(report.csv_rows().next().unwrap()[3..5], ["", ""]);
}

#[test]
fn recommendations_can_be_asked_for_some_quantities() {
    let report = study(&[Scheme::EemTemperature], 5).run().unwrap();
    let rows = &report.rows;
    let error = |row: &StudyRow, quantity| row.error(quantity).unwrap();
    let worst = |row| {
        StateQuantity::ALL
            .map(|quantity| error(row, quantity))
            .into_iter()
            .fold(0.0, f64::max)
    };
    // Temperatures of the largest step are more accurate than something else of it.
    let accuracy = 1.1 * error(&rows[0], StateQuantity::Temperatures);
    assert!(worst(&rows[0]) > 2.0 * accuracy);
    let some = report
        .recommend_for(&[StateQuantity::Temperatures], accuracy)
        .unwrap();
    assert!(matches!(some.advice, Advice::Take { .. }));
    assert!(some.to_string().contains("in the temperatures: "), "{some}");
    let Advice::Take { fastest, .. } = report.recommend(accuracy).unwrap().advice else {
        panic!("{report}");
    };
    assert!(worst(fastest) <= accuracy);
    let none = report.recommend_for(&[], 1e-3);
    assert!(matches!(none, Err(StudyError::NoSuchQuantity { .. })));
}

/// The state at the end, and the largest momentum after a step, kg m/s.
fn end_of(scheme: Scheme, step: f64) -> (EndState, f64) {
    let mut run = single_pendulum(scheme, step).run;
    let mut momentum = run.largest_momentum();
    run.run_until_with(END, |run, _| {
        momentum = momentum.max(run.largest_momentum());
        ControlFlow::Continue(())
    })
    .unwrap();
    let end = EndState::of(&run).with_largest_momentum(momentum);
    (end, momentum)
}

#[test]
fn what_is_recommended_holds_when_it_is_run() {
    let schemes = [Scheme::EemEntropy, Scheme::Midpoint, Scheme::Variational4];
    let report = study(&schemes, 5).run().unwrap();
    // A reference of its own: a scheme that is none of the study's, in steps of its own.
    let (exact, _) = end_of(Scheme::Gauss4, END / 3000.0);
    for accuracy in [1e-1, 1e-2, 1e-4] {
        let Advice::Take { fastest, lawful } = report.recommend(accuracy).unwrap().advice else {
            panic!("{report}");
        };
        assert!(lawful.is_none_or(|row| row.setting.scheme == Scheme::EemEntropy));
        for row in [Some(fastest), lawful].into_iter().flatten() {
            let step = row.setting.step().unwrap();
            let mut run = single_pendulum(row.setting.scheme, step).run;
            for _ in 0..row.steps {
                run.step().unwrap();
            }
            assert!((run.time() - END).abs() < 1e-12);
            let end = EndState::of(&run);
            for quantity in StateQuantity::ALL {
                let error = end.difference(&exact, quantity).unwrap();
                assert!(
                    error <= accuracy,
                    "{}: {error} in the {quantity}",
                    row.setting
                );
            }
        }
        // Nothing that is as accurate has been faster.
        let accurate = report.rows.iter().filter(|row| {
            let error = row.largest_error().stated();
            error.is_some_and(|error| error <= 0.99 * accuracy)
        });
        assert!(
            accurate
                .into_iter()
                .all(|row| row.seconds >= fastest.seconds)
        );
    }
    let none = report.recommend(1e-9).unwrap().to_string();
    assert!(
        none.starts_with("For errors of at most 1e-9: no setting reaches it; "),
        "{none}"
    );
}

#[test]
fn nothing_on_the_front_is_beaten() {
    let report = study(&[Scheme::EemEntropy, Scheme::Gauss4], 3)
        .run()
        .unwrap();
    let front = report.front();
    assert!(!front.is_empty());
    for best in &front {
        let error = best.largest_error().stated().unwrap();
        let beaten = report.rows.iter().any(|row| {
            let other = row.largest_error().stated();
            row.seconds < best.seconds && other.is_some_and(|other| other <= error)
        });
        assert!(!beaten, "{}", best.setting);
    }
}

// The table of the README: the trapezoidal rule fails at 15.6 s.
#[test]
fn a_run_that_fails_is_a_row_without_errors() {
    let schemes = [Scheme::Trapezoidal, Scheme::EemEntropy];
    let report = Study::new(pendulum, 20.0)
        .settings(schemes.map(|scheme| Setting::fixed(scheme, 0.2)))
        .repeats(1)
        .run()
        .unwrap();
    let [failed, completed] = [0, 1].map(|row| &report.rows[row]);
    let error = failed.failure.as_ref().unwrap();
    assert!((error.time - 15.6).abs() < 1e-9 && failed.steps == 78);
    assert_eq!(
        failed.statement(StateQuantity::Positions),
        Statement::Absent
    );
    assert!(report.to_string().contains("| failed "));
    assert_eq!(report.csv_rows().next().unwrap()[3..6], ["", "", ""]);
    assert!(completed.failure.is_none() && completed.error(StateQuantity::Momenta).is_some());
    assert_eq!(report.front(), [completed]);
}

#[test]
fn references_can_be_given() {
    let states = [Scheme::Gauss4, Scheme::Variational4].map(|scheme| end_of(scheme, STEP / 64.0).0);
    let given = study(&[Scheme::EemEntropy], 1)
        .reference(states.clone())
        .run()
        .unwrap();
    let found = study(&[Scheme::EemEntropy], 1).run().unwrap();
    assert_eq!(given.reference.end, ReferenceEnd::Given);
    for (own, other) in given.rows.iter().zip(&found.rows) {
        for quantity in StateQuantity::ALL {
            let [own, other] = [own, other].map(|row| row.error(quantity).unwrap());
            assert!((own / other - 1.0).abs() < 0.01);
        }
    }
    let other = EndState::of(&DoublePendulum::ROMERO.simulation(Scheme::Gauss4, 0.1).run);
    let [first, _] = states;
    let refused = study(&[Scheme::EemEntropy], 0)
        .reference([first, other])
        .run();
    let error = refused.unwrap_err();
    assert_eq!(
        error.to_string(),
        "reference 1 has 6 values for the positions of the state, the scene has 2; take it from a simulation of \
         the same scene"
    );
}

#[test]
fn progress_reaches_what_was_planned() {
    let mut seen = Vec::new();
    let watched = study(&[Scheme::EemEntropy], 1).watch(|done, planned| {
        seen.push((done, planned));
        ControlFlow::Continue(())
    });
    watched.run().unwrap();
    assert!(seen.is_sorted() && seen.len() >= 3);
    let (done, planned) = *seen.last().unwrap();
    assert_eq!(done, planned);
}

#[test]
fn a_study_ends_when_the_function_that_watches_it_says_so() {
    // After a run of the two settings, one that is timed, and those of the references.
    for last in [1, 3, 5] {
        let mut calls = 0;
        let stopped = study(&[Scheme::EemEntropy], 1).watch(|_, _| {
            calls += 1;
            if calls == last {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        });
        assert_eq!(stopped.run().unwrap_err(), StudyError::Stopped);
        assert_eq!(calls, last);
    }
}

#[test]
fn a_study_ends_within_a_run() {
    let steps = 2_000_000_000_u32;
    let mut seen = 0;
    let setting = Setting::fixed(Scheme::EemEntropy, 0.01);
    let endless = Study::new(pendulum, 0.01 * f64::from(steps)).setting(setting);
    let stopped = endless.watch(|done, _| {
        seen = done;
        ControlFlow::Break(())
    });
    assert_eq!(stopped.run().unwrap_err(), StudyError::Stopped);
    assert!(seen > 0 && seen < u64::from(steps));
}

// What is refused says what to do.

/// The message of a study that is not begun.
fn refusal(study: Study<'_, 2>) -> String {
    study.run().unwrap_err().to_string()
}

#[test]
fn a_step_is_positive() {
    for step in [0.0, -0.1, f64::NAN, f64::INFINITY] {
        let study = Study::new(pendulum, END).setting(Setting::fixed(Scheme::EemEntropy, step));
        let text = format!(
            "a step of {step} s is not positive and finite; choose a step between 0 and the end time"
        );
        assert_eq!(refusal(study), text);
    }
}

#[test]
fn the_end_lies_after_the_start() {
    for end in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let study = Study::new(pendulum, end).setting(Setting::fixed(Scheme::EemEntropy, STEP));
        let text = format!(
            "the end time of {end} s does not lie after the start at 0 s; choose a positive, finite end time"
        );
        assert_eq!(refusal(study), text);
    }
}

#[test]
fn there_are_settings() {
    let text = "the study has no settings; add some with `setting` or `settings`";
    assert_eq!(refusal(Study::new(pendulum, END)), text);
}

#[test]
fn a_whole_number_of_steps_hits_the_end() {
    let study =
        |step, end| Study::new(pendulum, end).setting(Setting::fixed(Scheme::EemEntropy, step));
    let text = "no whole number of steps of 0.3 s ends at 1 s; take 0.25 s or 0.3333333333333333 s";
    assert_eq!(refusal(study(0.3, 1.0)), text);
    let error = study(5.0, 1.0).run().unwrap_err();
    let StudyError::NoWholeSteps {
        shorter, longer, ..
    } = error
    else {
        panic!("{error}");
    };
    assert_eq!([shorter, longer].map(f64::to_bits), [1.0_f64.to_bits(); 2]);
    // What is proposed is taken, although neither step nor end is a double.
    assert!(study(1.0 / 3.0, 1.0).repeats(1).run().is_ok());
    assert!(study(0.1, 0.3).repeats(1).run().is_ok());
}

#[test]
fn more_is_refused_than_can_be_counted_judged_or_built() {
    let study = |step| Study::new(pendulum, END).setting(Setting::fixed(Scheme::EemEntropy, step));
    assert!(matches!(
        study(1e-300).run(),
        Err(StudyError::TooManySteps { .. })
    ));
    for accuracy in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let refused = study(STEP).accuracies([accuracy]).run();
        assert!(matches!(refused, Err(StudyError::Accuracy { .. })));
    }
    let broken = || {
        let mut scene = pendulum();
        scene.mass(-1.0, [0.0; 2], [0.0; 2]);
        scene
    };
    let refused = Study::new(broken, END).setting(Setting::fixed(Scheme::EemEntropy, STEP));
    assert!(matches!(refused.run(), Err(StudyError::Scene { .. })));
}
