//! What is wrong with a directory, a shard or a program is a typed error that says what to do, and nothing is
//! overwritten.

use std::fs;

use eem::Scheme;
use eem::sweep::{Inputs, Plan, RunOptions, Selection, Sweep, SweepError};

use crate::program::{STEP, Stone, contents, directory, inputs, plan, stones};

const MEMBERS: usize = 20;

fn sweep(plan: Plan) -> Sweep<'static> {
    Stone { steps: 1 }.sweep(plan, |row| {
        Ok([row.number("stiffness")?, row.number("speed")?])
    })
}

fn shard(index: u64) -> RunOptions {
    RunOptions {
        selection: Selection::Shard { index, count: 2 },
        ..RunOptions::default()
    }
}

#[test]
fn shards_of_another_program_inputs_or_settings_are_refused() {
    let folder = directory("different");
    stones(MEMBERS, 1).run(&folder, &shard(0)).unwrap();
    let before = contents(&folder);
    let others = [
        (
            "program is 1 there and 2 here",
            sweep(plan(MEMBERS, 1).program("2")),
        ),
        ("an executable with digest", {
            let plan = Plan::new("stones", inputs(MEMBERS), Scheme::EemEntropy, STEP);
            sweep(plan.setting("steps", 1))
        }),
        (
            "setting `steps` is 1 there and 2 here",
            sweep(plan(MEMBERS, 1).setting("steps", 2)),
        ),
        (
            "setting `end` is absent there",
            sweep(plan(MEMBERS, 1).setting("end", 3.5)),
        ),
        (
            "setting `scheme` is absent there and new here",
            sweep(plan(MEMBERS, 1).setting("scheme", "new")),
        ),
        (
            "number of members is 20 there and 21 here",
            sweep(plan(MEMBERS + 1, 1)),
        ),
        ("digest of inputs", {
            let columns = [("stiffness", 100.0..900.0), ("speed", -1.0..1.0)];
            let inputs = Inputs::latin_hypercube(MEMBERS, 8, columns).unwrap();
            let plan = Plan::new("stones", inputs, Scheme::EemEntropy, STEP);
            sweep(plan.setting("steps", 1).program("1"))
        }),
        ("scheme is eem-entropy there and midpoint here", {
            let plan = Plan::new("stones", inputs(MEMBERS), Scheme::Midpoint, STEP);
            sweep(plan.setting("steps", 1).program("1"))
        }),
    ];
    for (says, other) in others {
        let attempts = [
            other.run(&folder, &shard(1)).unwrap_err(),
            other.rerun_failed(&folder, &shard(1)).unwrap_err(),
            other.status(&folder).unwrap_err(),
            other.merge(&folder, None).unwrap_err(),
        ];
        for error in attempts {
            assert!(matches!(error, SweepError::Different { .. }), "{error}");
            assert_eq!(error.exit_code(), 4);
            let text = error.to_string();
            assert!(
                text.contains(says) && text.contains("Take another directory"),
                "{text}"
            );
        }
    }
    assert!(contents(&folder) == before);
}

#[test]
fn a_merge_of_what_is_not_complete_says_what_is_missing() {
    let folder = directory("incomplete");
    let sweep = stones(MEMBERS, 1);
    let nothing = sweep.merge(&folder, None).unwrap_err();
    assert!(matches!(nothing, SweepError::NoSweep { .. }), "{nothing}");
    assert!(!folder.exists());
    sweep.run(&folder, &shard(1)).unwrap();
    let error = sweep.merge(&folder, None).unwrap_err();
    assert_eq!(error.exit_code(), 6);
    assert!(
        error.to_string().contains("lacks 10 of 20 members: 0-9"),
        "{error}"
    );
    assert!(!folder.join("merged.csv").exists());
}

#[test]
fn tables_of_others_are_not_overwritten() {
    let folder = directory("exists");
    let sweep = stones(MEMBERS, 1);
    sweep.run(&folder, &RunOptions::default()).unwrap();
    let table = folder.join("results.csv");
    fs::write(&table, "mine").unwrap();
    let error = sweep.merge(&folder, Some(&table)).unwrap_err();
    assert!(matches!(error, SweepError::Exists { .. }), "{error}");
    assert_eq!(fs::read_to_string(&table).unwrap(), "mine");
    // The name of the note beside the table is that of the manifest.
    let manifest = fs::read(folder.join("sweep.json")).unwrap();
    let error = sweep.merge(&folder, Some(&folder.join("sweep")));
    assert!(matches!(error, Err(SweepError::Exists { .. })), "{error:?}");
    assert_eq!(fs::read(folder.join("sweep.json")).unwrap(), manifest);
    // What it has merged itself may be there.
    let first = sweep.merge(&folder, None).unwrap();
    assert_eq!(sweep.merge(&folder, None).unwrap(), first);
}

