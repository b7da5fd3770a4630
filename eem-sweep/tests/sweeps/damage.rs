//! What is on the disk is believed only if every bit of it is what was written.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};

use eem::sweep::{Format, Inputs, Plan, RunOptions, Selection, Sweep, SweepError};
use eem::{MemberFailure, Scene, Scheme};

use crate::program::{contents, directory, stones};

const MEMBERS: usize = 20;

/// What `sweep` finds with each byte of a file changed in turn.
fn with_each_byte_changed(path: &Path, mut found: impl FnMut(usize)) {
    let bytes = fs::read(path).unwrap();
    for place in 0..bytes.len() {
        let mut changed = bytes.clone();
        changed[place] ^= 1 << (place % 7);
        fs::write(path, changed).unwrap();
        found(place);
    }
    fs::write(path, bytes).unwrap();
}

fn no_byte_can_change(name: &str, format: Format) {
    let folder = directory(name);
    let sweep = stones(MEMBERS, 1);
    let options = RunOptions {
        batch: Some(7),
        format: Some(format),
        ..RunOptions::default()
    };
    sweep.run(&folder, &options).unwrap();
    let parts: Vec<PathBuf> = contents(&folder.join("parts"))
        .into_iter()
        .map(|(path, _)| path)
        .collect();
    assert_eq!(parts.len(), 3);
    with_each_byte_changed(&parts[1], |place| {
        let errors = [
            sweep.merge(&folder, None).map(drop).unwrap_err(),
            sweep.status(&folder).map(drop).unwrap_err(),
            sweep.run(&folder, &options).map(drop).unwrap_err(),
            sweep.rerun_failed(&folder, &options).map(drop).unwrap_err(),
        ];
        for error in errors {
            let is_it = matches!(&error, SweepError::Damaged { path, .. } if *path == parts[1]);
            assert!(is_it, "byte {place}: {error}");
        }
    });
    with_each_byte_changed(&folder.join("sweep.json"), |place| {
        let error = sweep.run(&folder, &options).unwrap_err();
        let is_it = matches!(error, SweepError::DamagedManifest { .. });
        assert!(is_it, "byte {place}: {error}");
        assert!(error.to_string().contains("move the file away"), "{error}");
    });
    assert_eq!(contents(&folder).len(), 4);
    // Nobody else gets a directory with parts.
    fs::remove_file(folder.join("sweep.json")).unwrap();
    let error = stones(MEMBERS, 2).run(&folder, &options).unwrap_err();
    assert!(matches!(error, SweepError::ForeignPart { .. }), "{error}");
    assert!(!folder.join("sweep.json").exists());
    // The advice is right.
    fs::remove_file(&parts[1]).unwrap();
    assert_eq!(sweep.run(&folder, &options).unwrap().ran, 7);
    sweep.merge(&folder, None).unwrap();
}

#[test]
fn no_byte_of_a_part_or_of_the_manifest_can_change() {
    no_byte_can_change("flipped", Format::Csv);
}

#[test]
#[cfg(feature = "arrow")]
fn no_byte_of_an_arrow_file_can_change() {
    no_byte_can_change("flipped-arrow", Format::Arrow);
}

#[test]
fn a_manifest_without_contents_is_an_error_with_advice() {
    let folder = directory("empty-manifest");
    fs::create_dir_all(&folder).unwrap();
    fs::write(folder.join("sweep.json"), "").unwrap();
    let error = stones(MEMBERS, 1).run(&folder, &RunOptions::default());
    let error = error.unwrap_err();
    assert_eq!(error.exit_code(), 4);
    assert!(error.to_string().contains("move the file away"), "{error}");
}

/// Members that fail in bad weather, and have other bits in a storm.
fn flaky<'a>(fine: &'a AtomicBool, storm: &'a AtomicBool) -> Sweep<'a> {
    let inputs = Inputs::grid([("speed", (1..=9).map(f64::from).collect())]).unwrap();
    let plan = Plan::new("flaky", inputs, Scheme::EemEntropy, 0.1).program("1");
    plan.closures(
        |row| row.number("speed"),
        |&speed| {
            let mut scene = Scene::<1>::new();
            let stone = scene.mass(1.0, [0.0], [speed]);
            (scene, stone)
        },
        |run, stone, _| {
            if !fine.load(Ordering::Relaxed) {
                return Err(MemberFailure::other("rain"));
            }
            run.step()?;
            let gust = f64::from(u8::from(storm.load(Ordering::Relaxed)));
            Ok(run.position(stone)?.x + gust)
        },
    )
}

/// Puts the parts of one directory among those of another.
fn add_parts(from: &Path, to: &Path) {
    for (path, bytes) in contents(&from.join("parts")) {
        fs::write(to.join("parts").join(path.file_name().unwrap()), bytes).unwrap();
    }
}

fn conflict(sweep: &Sweep<'_>, folder: &Path) {
    let error = sweep.merge(folder, None).unwrap_err();
    let SweepError::Conflict { first, second, .. } = &error else {
        panic!("{error}");
    };
    assert!(first != second && first.exists() && second.exists());
    let text = error.to_string();
    assert!(text.contains("Move away the one"), "{text}");
    // The advice is right.
    fs::remove_file(first).unwrap();
    sweep.run(folder, &RunOptions::default()).unwrap();
    sweep.merge(folder, None).unwrap();
}

#[test]
fn parts_of_the_same_members_with_other_bits_are_a_conflict_that_can_be_solved() {
    let (fine, storm) = (AtomicBool::new(true), AtomicBool::new(false));
    let sweep = flaky(&fine, &storm);
    let [one, other] = ["conflict-a", "conflict-b"].map(directory);
    // A list with gaps, and the same in another directory: the same name but for the contents.
    let list = RunOptions {
        selection: Selection::Members(vec![0, 2, 4, 8]),
        batch: Some(4),
        ..RunOptions::default()
    };
    sweep.run(&one, &RunOptions::default()).unwrap();
    sweep.run(&other, &list).unwrap();
    add_parts(&other, &one);
    assert_eq!(sweep.merge(&one, None).unwrap().repeated, 4);
    storm.store(true, Ordering::Relaxed);
    let third = directory("conflict-c");
    sweep.run(&third, &list).unwrap();
    storm.store(false, Ordering::Relaxed);
    fs::remove_dir_all(one.join("parts")).unwrap();
    fs::create_dir(one.join("parts")).unwrap();
    add_parts(&other, &one);
    let missing = RunOptions {
        selection: Selection::Members(vec![1, 3, 5, 6, 7]),
        ..RunOptions::default()
    };
    sweep.run(&one, &missing).unwrap();
    add_parts(&third, &one);
    conflict(&sweep, &one);
}

#[test]
fn two_reruns_at_once_with_other_bits_are_a_conflict_that_can_be_solved() {
    let (fine, storm) = (AtomicBool::new(false), AtomicBool::new(false));
    let sweep = flaky(&fine, &storm);
    let [one, other] = ["reruns-a", "reruns-b"].map(directory);
    sweep.run(&one, &RunOptions::default()).unwrap();
    sweep.run(&other, &RunOptions::default()).unwrap();
    fine.store(true, Ordering::Relaxed);
    let whole = RunOptions {
        batch: Some(9),
        ..RunOptions::default()
    };
    sweep.rerun_failed(&one, &whole).unwrap();
    storm.store(true, Ordering::Relaxed);
    sweep.rerun_failed(&other, &whole).unwrap();
    add_parts(&other, &one);
    conflict(&sweep, &one);
}
