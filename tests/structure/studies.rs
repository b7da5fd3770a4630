//! Every study keeps the claims that it checks itself, prints no "NaN", keeps the texts of its pictures within them, and
//! refuses options without effect.
//!
//! Running them takes minutes, so that only the gate (`.ci/run`) asks for it.

#![allow(clippy::unwrap_used, reason = "a test: what is missing is a failure")]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::{LazyLock, Mutex};
use std::thread;

const ROOT: &str = env!("CARGO_MANIFEST_DIR");

/// Programs that measure for minutes, and one whose short form is a test program: nobody runs them here.
const NOT_RUN: [&str; 3] = ["cost_tables", "digests", "extremes"];

/// The folder of the studies, built once. Together with this test they have the features of all tests, so that the library
/// is not built again; examples have the names of some of them.
static BUILT: LazyLock<PathBuf> = LazyLock::new(|| {
    let mut command = Command::new(env!("CARGO"));
    command.args(["build", "--quiet", "--locked", "--all-features"]);
    command.args(["--workspace", "--exclude", "eem-examples"]);
    command.args(["--test", "structure"]);
    for name in studies() {
        command.args(["--bin", &name]);
    }
    assert!(command.current_dir(ROOT).status().unwrap().success());
    let target = Path::new(env!("CARGO_TARGET_TMPDIR")).parent().unwrap();
    target.join("debug")
});

/// Runs a study from the folder of the workspace.
fn run(name: &str, arguments: &[&str]) -> Output {
    let mut command = Command::new(BUILT.join(name));
    command.args(arguments).current_dir(ROOT).output().unwrap()
}

/// The studies that are run here, by the names of their files or folders.
fn studies() -> Vec<String> {
    let files = fs::read_dir(Path::new(ROOT).join("studies/src/bin")).unwrap();
    let name = |path: &Path| path.file_stem().unwrap().to_str().unwrap().to_owned();
    let names = files.map(|file| name(&file.unwrap().path()));
    names
        .filter(|name| !NOT_RUN.contains(&name.as_str()))
        .collect()
}

#[test]
#[ignore = "runs studies; the gate asks for it"]
fn options_without_effect_are_refused() {
    for arguments in [["--scheme", "gauss-4"], ["--step", "0.1"]] {
        let output = run("describe", &arguments);
        assert!(!output.status.success(), "{arguments:?}");
        let said = String::from_utf8(output.stderr).unwrap();
        assert!(said.contains(arguments[0]), "{said}");
    }
    let none = run("ensemble", &["--members", "0"]);
    let said = String::from_utf8(none.stderr).unwrap();
    assert!(
        !none.status.success() && said.contains("--members"),
        "{said}"
    );
}

/// With what a study is run: its first seconds, or what else does not take long without optimisation.
fn runs(name: &str) -> &'static [&'static [&'static str]] {
    match name {
        // At rest, so that options about steps have no effect.
        "describe" | "cook" => &[&[]],
        "design_damper" => &[&["--end", "0.5"]],
        "ensemble" => &[&["--end", "2"], &["--end", "1", "--members", "1"]],
        "fit_damper" => &[
            &["--end", "2"],
            &["--end", "1", "--members", "8", "--fits", "2"],
        ],
        "l_block" | "rubber_bearing" => &[&["--end", "1"]],
        "satellite" => &[
            &["--end", "1"],
            &["--end", "0.4", "--aim", "1", "--iterations", "2"],
        ],
        "sweep" => &[&["--end", "2", "run"]],
        _ => &[&["--end", "2"]],
    }
}

/// Those that print all they have.
const WITHOUT_PICTURES: [&str; 3] = ["describe", "paper_tables", "sweep"];

#[test]
#[ignore = "runs studies; the gate asks for it"]
fn studies_keep_their_claims_and_their_pictures_hold_their_texts() {
    let mut left = Vec::new();
    for name in studies() {
        left.extend(runs(&name).iter().map(|&options| (name.clone(), options)));
    }
    assert!(left.len() > 15);
    let left = Mutex::new(left);
    let next = || left.lock().unwrap().pop();
    thread::scope(|scope| {
        for _ in 0..thread::available_parallelism().unwrap().get() {
            scope.spawn(|| {
                while let Some((name, options)) = next() {
                    assert_run(&name, options);
                }
            });
        }
    });
}

/// A run of a study succeeds, which it does if its claims hold, and what it prints and draws can be looked at.
fn assert_run(name: &str, options: &[&str]) {
    let folder = format!("study-{name}{}", options.concat());
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(folder);
    let _ = fs::remove_dir_all(&folder);
    let options = [options, &["--out", folder.to_str().unwrap()]].concat();
    let output = run(name, &options);
    let said = String::from_utf8(output.stdout).unwrap();
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{name}: {said}{errors}");
    assert!(!said.contains("NaN"), "{name}: {said}");
    if WITHOUT_PICTURES.contains(&name) {
        return;
    }
    let mut pictures = 0;
    for file in fs::read_dir(&folder).unwrap() {
        let path = file.unwrap().path();
        if path.extension().is_some_and(|extension| extension == "svg") {
            assert_texts_inside(&path);
            pictures += 1;
        }
    }
    assert!(pictures > 0, "{name} draws nothing");
}

/// Letters are about so wide, in sizes of the font.
const LETTER: f64 = 0.5;

/// No horizontal text of a picture goes beyond its edges, and no coordinate is missing.
fn assert_texts_inside(path: &Path) {
    let drawing = fs::read_to_string(path).unwrap();
    assert!(!drawing.contains("NaN"), "{}", path.display());
    let number = |element: &str, name: &str| {
        let (_, rest) = element.split_once(&format!(" {name}=\"")).unwrap();
        rest.split('"').next().unwrap().parse::<f64>().unwrap()
    };
    let width = number(&drawing, "width");
    let mut texts = 0;
    for element in drawing.split("<text").skip(1) {
        let (head, rest) = element.split_once('>').unwrap();
        let text = rest.split('<').next().unwrap().trim();
        if head.contains("transform") {
            continue;
        }
        let letters = f64::from(u32::try_from(text.chars().count()).unwrap());
        let wide = letters * LETTER * number(head, "font-size");
        let before = match head {
            _ if head.contains("\"middle\"") => 0.5 * wide,
            _ if head.contains("\"end\"") => wide,
            _ => 0.0,
        };
        let left = number(head, "x") - before;
        assert!(
            left >= 0.0 && left + wide <= width,
            "{}: `{text}` from {left} to {} of {width}",
            path.display(),
            left + wide
        );
        texts += 1;
    }
    assert!(texts > 3, "{}", path.display());
}
