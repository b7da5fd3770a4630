//! What the compiler says about a wrong model, word for word.
//!
//! The folders are those of the catalogue of messages, and `use` is about models where they are
//! used. Almost all text here is ours, so that it depends little on the compiler.
//! `EEM_BLESS=1 cargo test --test ui` writes it anew.
//!
//! The cases are checked against the library that cargo has built for this test. `trybuild` would compile
//! all dependencies again, twice, which took two minutes.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

const ROOT: &str = env!("CARGO_MANIFEST_DIR");

/// All `tests/ui/FOLDER/CASE.rs`, relative to the package, in order.
fn cases() -> Vec<PathBuf> {
    let entries = |folder: &Path| {
        let entries = fs::read_dir(Path::new(ROOT).join(folder)).unwrap();
        let names = entries.map(|entry| folder.join(entry.unwrap().file_name()));
        names.collect::<Vec<_>>()
    };
    let folders = entries(Path::new("tests/ui")).into_iter();
    let mut files: Vec<PathBuf> = folders.flat_map(|folder| entries(&folder)).collect();
    files.retain(|file| file.extension().is_some_and(|extension| extension == "rs"));
    files.sort();
    files
}

/// The library `eem` beside this test. Cargo keeps one per set of features; the messages do not depend
/// on features, and the newest one was built from the present sources.
fn library() -> PathBuf {
    let test = std::env::current_exe().unwrap();
    let beside = fs::read_dir(test.parent().unwrap()).unwrap();
    let libraries = beside.map(|entry| entry.unwrap()).filter(|entry| {
        let file = PathBuf::from(entry.file_name());
        let of_eem = file.to_str().unwrap().starts_with("libeem-");
        of_eem
            && file
                .extension()
                .is_some_and(|extension| extension == "rlib")
    });
    let newest = libraries.max_by_key(|library| library.metadata().unwrap().modified().unwrap());
    newest.expect("no library `eem` beside the test").path()
}

/// Checks a case as cargo would, without generating code.
fn check(case: &Path, library: &Path) -> Output {
    let compiler = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let mut command = Command::new(compiler);
    command
        .current_dir(ROOT)
        .arg(case)
        .args(["--edition=2024", "--crate-type=bin", "--emit=metadata"])
        .args(["-A", "dead_code", "--diagnostic-width=140", "--color=never"])
        .args(["--out-dir", env!("CARGO_TARGET_TMPDIR")])
        .arg("--extern")
        .arg(format!("eem={}", library.display()))
        .arg("-L")
        .arg(format!(
            "dependency={}",
            library.parent().unwrap().display()
        ));
    command.output().unwrap()
}

/// What the compiler has printed, without the lines that count errors and explain codes.
fn messages(output: &Output) -> String {
    let text = str::from_utf8(&output.stderr).unwrap();
    let kept = text.lines().filter(|line| {
        let left_out = [
            "error: aborting due to ",
            "For more information about ",
            "Some errors have detailed explanations:",
        ];
        !left_out.iter().any(|start| line.starts_with(start))
    });
    let lines: Vec<&str> = kept.map(str::trim_end).collect();
    format!("{}\n", lines.join("\n").trim_end())
}

/// What is wrong with a case, in words.
fn judge(case: &Path, library: &Path) -> Option<String> {
    let output = check(case, library);
    let found = messages(&output);
    if output.status.success() {
        return Some(format!("{} compiles", case.display()));
    }
    let file = Path::new(ROOT).join(case.with_extension("stderr"));
    if std::env::var_os("EEM_BLESS").is_some() {
        fs::write(&file, found).unwrap();
        return None;
    }
    let expected = fs::read_to_string(&file).unwrap_or_default();
    let differs = expected.replace("\r\n", "\n") != found;
    differs.then(|| {
        let case = case.display();
        format!("{case}\n\nEXPECTED:\n{expected}\nFOUND:\n{found}")
    })
}

#[test]
fn wrong_models_are_explained() {
    let (cases, library) = (cases(), library());
    assert!(cases.len() >= 100);
    let next = AtomicUsize::new(0);
    let faults = || {
        let one = || cases.get(next.fetch_add(1, Ordering::Relaxed));
        let each = std::iter::from_fn(one);
        each.filter_map(|case| judge(case, &library))
            .collect::<Vec<_>>()
    };
    let threads = thread::available_parallelism().map_or(1, usize::from);
    let faults: Vec<String> = thread::scope(|scope| {
        let running: Vec<_> = (0..threads).map(|_| scope.spawn(faults)).collect();
        let found = running
            .into_iter()
            .flat_map(|thread| thread.join().unwrap());
        found.collect()
    });
    assert!(faults.is_empty(), "{}", faults.join("\n\n"));
}
