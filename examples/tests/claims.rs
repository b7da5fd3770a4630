//! Every example keeps the claims that it checks itself and prints no "NaN".

#![allow(clippy::unwrap_used, reason = "a test: what is missing is a failure")]

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::Command;

const PACKAGE: &str = env!("CARGO_MANIFEST_DIR");

/// Runs a program from the folder of the workspace.
fn keeps_its_claims(program: &str) {
    let mut command = Command::new(program);
    let root = Path::new(PACKAGE).parent().unwrap();
    let output = command.current_dir(root).output().unwrap();
    let said = String::from_utf8(output.stdout).unwrap();
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{said}{errors}");
    assert!(!said.contains("NaN"), "{said}");
}

macro_rules! examples {
    ($($name:ident)*) => {
        const TESTED: &[&str] = &[$(stringify!($name)),*];
        $(
            #[test]
            fn $name() {
                keeps_its_claims(env!(concat!("CARGO_BIN_EXE_", stringify!($name))));
            }
        )*
    };
}

examples! {
    accuracy controller damper double_pendulum ensemble loads_and_events log_stiffness satellite single_pendulum solid spring
}

#[test]
fn every_example_is_tested() {
    let files = fs::read_dir(Path::new(PACKAGE).join("src/bin")).unwrap();
    let name = |path: &Path| path.file_stem().unwrap().to_str().unwrap().to_owned();
    let mut names: BTreeSet<_> = files.map(|file| name(&file.unwrap().path())).collect();
    // Run by the tests of `eem-sweep`.
    assert!(names.remove("sweep"));
    let tested: BTreeSet<_> = TESTED.iter().map(ToString::to_string).collect();
    assert_eq!(names, tested);
}
