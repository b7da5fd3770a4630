//! Files of checkpoints keep every bit, and are refused where they have lost one.

use std::fs;
use std::path::PathBuf;

use eem::prelude::*;
use eem::{FormatError, LoadError};
use eem_testkit::length::at_length;

use crate::support::{busy, single_pendulum_scene};

/// A file of this process that is removed at the end.
struct Temporary(PathBuf);

impl Temporary {
    fn new(name: &str) -> Self {
        let name = format!("eem-{name}-{}.checkpoint", std::process::id());
        Self(std::env::temp_dir().join(name))
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        _ = fs::remove_file(&self.0);
    }
}

/// A checkpoint after some steps is the same from a file, and a run goes on from it with the same bits.
fn assert_survives<const D: usize>(build: impl Fn() -> Simulation<D>, file: &Temporary) {
    let mut run = build();
    for _ in 0..5 {
        run.step().unwrap();
    }
    let saved = run.checkpoint();
    saved.save(&file.0).unwrap();
    let loaded = Checkpoint::load(&file.0).unwrap();
    assert_eq!(loaded, saved);
    assert_eq!(format!("{loaded:?}"), format!("{saved:?}"));
    let mut resumed = build();
    resumed.restore(&loaded).unwrap();
    for run in [&mut run, &mut resumed] {
        run.step().unwrap();
    }
    assert_eq!(
        format!("{:?}", resumed.checkpoint()),
        format!("{:?}", run.checkpoint())
    );
}

#[test]
fn checkpoints_keep_every_bit_in_a_file() {
    let file = Temporary::new("bits");
    for scheme in Scheme::ALL.into_iter().chain([Scheme::Auto]) {
        assert_survives(|| Simulation::new(busy(), scheme, 0.01).unwrap(), &file);
        if scheme.may_change_steps() {
            let controlled = || {
                let mut run = Simulation::new(busy(), scheme, 0.01).unwrap();
                run.control_steps(Tolerance::new(1e-4)).unwrap();
                run
            };
            assert_survives(controlled, &file);
        }
    }
}

#[test]
fn a_file_that_lost_something_is_refused() {
    let file = Temporary::new("damaged");
    let mut run = Simulation::new(busy(), Scheme::EemExplicit, 0.01).unwrap();
    run.step().unwrap();
    run.checkpoint().save(&file.0).unwrap();
    let whole = fs::read(&file.0).unwrap();
    let fault = |bytes: &[u8]| {
        fs::write(&file.0, bytes).unwrap();
        match Checkpoint::load(&file.0) {
            Err(LoadError::Format { path, source }) => {
                assert_eq!(path, file.0);
                source
            }
            other => panic!("{other:?}"),
        }
    };
    let head = whole.iter().position(|&byte| byte == b'\n').unwrap();
    // The head, and all kinds of places behind it.
    let places = || (0..head).chain((head..whole.len()).step_by(at_length(1, 7)));
    for end in places() {
        let found = fault(&whole[..end]);
        let expected = if end <= head {
            FormatError::Kind
        } else {
            FormatError::Digest
        };
        assert_eq!(found, expected, "cut off after {end} bytes");
    }
    for at in places() {
        for change in [1, 0x80] {
            let mut edited = whole.clone();
            edited[at] ^= change;
            _ = fault(&edited);
        }
    }
    let twice = [&whole[..], &whole[..]].concat();
    assert_eq!(fault(&twice), FormatError::Digest);
    fs::write(&file.0, &whole).unwrap();
    assert!(Checkpoint::load(&file.0).is_ok());
}

#[test]
fn other_files_are_refused_with_what_they_are() {
    let file = Temporary::new("other");
    let (scene, ..) = single_pendulum_scene();
    let run = Simulation::new(scene, Scheme::EemEntropy, 0.01).unwrap();
    run.checkpoint().save(&file.0).unwrap();
    let text = fs::read_to_string(&file.0).unwrap();
    fs::write(&file.0, text.replacen("checkpoint 1", "checkpoint 2", 1)).unwrap();
    let message = Checkpoint::load(&file.0).unwrap_err().to_string();
    assert!(message.contains("the version `2` of the format, this library reads version 1"));

    fs::write(&file.0, "time,q\n0,1\n").unwrap();
    let message = Checkpoint::load(&file.0).unwrap_err().to_string();
    assert!(message.contains("does not begin with `eem checkpoint`"));
}

#[test]
fn a_file_is_complete_or_as_it_was() {
    let run = Simulation::new(busy(), Scheme::EemEntropy, 0.01).unwrap();
    // A folder is in the way.
    let folder = std::env::temp_dir().join(format!("eem-folder-{}", std::process::id()));
    fs::create_dir_all(folder.join("inside")).unwrap();
    assert!(run.checkpoint().save(&folder).is_err());
    assert!(folder.join("inside").is_dir());
    let name = folder.file_name().unwrap().to_str().unwrap().to_owned();
    let left = fs::read_dir(std::env::temp_dir()).unwrap();
    let left = left.filter(|entry| {
        let found = entry.as_ref().unwrap().file_name();
        found
            .to_str()
            .is_some_and(|found| found.starts_with(&name) && found != name)
    });
    assert_eq!(left.count(), 0);
    fs::remove_dir_all(folder).unwrap();
}
