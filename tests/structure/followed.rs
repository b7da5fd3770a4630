//! The programs of README and pages, copied from the Markdown into crates outside of the workspace.
//!
//! They are built and run, and what they print is compared with the page. Building takes a minute, so that
//! these tests are ignored in an ordinary run; the gate (`.ci/run`) asks for them.

#![allow(clippy::unwrap_used, reason = "a test: what is missing is a failure")]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

const ROOT: &str = env!("CARGO_MANIFEST_DIR");
/// A folder in the one that the workspace builds in.
const TEMPORARY: &str = env!("CARGO_TARGET_TMPDIR");

/// A fenced block: its language, its text, and the prose between the block before and this one.
struct Block<'a> {
    language: &'a str,
    text: &'a str,
    before: &'a str,
}

fn blocks(page: &str) -> Vec<Block<'_>> {
    let parts: Vec<&str> = page.split("```").collect();
    let pairs = parts.chunks_exact(2);
    pairs
        .map(|pair| {
            let (language, text) = pair[1].split_once('\n').unwrap();
            Block {
                language,
                text,
                before: pair[0].trim(),
            }
        })
        .collect()
}

/// A folder outside of the workspace.
fn folder(name: &str) -> PathBuf {
    let base = std::env::temp_dir().join(format!("eem-followed-{name}-{}", std::process::id()));
    let _ = fs::remove_dir_all(&base);
    fs::create_dir_all(base.join(name).join("src")).unwrap();
    base.join(name)
}

/// A crate with these dependencies and the versions of the workspace. `eem` lies where it is, instead of beside the crate,
/// and is built with the profile that it has there, so that little of it is built again.
fn manifest(krate: &Path, dependencies: &str) {
    let name = krate.file_name().unwrap().to_string_lossy();
    let package =
        format!("[package]\nname = \"{name}\"\nversion = \"0.1.0\"\nedition = \"2024\"\n\n");
    // Not part of a workspace that happens to lie above.
    let alone = "\n[workspace]\n\n";
    let dependencies = dependencies.replace("../eem", ROOT);
    let workspace = fs::read_to_string(Path::new(ROOT).join("Cargo.toml")).unwrap();
    let (_, profile) = workspace.split_once("\n[profile.dev]").unwrap();
    let text = package + &dependencies + alone + "[profile.dev]" + profile;
    fs::write(krate.join("Cargo.toml"), text).unwrap();
    fs::copy(Path::new(ROOT).join("Cargo.lock"), krate.join("Cargo.lock")).unwrap();
}

/// What `cargo` with these arguments prints in a crate; its builds share dependencies with the workspace.
fn cargo(krate: &Path, arguments: &[&str]) -> String {
    let output = Command::new(env!("CARGO"))
        .args(arguments)
        .current_dir(krate)
        .env("CARGO_TARGET_DIR", Path::new(TEMPORARY).parent().unwrap())
        .output()
        .unwrap();
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{arguments:?}: {errors}");
    String::from_utf8(output.stdout).unwrap()
}

/// Follows a page with one program; gives back the folder of its crate.
fn follow(name: &str, page: &str) -> PathBuf {
    let blocks = blocks(page);
    let of = |language: &str| {
        let mut found = blocks.iter().filter(|block| block.language == language);
        found.next().unwrap().text
    };
    let program = blocks.iter().find(|block| block.text.contains("fn main()"));
    let printed = blocks.iter().find(|block| block.before.ends_with("prints"));
    let krate = folder(name);
    manifest(&krate, of("toml"));
    fs::write(krate.join("src/main.rs"), program.unwrap().text).unwrap();
    let output = cargo(&krate, &["run", "--quiet"]);
    assert_eq!(output, printed.unwrap().text);
    krate
}

#[test]
#[ignore = "builds a crate; the gate runs it"]
fn the_readme_can_be_followed() {
    let krate = follow("pendulum", include_str!("../../README.md"));
    fs::remove_dir_all(krate.parent().unwrap()).unwrap();
}

#[test]
#[ignore = "builds a crate; the gate runs it"]
fn the_tutorial_can_be_followed_to_its_picture() {
    let krate = follow("damper", include_str!("../../docs/tutorial.md"));
    let drawn = fs::read_to_string(krate.join("picture.svg")).unwrap();
    let shown = include_str!("../../docs/tutorial.svg");
    assert!(
        drawn == shown,
        "docs/tutorial.svg is not what the tutorial draws"
    );
    fs::remove_dir_all(krate.parent().unwrap()).unwrap();
}

/// Pages with programs that print something. That all programs compile and run as they stand is seen by rustdoc.
const PAGES: [(&str, &str); 2] = [
    ("materials", include_str!("../../docs/materials.md")),
    ("running", include_str!("../../docs/running.md")),
];

#[test]
#[ignore = "builds a crate; the gate runs it"]
fn the_programs_of_the_pages_print_what_is_shown() {
    let krate = folder("pages");
    let dependencies = "[dependencies]\neem = { path = \"../eem\" }\n";
    manifest(&krate, dependencies);
    fs::create_dir(krate.join("src/bin")).unwrap();
    let mut programs = Vec::new();
    for (page, text) in PAGES {
        let blocks = blocks(text);
        let pairs = blocks.windows(2).enumerate();
        for (index, pair) in pairs.filter(|(_, pair)| pair[1].before == "prints") {
            let name = format!("{page}_{index}");
            let path = krate.join(format!("src/bin/{name}.rs"));
            fs::write(path, pair[0].text).unwrap();
            programs.push((name, pair[1].text));
        }
    }
    assert_eq!(programs.len(), 3);
    for (name, printed) in programs {
        let output = cargo(&krate, &["run", "--quiet", "--bin", &name]);
        assert_eq!(output, printed, "{name}");
    }
    fs::remove_dir_all(krate.parent().unwrap()).unwrap();
}
