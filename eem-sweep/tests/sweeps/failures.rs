//! Members that fail have rows with their errors, and can be run again.

use std::fs;
use std::sync::atomic::{AtomicBool, Ordering};

use eem::prelude::*;
use eem::sweep::{Inputs, Plan, RunOptions, Selection, Sweep};
use eem::{MemberFailure, Scene};

use crate::program::directory;

/// Stones of which the third is refused, the fourth has no row that makes sense, the fifth panics, and the sixth
/// fails unless the weather is fine.
fn stones(weather: &AtomicBool) -> Sweep<'_> {
    let speeds = vec![5.0, 10.0, f64::NAN, -1.0, 30.0, 40.0, 50.0];
    let inputs = Inputs::grid([("speed", speeds)]).unwrap();
    let plan = Plan::new("stones", inputs, Scheme::EemEntropy, 0.1).program("1");
    plan.closures(
        |row| match row.number("speed")? {
            speed if speed < 0.0 => Err(eem::sweep::InputError::refused(
                "thrown into the ground,\nor so",
            )),
            speed => Ok(speed),
        },
        |&speed| {
            let mut scene = Scene::<2>::new();
            let stone = scene.mass(0.5, [0.0, 0.0], [0.0, speed]);
            scene.set_gravity([0.0, -10.0]);
            (scene, stone)
        },
        |run, stone, &speed| {
            assert!(speed.to_bits() != 30.0_f64.to_bits(), "a stone of 30 m/s");
            if speed.to_bits() == 40.0_f64.to_bits() && !weather.load(Ordering::Relaxed) {
                return Err(MemberFailure::other("it \"rains\", says the observer"));
            }
            run.step()?;
            Ok(run.position(stone)?.y)
        },
    )
}

#[test]
fn failures_are_rows_and_a_later_run_supersedes_them() {
    let folder = directory("failures");
    let weather = AtomicBool::new(false);
    let sweep = stones(&weather);
    let report = sweep.run(&folder, &RunOptions::default()).unwrap();
    assert_eq!((report.ran, report.failed), (7, 4));
    let again = sweep.run(&folder, &RunOptions::default()).unwrap();
    assert_eq!((again.ran, again.failed), (0, 4));
    let merged = sweep.merge(&folder, None).unwrap();
    assert_eq!((merged.members, merged.failed), (7, 4));
    let rows = |path| -> Vec<Vec<String>> {
        let mut reader = csv::Reader::from_path(path).unwrap();
        let rows = reader.records().map(Result::unwrap);
        rows.map(|row| row.iter().map(str::to_owned).collect())
            .collect()
    };
    let table = rows(&merged.path);
    let kinds: Vec<&str> = table.iter().map(|row| row[1].as_str()).collect();
    assert_eq!(kinds, ["", "", "scene", "input", "panic", "other", ""]);
    assert_eq!(table[3][5], "thrown into the ground, or so");
    assert_eq!(table[4][5], "a stone of 30 m/s");
    assert_eq!(table[5][5], "it \"rains\", says the observer");
    assert_eq!((table[5][3].as_str(), table[6][2].as_str()), ("", "50.0"));

    // The same in memory, from CSV and from Arrow.
    let mut formats = vec![folder.clone()];
    if cfg!(feature = "arrow") {
        let other = directory("failures-arrow");
        let arrow = RunOptions {
            format: Some(eem::sweep::Format::Arrow),
            ..RunOptions::default()
        };
        sweep.run(&other, &arrow).unwrap();
        formats.push(other);
    }
    for folder in &formats {
        let mut ids = 0..7;
        sweep
            .each(folder, |member, result| {
                let row = &table[usize::try_from(ids.next().unwrap()).unwrap()];
                assert_eq!(member.id().to_string(), row[0]);
                match result {
                    Ok(outputs) => {
                        assert_eq!((row[1].as_str(), cell(outputs)), ("", row[3].clone()));
                    }
                    Err(failure) => {
                        assert_eq!(failure.kind.name(), row[1]);
                        assert_eq!(failure.time.is_some(), !row[4].is_empty());
                        assert_eq!(failure.message, row[5]);
                    }
                }
            })
            .unwrap();
        assert_eq!(ids.next(), None);
    }

    weather.store(true, Ordering::Relaxed);
    let some = RunOptions {
        selection: Selection::Range(4..7),
        ..RunOptions::default()
    };
    let report = sweep.rerun_failed(&folder, &some).unwrap();
    assert_eq!((report.members, report.ran, report.failed), (2, 2, 1));
    let status = sweep.status(&folder).unwrap();
    assert_eq!(
        (status.reported, status.failed, status.superseded),
        (7, 3, 2)
    );
    // The table of the same sweep is replaced, as some of its members were run again.
    let merged = sweep.merge(&folder, None).unwrap();
    assert_eq!(
        (merged.failed, merged.superseded, merged.repeated),
        (3, 2, 0)
    );
    let table = rows(&merged.path);
    // y = v h − g h²/2 with h = 0.1 s.
    assert!((table[5][3].parse::<f64>().unwrap() - 3.95).abs() < 1e-13);
    let report = sweep.rerun_failed(&folder, &RunOptions::default()).unwrap();
    assert_eq!((report.ran, report.failed), (3, 3));
}

#[test]
fn a_step_that_fails_says_when() {
    let folder = directory("failed-step");
    let inputs = Inputs::grid([("limit", vec![0.35, f64::INFINITY])]).unwrap();
    let plan = Plan::new("stones", inputs, Scheme::EemEntropy, 0.1).program("1");
    let sweep = plan.closures(
        |row| row.number("limit"),
        |&limit| {
            let mut scene = Scene::<1>::new();
            let stone = scene.mass(1.0, [0.0], [0.0]);
            let force = move |time: f64| [if time > limit { f64::NAN } else { 1.0 }];
            scene.force(stone, force);
            (scene, ())
        },
        |run, (), _| {
            for _ in 0..10 {
                run.step()?;
            }
            Ok(run.time())
        },
    );
    let report = sweep.run(&folder, &RunOptions::default()).unwrap();
    assert_eq!((report.ran, report.failed), (2, 1));
    let table = fs::read_to_string(sweep.merge(&folder, None).unwrap().path).unwrap();
    let row: Vec<&str> = table.lines().nth(1).unwrap().split(',').collect();
    assert_eq!(row[1], "step");
    let time: f64 = row[4].parse().unwrap();
    assert!((0.2..0.4).contains(&time), "{time}");
}

/// The only output as a cell of a table.
fn cell(outputs: &[f64]) -> String {
    assert_eq!(outputs.len(), 1);
    format!("{:?}", outputs[0])
}
