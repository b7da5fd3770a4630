//! Every message has a compile-fail case, in the folder of its module.
//!
//! In tests a message records the line that creates it; expanding the cases shows which ones occur.
//! `eem-ui` tests that the compiler shows them at the right tokens.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use syn::{DeriveInput, Item};

use crate::message::expression::syntax;
use crate::message::written;

/// The folders of the cases and the modules of the catalogue.
const SUBJECTS: [&str; 5] = ["attribute", "expression", "field", "item", "unit"];

/// The Rust files of a folder and of the folders in it, in order.
pub(super) fn sources(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let Ok(entries) = fs::read_dir(folder) else {
        return found;
    };
    for entry in entries {
        let path = entry.expect("the folder can be read").path();
        if path.is_dir() {
            found.extend(sources(&path));
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push(path);
        }
    }
    found.sort();
    found
}

/// The messages of a file of the catalogue: first and last line and name.
pub(super) fn messages(source: &str) -> Vec<(u32, u32, String)> {
    let mut found: Vec<(u32, u32, String)> = Vec::new();
    let mut open = None;
    for (line, text) in (1..).zip(source.lines()) {
        if let Some(signature) = text.strip_prefix("pub(crate) fn ") {
            let name = signature.split(['(', '<']).next().unwrap_or_default();
            open = Some((line, name.to_owned()));
        }
        if let ("}", Some((first, name))) = (text, open.as_ref()) {
            found.push((*first, line, name.clone()));
            open = None;
        }
    }
    found
}

/// All messages with the folder that their case belongs to, by file and line.
fn catalogue() -> BTreeMap<(String, u32, u32), String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut all = BTreeMap::new();
    for subject in SUBJECTS {
        let module = root.join("src/message");
        let mut files = vec![module.join(subject).with_extension("rs")];
        files.extend(sources(&module.join(subject)));
        for file in files {
            let source = fs::read_to_string(&file).expect("the catalogue can be read");
            let writes = |body: &str| body.contains("-> Message {");
            let lines: Vec<&str> = source.lines().collect();
            for (first, last, name) in messages(&source) {
                let body = &lines[first as usize - 1..last as usize];
                if writes(&body.join("\n")) {
                    let name = format!("{subject}: {name}");
                    all.insert((file_key(&file), first, last), name);
                }
            }
        }
    }
    all
}

/// The path below `src`, however the compiler and the file system spell what is above.
pub(super) fn file_key(path: &Path) -> String {
    let path = path.to_string_lossy().replace('\\', "/");
    let below = path.rfind("src/message").unwrap_or_default();
    path[below..].to_owned()
}

/// Expands every struct, enum and union of a case.
fn expand_case(case: &Path) -> String {
    let source = fs::read_to_string(case).expect("the case can be read");
    let file = syn::parse_file(&source).expect("the case is Rust");
    let mut expansion = String::new();
    for item in file.items {
        let (Item::Struct(_) | Item::Enum(_) | Item::Union(_)) = item else {
            continue;
        };
        let input: DeriveInput = syn::parse_quote!(#item);
        expansion.push_str(&crate::derive::derive(&input).to_string());
    }
    expansion
}

#[test]
fn every_message_has_a_case_in_its_folder() {
    let cases = Path::new(env!("CARGO_MANIFEST_DIR")).join("../eem-ui/tests/ui");
    let catalogue = catalogue();
    let mut missing: BTreeSet<&String> = catalogue.values().collect();
    let mut rows: Vec<Vec<String>> = syntax::rows().collect();
    for subject in SUBJECTS {
        written::take();
        for case in sources(&cases.join(subject)) {
            let expansion = expand_case(&case);
            rows.retain(|row| !row.iter().any(|text| expansion.contains(text)));
            let shows = ["compile_error", "deprecated"].map(|word| expansion.contains(word));
            assert!(
                shows != [false; 2],
                "{} is without messages",
                case.display()
            );
        }
        for (file, line) in written::take() {
            let file = file_key(Path::new(&file));
            let found = catalogue
                .iter()
                .find(|((name, first, last), _)| *name == file && (*first..=*last).contains(&line));
            let (_, name) = found.unwrap_or_else(|| panic!("{file}:{line} is in no message"));
            if name.starts_with(subject) {
                missing.remove(name);
            }
        }
    }
    assert!(
        missing.is_empty(),
        "without a case in eem-ui/tests/ui: {missing:?}"
    );
    assert!(
        rows.is_empty(),
        "rows of the table without a case: {rows:?}"
    );
}
