//! Merging: what it may replace, what it must not touch, and what it needs.

use std::fs::{self, File};
use std::path::Path;
use std::time::{Duration, SystemTime};

use eem::sweep::{RunOptions, Selection, SweepError};

use crate::program::{directory, ended, finish, stones, with_files};

const MEMBERS: usize = 20;

fn read(path: &Path) -> Vec<u8> {
    fs::read(path).unwrap()
}

#[test]
fn who_is_at_work_on_a_member_that_is_given_up_supersedes_it() {
    let [folder, other] = ["given-up-alive", "given-up-other"].map(directory);
    let sweep = stones(MEMBERS, 1);
    let some = |range| RunOptions {
        selection: Selection::Range(range),
        ..RunOptions::default()
    };
    sweep.run(&folder, &some(0..19)).unwrap();
    sweep.give_up(&folder, &Selection::All).unwrap();
    // Its record comes when it has been given up.
    sweep.run(&other, &some(19..20)).unwrap();
    for part in fs::read_dir(other.join("parts")).unwrap() {
        let part = part.unwrap();
        fs::copy(part.path(), folder.join("parts").join(part.file_name())).unwrap();
    }
    let merged = sweep.merge(&folder, None).unwrap();
    assert_eq!((merged.failed, merged.superseded), (0, 1));
}

