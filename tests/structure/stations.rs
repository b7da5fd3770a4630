//! The table of stations in `ARCHITECTURE.md`: where a trial temperature passes.

#![allow(clippy::unwrap_used, reason = "a test: what is missing is a failure")]

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

/// A trial temperature passes at most so many files.
const MOST_FILES: usize = 20;

const ARCHITECTURE: &str = include_str!("../../ARCHITECTURE.md");

/// A row of the table: a function, its file, and a file that calls it.
struct Station<'a> {
    function: &'a str,
    file: &'a str,
    caller: &'a str,
}

/// A row of which the second column is "`function` in `file`".
fn station(line: &str) -> Option<Station<'_>> {
    let columns: Vec<_> = line.split('|').map(str::trim).collect();
    let &[_, _, function, caller, _] = columns.as_slice() else {
        return None;
    };
    let (function, file) = function.split_once("` in `")?;
    Some(Station {
        function: function.strip_prefix('`')?,
        file: file.strip_suffix('`')?,
        caller: caller.strip_prefix('`')?.strip_suffix('`')?,
    })
}

/// Whether a text calls a function that it or another file declares.
fn calls(text: &str, function: &str) -> bool {
    let mut starts = text.match_indices(function).map(|(start, _)| start);
    starts.any(|start| {
        let before = &text[..start];
        let after = &text[start + function.len()..];
        let is_whole = before.ends_with(['.', ':', ' ', '(', '\n']) && !before.ends_with("fn ");
        is_whole && (after.starts_with('(') || after.starts_with("::<"))
    })
}

#[test]
fn a_trial_temperature_passes_the_stations_of_the_architecture() {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("eem-runtime/src");
    let read = |file: &str| fs::read_to_string(source.join(file)).unwrap_or_default();
    let (mut files, mut faults) = (BTreeSet::new(), Vec::new());
    let stations: Vec<_> = ARCHITECTURE.lines().filter_map(station).collect();
    assert!(!stations.is_empty(), "there is no table of stations");
    for Station {
        function,
        file,
        caller,
    } in stations
    {
        files.insert(file);
        let declared = [format!("fn {function}("), format!("fn {function}<")];
        let text = read(file);
        if !declared.iter().any(|start| text.contains(start)) {
            faults.push(format!("{file} has no function `{function}`"));
        }
        if !calls(&read(caller), function) {
            faults.push(format!("{caller} does not call `{function}`"));
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
    assert!(files.len() <= MOST_FILES, "{} files", files.len());
}

#[test]
fn a_function_that_is_declared_is_not_called() {
    assert!(!calls("    fn close_all(&self) {}", "close_all"));
    assert!(!calls("self.unclose_all(1)", "close_all"));
    assert!(calls("        self.close_all(next)", "close_all"));
    assert!(calls("= eliminate::<S, M, true>(&mut system)", "eliminate"));
}
