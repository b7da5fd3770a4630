//! What examples print and draw where there is little to say: no "NaN", no text beyond the edge of its picture, and an
//! error for options without effect.
//!
//! Running them takes some seconds, so that only the gate (`.ci/run`) asks for it.

#![allow(clippy::unwrap_used, reason = "a test: what is missing is a failure")]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// Runs an example.
fn example(name: &str, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO"));
    // With the features that the gate has built it with.
    command.args(["run", "--quiet", "-p", "eem", "--example", name, "--"]);
    command
        .args(arguments)
        .current_dir(env!("CARGO_MANIFEST_DIR"));
    command.output().unwrap()
}

/// An empty folder for what an example writes.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("example-{name}"));
    let _ = fs::remove_dir_all(&folder);
    folder
}

#[test]
#[ignore = "runs examples; the gate asks for it"]
fn options_without_effect_are_refused() {
    for arguments in [["--scheme", "gauss-4"], ["--step", "0.1"]] {
        let output = example("describe", &arguments);
        assert!(!output.status.success(), "{arguments:?}");
        let said = String::from_utf8(output.stderr).unwrap();
        assert!(said.contains(arguments[0]), "{said}");
    }
    let none = example("ensemble", &["--members", "0"]);
    let said = String::from_utf8(none.stderr).unwrap();
    assert!(
        !none.status.success() && said.contains("--members"),
        "{said}"
    );
}

#[test]
#[ignore = "runs examples; the gate asks for it"]
fn pictures_hold_their_texts_and_tables_their_numbers() {
    for (name, options) in [
        ("ensemble", &["--members", "1"][..]),
        ("single_pendulum", &[]),
        ("double_pendulum", &[]),
        ("log_stiffness", &[]),
        ("shock_absorber", &[]),
        ("fit_damper", &["--members", "8", "--fits", "2"]),
        ("l_block", &[]),
        ("satellite", &["--scheme", "eem-entropy"]),
        ("rubber_bearing", &[]),
        ("cook", &[]),
    ] {
        let folder = folder(name);
        let out = folder.to_str().unwrap();
        // What is at rest has no end.
        let end: &[&str] = if name == "cook" { &[] } else { &["--end", "1"] };
        let output = example(name, &[end, &["--out", out], options].concat());
        let said = String::from_utf8(output.stdout).unwrap();
        assert!(output.status.success(), "{name}: {said}");
        assert!(!said.contains("NaN"), "{name}: {said}");
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
