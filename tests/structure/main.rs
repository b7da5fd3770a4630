//! Files import each other in one direction, and stay small enough to be read at once.
//!
//! The imports are the paths in the code that begin with `crate`, `super`, `self` or the name of a
//! child module. Each path points to the file of the last module in it; for something re-exported
//! that is the file that re-exports. A `mod` declaration is no import. Code under `#[cfg(test)]`
//! does not count.

mod circles;
mod documents;
mod followed;
mod imports;
mod sources;
mod stations;
mod studies;

use circles::circles;
use imports::imports;
use sources::Sources;

/// Lines of a file, its tests included. Those of functions are counted by `clippy::too_many_lines`.
const FILE: usize = 500;

/// The folders of `eem-runtime`, each of which imports only from those before it.
const FOLDERS: [&str; 6] = ["algebra", "element", "scene", "step", "run", "lib"];

/// What is said about one crate of the workspace.
struct Crate {
    name: &'static str,
    /// Files that import each other all the same, and why they have to.
    allowed: &'static [(&'static [&'static str], &'static str)],
}

/// The crates that are held to this.
const CRATES: [Crate; 9] = [
    Crate {
        name: "eem-study",
        allowed: &[],
    },
    Crate {
        name: "eem-material",
        allowed: &[],
    },
    Crate {
        name: "eem-mesh",
        allowed: &[],
    },
    Crate {
        name: "eem-sparse",
        allowed: &[],
    },
    Crate {
        name: "eem-runtime",
        allowed: &[],
    },
    Crate {
        name: "eem-sweep",
        allowed: &[],
    },
    Crate {
        name: "eem-typed",
        allowed: &[],
    },
    Crate {
        name: "eem-symbolic",
        allowed: &[],
    },
    Crate {
        name: "eem-language",
        allowed: &[(
            &["parse/block.rs", "parse/expr.rs"],
            "a block contains expressions, and an expression can be a block",
        )],
    },
];

#[test]
fn files_do_not_import_each_other_in_circles() {
    let mut faults = Vec::new();
    for Crate { name, allowed } in &CRATES {
        let imports = imports(&Sources::of_crate(name));
        let found = circles(&imports);
        for circle in &found {
            if !allowed.iter().any(|(files, _)| circle == files) {
                faults.push(format!("{name}: {} import each other", circle.join(", ")));
            }
        }
        for (files, reason) in *allowed {
            if !found.iter().any(|circle| circle == files) {
                let files = files.join(", ");
                faults.push(format!("{name}: no circle {files} any more ({reason})"));
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// The place of the folder of a file among [`FOLDERS`].
fn folder(file: &str) -> usize {
    let first = file.split(['/', '.']).next();
    let place = FOLDERS.iter().position(|folder| Some(*folder) == first);
    place.unwrap_or_else(|| panic!("{file} is in none of the folders"))
}

#[test]
fn folders_import_in_one_direction() {
    let imports = imports(&Sources::of_crate("eem-runtime"));
    let mut faults = Vec::new();
    for (file, imported) in &imports {
        let later = imported.iter().filter(|other| folder(other) > folder(file));
        faults.extend(later.map(|other| format!("{file} imports {other}")));
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
    // What is checked is there.
    let has_run = |file: &str| folder(file) == folder("run.rs");
    assert!(imports.keys().filter(|file| has_run(file)).count() > 10);
}

#[test]
fn files_are_short() {
    let mut faults = Vec::new();
    for Crate { name, .. } in &CRATES {
        for (file, source) in &Sources::of_crate(name).files {
            let lines = source.text.lines().count();
            if lines > FILE {
                faults.push(format!(
                    "{name}: {file} has {lines} lines, more than {FILE}"
                ));
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// A crate that is made up: names and texts of its files.
fn made_up(files: &[(&str, &str)]) -> Sources {
    let files = files.iter();
    Sources::new(files.map(|&(name, text)| (name.to_owned(), text.to_owned())))
}

#[test]
fn a_circle_is_found() {
    let sources = made_up(&[
        ("lib.rs", "mod a; mod b; mod c; use a::A;"),
        ("a.rs", "use crate::b::inner::Inner; pub struct A;"),
        ("b.rs", "pub mod inner; pub struct B;"),
        ("b/inner.rs", "use super::super::c::f; pub struct Inner;"),
        ("c.rs", "pub fn f() { let _: crate::a::A; }"),
    ]);
    let imports = imports(&sources);
    let found = circles(&imports);
    assert_eq!(found, [["a.rs", "b/inner.rs", "c.rs"]]);
}

#[test]
fn a_parent_and_a_child_that_use_each_other_are_a_circle() {
    let sources = made_up(&[
        ("lib.rs", "mod a;"),
        ("a.rs", "mod child; pub use child::Child; pub struct A;"),
        ("a/child.rs", "use super::A; pub struct Child(A);"),
    ]);
    assert_eq!(circles(&imports(&sources)), [["a.rs", "a/child.rs"]]);
}

#[test]
fn declarations_and_tests_are_no_imports() {
    let sources = made_up(&[
        ("lib.rs", "mod a; #[cfg(test)] mod tests; pub struct Face;"),
        ("a.rs", "mod child; pub struct A;"),
        (
            "a/child.rs",
            "use crate::Face; use super::A; #[cfg(test)] mod tests { use crate::b::B; }",
        ),
        ("tests.rs", "use crate::a::A;"),
    ]);
    let imports = imports(&sources);
    assert!(circles(&imports).is_empty());
    let of_child = imports["a/child.rs"].iter().map(String::as_str);
    assert_eq!(of_child.collect::<Vec<_>>(), ["a.rs", "lib.rs"]);
    assert!(!imports.contains_key("tests.rs"));
}