#[test]
fn parts_that_are_foreign_damaged_or_contradict_are_found() {
    let folder = directory("damaged");
    let sweep = stones(MEMBERS, 1);
    sweep
        .run(
            &folder,
            &RunOptions {
                batch: Some(5),
                ..RunOptions::default()
            },
        )
        .unwrap();
    let whole = contents(&folder.join("parts"));
    assert_eq!(whole.len(), 4);
    let (path, bytes) = &whole[1];
    let name = path.file_name().unwrap().to_str().unwrap();
    let found = |says: &str| {
        let error = sweep.merge(&folder, None).unwrap_err();
        assert!(error.to_string().contains(says), "{error}");
        assert_eq!(error.exit_code(), 4);
        assert!(!folder.join("merged.csv").exists());
    };
    // Torn, as no kill can leave it, but a copy may be; with a digit that has changed; something else.
    let digit = bytes.len() - 4;
    let mut flipped = bytes.clone();
    flipped[digit] ^= 1;
    for wrong in [&bytes[..bytes.len() - 3], &flipped, b"a,b\n1,2\n", b""] {
        fs::write(path, wrong).unwrap();
        found("is damaged: its contents are not those that its name says; move it away");
    }
    fs::write(path, bytes).unwrap();
    // With another generation, other members, another format in its name.
    for (from, to) in [(".g1.", ".g2."), ("-0000000009.5", "-0000000008.4")] {
        let other = path.with_file_name(name.replace(from, to));
        fs::rename(path, &other).unwrap();
        let says = if from == ".g1." {
            "contents"
        } else {
            "lacks 1 of 20"
        };
        let error = sweep.merge(&folder, None).unwrap_err().to_string();
        assert!(error.contains(says), "{error}");
        fs::rename(&other, path).unwrap();
    }
    let other = path.with_extension("arrow");
    fs::rename(path, &other).unwrap();
    found("its name does not end in `csv`");
    fs::rename(&other, path).unwrap();
    // A part of another sweep.
    let digest = name.split('.').nth(3).unwrap();
    let foreign = path.with_file_name(name.replace(digest, "0123456789abcdef"));
    fs::write(&foreign, bytes).unwrap();
    found("belongs to the sweep 0123456789abcdef");
    fs::remove_file(foreign).unwrap();
    // Other files are nobody's business.
    fs::write(path.with_file_name("notes.txt"), "x").unwrap();
    sweep.merge(&folder, None).unwrap();
}

#[test]
fn a_place_that_cannot_be_written_is_named() {
    let folder = directory("read-only");
    fs::create_dir_all(&folder).unwrap();
    let file = folder.join("file");
    fs::write(&file, "").unwrap();
    let sweep = stones(MEMBERS, 1);
    let error = sweep.run(&file, &RunOptions::default()).unwrap_err();
    assert_eq!(error.exit_code(), 5);
    assert!(
        error
            .to_string()
            .contains("choose another directory with --dir"),
        "{error}"
    );
    // A directory of the system that even root cannot write.
    if cfg!(target_os = "linux") {
        let error = sweep
            .run("/proc/eem".as_ref(), &RunOptions::default())
            .unwrap_err();
        assert_eq!(error.exit_code(), 5);
        assert!(error.to_string().contains("/proc/eem"), "{error}");
    }
}

#[test]
fn a_column_that_is_not_there_is_an_error_of_the_sweep() {
    let folder = directory("columns");
    let of = |columns: [&str; 2]| {
        let inputs = Inputs::rows(columns, [[100.0, 0.0]]).unwrap();
        sweep(Plan::new("stones", inputs, Scheme::EemEntropy, STEP).program("1"))
    };
    let error = of(["stiffness", "velocity"])
        .run(&folder, &RunOptions::default())
        .unwrap_err();
    assert_eq!(
        error.to_string(),
        "there is no input column `speed`; there are: stiffness, velocity"
    );
    let inputs = Inputs::rows(["stiffness", "speed", "height (m)"], [[100.0, 0.0, 1.0]]).unwrap();
    let twice = sweep(Plan::new("stones", inputs, Scheme::EemEntropy, STEP).program("1"));
    let error = twice.run(&folder, &RunOptions::default()).unwrap_err();
    assert!(
        error.to_string().contains("two columns `height (m)`"),
        "{error}"
    );
    for name in ["stiffness\n", "\rspeed"] {
        let inputs = Inputs::rows(["stiffness", "speed", name], [[1.0, 0.0, 1.0]]).unwrap();
        let lines = sweep(Plan::new("stones", inputs, Scheme::EemEntropy, STEP).program("1"));
        let error = lines.run(&folder, &RunOptions::default()).unwrap_err();
        assert!(error.to_string().contains(&format!("{name:?}")), "{error}");
    }
    assert!(!folder.exists());
}
