//! The README and the pages of `docs`: every page has a title, every program can be copied as it stands, and every link
//! leads somewhere, on disk and in rustdoc.

#![allow(clippy::unwrap_used, reason = "a test: what is missing is a failure")]

use std::fs;
use std::path::{Path, PathBuf};

const LIBRARY: &str = include_str!("../../src/lib.rs");

/// The README and the pages, with their texts.
fn documents() -> Vec<(PathBuf, String)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let pages = fs::read_dir(root.join("docs")).unwrap();
    let pages = pages.map(|page| page.unwrap().path());
    let is_page = |path: &PathBuf| path.extension().is_some_and(|end| end == "md");
    let mut paths: Vec<_> = pages.filter(is_page).collect();
    paths.push(root.join("README.md"));
    let read = |path: PathBuf| {
        let text = fs::read_to_string(&path).unwrap();
        (path, text)
    };
    paths.into_iter().map(read).collect()
}

/// The text without fenced blocks.
fn prose(text: &str) -> String {
    text.split("```").step_by(2).collect()
}

/// Where the inline links of a text lead.
fn inline(text: &str) -> Vec<&str> {
    let targets = text.split("](").skip(1);
    targets.filter_map(|rest| rest.split(')').next()).collect()
}

/// The names and targets of the definitions `[name]: target` in a text.
fn definitions(text: &str) -> Vec<(&str, &str)> {
    let definition = |line: &'_ str| -> Option<(usize, usize)> {
        let rest = line.strip_prefix('[')?;
        let end = rest.find("]: ")?;
        Some((1 + end, 1 + end + 3))
    };
    let lines = text.lines().map(str::trim_start);
    let lines = lines.map(|line| line.trim_start_matches("//! ").trim_start_matches("/// "));
    let parts = lines.filter_map(|line| {
        let (end, start) = definition(line)?;
        Some((&line[1..end], line[start..].trim()))
    });
    parts.collect()
}

fn is_elsewhere(target: &str) -> bool {
    ["https://", "http://", "#"]
        .iter()
        .any(|start| target.starts_with(start))
}

#[test]
fn links_lead_to_files_and_to_pages_of_rustdoc() {
    let mut faults = Vec::new();
    let own = definitions(LIBRARY);
    for (path, text) in documents() {
        let text = prose(&text);
        let folder = path.parent().unwrap();
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        // Inline links to files are dead in rustdoc.
        for target in inline(&text).iter().filter(|target| !is_elsewhere(target)) {
            faults.push(format!(
                "{name}: `{target}` is dead in rustdoc; use a definition"
            ));
        }
        for (label, target) in definitions(&text) {
            if is_elsewhere(target) {
                continue;
            }
            if !folder.join(target).exists() {
                faults.push(format!("{name}: there is no {target}"));
            }
            // Of a picture rustdoc shows the description.
            let is_picture = Path::new(target)
                .extension()
                .is_some_and(|end| end == "svg");
            if !is_picture && !own.iter().any(|(name, _)| *name == label) {
                faults.push(format!("{name}: rustdoc does not know [{label}]"));
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn every_page_is_a_module_of_rustdoc() {
    for (path, _) in documents() {
        let name = path.file_name().unwrap().to_string_lossy();
        assert!(
            LIBRARY.contains(&format!("{name}\")")),
            "{name} is not included in src/lib.rs"
        );
    }
}

#[test]
fn every_page_begins_with_its_title() {
    for (path, text) in documents() {
        assert!(text.starts_with("# "), "{} has no title", path.display());
        let titles = prose(&text)
            .lines()
            .filter(|line| line.starts_with("# "))
            .count();
        assert_eq!(titles, 1, "titles of {}", path.display());
    }
}

/// A forge shows all lines of a block, and rustdoc alone knows which of them to hide.
#[test]
fn programs_are_whole() {
    let mut faults = Vec::new();
    for (path, text) in documents() {
        let name = path.display();
        for block in text.split("```").skip(1).step_by(2) {
            let (language, program) = block.split_once('\n').unwrap();
            if !language.starts_with("rust") {
                continue;
            }
            if program
                .lines()
                .any(|line| line == "#" || line.starts_with("# "))
            {
                faults.push(format!("{name}: a hidden line"));
            }
            if !program.contains("fn main() -> ") {
                faults.push(format!("{name}: a program without `main`"));
            }
        }
        if prose(&text).contains("](crate::") {
            faults.push(format!("{name}: a link that only rustdoc knows"));
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// All files of a folder of sources, with their paths.
fn sources(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap();
    let paths = entries.map(|entry| entry.unwrap().path());
    let files = paths.flat_map(|path| {
        if path.is_dir() {
            sources(&path)
        } else {
            vec![path]
        }
    });
    files.collect()
}

/// The tables "where to change what" at the heads of crates.
#[test]
fn files_named_at_the_heads_of_crates_exist() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let folders = fs::read_dir(root).unwrap();
    let folders = folders.map(|folder| folder.unwrap().path().join("src"));
    let crates: Vec<_> = folders.filter(|src| src.join("lib.rs").exists()).collect();
    let tests = crates.iter().map(|src| src.with_file_name("tests"));
    let tests = tests.filter(|folder| folder.exists());
    let folders = crates.iter().cloned().chain(tests);
    let files: Vec<_> = folders.flat_map(|folder| sources(&folder)).collect();
    let mut missing = Vec::new();
    for src in &crates {
        let head = fs::read_to_string(src.join("lib.rs")).unwrap();
        let rows = head.lines().filter(|line| line.starts_with("//! |"));
        let named = rows.flat_map(|row| row.split('`').skip(1).step_by(2));
        // NAME stands for any.
        let is_source = |name: &str| Path::new(name).extension().is_some_and(|end| end == "rs");
        let is_file = |name: &&str| is_source(name) && !name.contains("NAME");
        for name in named.filter(is_file) {
            if !files.iter().any(|file| file.ends_with(name)) {
                missing.push(format!("{}: {name}", src.display()));
            }
        }
    }
    assert!(
        crates.len() > 5 && missing.is_empty(),
        "{}",
        missing.join("\n")
    );
}