#[test]
fn runs_of_what_has_failed_keep_notes_of_what_is_missing() {
    let folder = directory("notes-of-others");
    let sweep = stones(MEMBERS, 1);
    let options = RunOptions {
        selection: Selection::Range(0..10),
        ..RunOptions::default()
    };
    sweep.run(&folder, &options).unwrap();
    let note = folder.join("progress/all.1-0123456789abcdef.begun");
    fs::write(&note, r#"[{"start":15,"end":16}]"#).unwrap();
    sweep.rerun_failed(&folder, &RunOptions::default()).unwrap();
    assert_eq!(sweep.status(&folder).unwrap().begun, "15");
    sweep.run(&folder, &RunOptions::default()).unwrap();
    assert!(!note.exists());
}

#[test]
fn a_sweep_that_can_only_be_read_is_merged_elsewhere() {
    let [folder, elsewhere] = ["read-only-sweep", "read-only-table"].map(directory);
    let sweep = stones(MEMBERS, 1);
    sweep.run(&folder, &RunOptions::default()).unwrap();
    // Nothing can be noted there.
    fs::write(folder.join("tables"), "").unwrap();
    fs::create_dir_all(&elsewhere).unwrap();
    sweep.merge(&folder, None).unwrap_err();
    let table = elsewhere.join("table.csv");
    sweep.merge(&folder, Some(&table)).unwrap();
    let again = sweep.merge(&folder, Some(&table)).unwrap_err();
    assert!(matches!(again, SweepError::Exists { .. }), "{again}");
}

#[test]
#[cfg(unix)]
fn a_link_to_nowhere_is_not_replaced() {
    let folder = directory("dangling");
    let sweep = stones(MEMBERS, 1);
    sweep.run(&folder, &RunOptions::default()).unwrap();
    let table = folder.join("merged.csv");
    std::os::unix::fs::symlink("nowhere", &table).unwrap();
    let refused = sweep.merge(&folder, None).unwrap_err();
    assert!(matches!(refused, SweepError::Exists { .. }), "{refused}");
    assert!(fs::symlink_metadata(&table).unwrap().is_symlink());
}

#[test]
fn a_merge_that_was_killed_anywhere_can_be_repeated() {
    let folder = directory("merged-twice");
    let sweep = stones(MEMBERS, 1);
    let most = RunOptions {
        selection: Selection::Range(0..19),
        ..RunOptions::default()
    };
    sweep.run(&folder, &most).unwrap();
    sweep.give_up(&folder, &Selection::All).unwrap();
    let first = sweep.merge(&folder, None).unwrap();
    let (path, note) = (first.path.clone(), folder.join("merged.csv.json"));
    let (table, noted) = (read(&path), read(&note));
    sweep.rerun_failed(&folder, &RunOptions::default()).unwrap();
    let second = sweep.merge(&folder, None).unwrap();
    assert!((first.failed, second.failed) == (1, 0) && first.table != second.table);
    let (newer, newer_note) = (read(&path), read(&note));

    // Killed before the note, or before the table, which is the older one or none.
    fs::write(&note, &noted).unwrap();
    assert_eq!(sweep.merge(&folder, None).unwrap(), second);
    assert!(read(&note) == newer_note);
    fs::write(&path, &table).unwrap();
    assert_eq!(sweep.merge(&folder, None).unwrap(), second);
    fs::remove_file(&path).unwrap();
    assert_eq!(sweep.merge(&folder, None).unwrap(), second);
    // Killed between taking the name and filling it, on a file system without hard links.
    fs::write(&path, "").unwrap();
    assert_eq!(sweep.merge(&folder, None).unwrap(), second);
    // The note was lost.
    fs::write(&path, &table).unwrap();
    fs::remove_file(&note).unwrap();
    assert_eq!(sweep.merge(&folder, None).unwrap(), second);
    assert!(read(&path) == newer);

    // A table that somebody has changed is not this sweep's any more, whatever its note says.
    fs::write(&note, &newer_note).unwrap();
    fs::write(&path, "mine").unwrap();
    let refused = sweep.merge(&folder, None).unwrap_err();
    assert!(matches!(refused, SweepError::Exists { .. }), "{refused}");
    assert!(read(&path) == b"mine" && read(&note) == newer_note);
}

#[test]
#[cfg(unix)]
fn a_directory_needs_no_name_in_unicode() {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt;

    let folder = directory("bytes").join(OsStr::from_bytes(b"M\xe4rz"));
    let sweep = stones(MEMBERS, 1);
    sweep.run(&folder, &RunOptions::default()).unwrap();
    let first = sweep.merge(&folder, None).unwrap();
    assert!(read(&folder.join("merged.csv.json")).starts_with(b"{\n  \"sweep\""));
    assert_eq!(sweep.merge(&folder, None).unwrap(), first);
}

#[test]
fn a_merge_removes_what_is_dead_and_leaves_what_may_be_alive() {
    let folder = directory("temporaries");
    let sweep = stones(MEMBERS, 1);
    sweep.run(&folder, &RunOptions::default()).unwrap();
    let elsewhere = folder.join("mine");
    fs::create_dir(&elsewhere).unwrap();
    let names = [
        "parts/.0000000000-0000000003.4.g0.0123456789abcdef.0123456789abcdef.csv",
        ".sweep.json",
        "mine/.mine.csv",
        "progress/.all.json",
    ];
    let write = |name: &str, hours: u64| {
        let path = folder.join(format!("{name}.12-0123456789abcde{hours}.tmp"));
        fs::write(&path, "torn").unwrap();
        let file = File::options().write(true).open(&path).unwrap();
        let age = Duration::from_secs(3600 * hours);
        file.set_modified(SystemTime::now() - age).unwrap();
        path
    };
    let old = names.map(|name| write(name, 2));
    let young = names.map(|name| write(name, 0));
    let table = elsewhere.join("mine.csv");
    sweep.merge(&folder, Some(&table)).unwrap();
    assert!(old.iter().all(|path| !path.exists()));
    assert!(young.iter().all(|path| path.exists()));
}

#[test]
fn a_table_goes_to_a_file_that_is_none_of_the_sweep() {
    let folder = directory("into");
    let sweep = stones(MEMBERS, 1);
    sweep.run(&folder, &RunOptions::default()).unwrap();
    sweep.merge(&folder, None).unwrap();
    let refused = |into: &str| {
        let error = sweep.merge(&folder, Some(&folder.join(into))).unwrap_err();
        assert_eq!(error.exit_code(), 2);
        assert!(error.to_string().contains("with --into"), "{error}");
        error
    };
    for into in [
        "parts/table.csv",
        "tables/x.csv",
        "progress/../parts/x",
        "progress/x.csv",
    ] {
        let error = refused(into);
        assert!(matches!(error, SweepError::OwnFolder { .. }), "{error}");
    }
    assert!(matches!(refused("parts"), SweepError::NoFile { .. }));
    // A pipe that nobody reads.
    if cfg!(unix) {
        let pipe = folder.join("pipe");
        let made = std::process::Command::new("mkfifo").arg(&pipe).status();
        assert!(made.unwrap().success());
        assert!(matches!(refused("pipe"), SweepError::NoFile { .. }));
        fs::rename(&pipe, folder.join("merged.csv.json")).unwrap();
        let error = sweep.merge(&folder, None).unwrap_err();
        assert!(error.to_string().contains("no regular file"), "{error}");
    }
}

#[test]
#[cfg(unix)]
fn parts_of_lists_with_gaps_need_no_open_files() {
    let folder = directory("strided");
    let (members, strides) = (240, 60);
    let sweep = stones(members, 1);
    for first in 0..strides {
        let list = (first..members as u64).step_by(60).collect();
        let options = RunOptions {
            selection: Selection::Members(list),
            threads: 1,
            batch: Some(4),
            ..RunOptions::default()
        };
        assert_eq!(sweep.run(&folder, &options).unwrap().ran, 4);
    }
    let dir = folder.to_str().unwrap();
    let line = ["240", "1", "merge", "--dir", dir];
    let (code, said) = ended(with_files(30, &line));
    assert_eq!(code, 0, "{said}");
    let whole = directory("strided-whole");
    sweep.run(&whole, &RunOptions::default()).unwrap();
    let whole = sweep.merge(&whole, None).unwrap();
    assert!(read(&folder.join("merged.csv")) == read(&whole.path));
}

#[test]
fn members_that_do_not_exist_are_an_error_of_the_line() {
    let folder = directory("beyond");
    let dir = folder.to_str().unwrap();
    for (selection, says) in [
        (
            ["--range", "20..30"],
            "no member has an id from 20 to below 30; ids go from 0 to 19",
        ),
        (["--shard", "0/0"], "a sweep has one shard at least"),
        (["--members", "20"], "there is no member 20"),
        (["--batch", "0"], "--batch"),
    ] {
        let line = [&["20", "1", "run", "--dir", dir], &selection[..]].concat();
        let (code, said) = finish(&line);
        assert!(code == 2 && said.contains(says), "{code}: {said}");
    }
    assert!(!folder.exists());
}
