//! The table of all runs: writing, reading, comparing.

use std::collections::BTreeMap;
use std::fs;
use std::io::{Error, ErrorKind};
use std::path::Path;

const HEADER: &str = "scene,scheme,scalar,threads,steps,iterations,digest";

/// The type of the numbers; former tables also have rows of others.
const SCALAR: &str = "f64";

/// How many columns say which run it is.
const KEY: usize = 4;

/// A run: which one, and how it ended.
pub(crate) struct Row {
    pub(crate) scene: &'static str,
    pub(crate) scheme: &'static str,
    pub(crate) threads: usize,
    pub(crate) steps: usize,
    pub(crate) iterations: usize,
    /// Of the last state; after the name of an error, if there was one.
    pub(crate) digest: String,
}

impl Row {
    fn line(&self) -> String {
        let Self {
            scene,
            scheme,
            threads,
            steps,
            iterations,
            digest,
        } = self;
        format!("{scene},{scheme},{SCALAR},{threads},{steps},{iterations},{digest}")
    }
}

/// The table as CSV.
pub(crate) fn text(rows: &[Row]) -> String {
    let lines = rows.iter().map(|row| row.line() + "\n");
    format!("{HEADER}\n{}", lines.collect::<String>())
}

pub(crate) fn write(file: &Path, rows: &[Row]) -> Result<(), Error> {
    fs::write(file, text(rows)).map_err(|error| said_of(file, &error))
}

/// An error that names the file.
fn said_of(file: &Path, error: &Error) -> Error {
    Error::new(error.kind(), format!("{}: {error}", file.display()))
}

/// The lines of a former table, of scenes whose names contain `scene` and runs in `f64`.
pub(crate) fn read(file: &Path, scene: &str) -> Result<Vec<String>, Error> {
    let text = fs::read_to_string(file).map_err(|error| said_of(file, &error))?;
    let mut lines = text.lines();
    if lines.next() != Some(HEADER) {
        let error = Error::new(ErrorKind::InvalidData, "not a table of digests");
        return Err(said_of(file, &error));
    }
    let of_scene = lines.filter(|line| {
        let columns: Vec<_> = line.split(',').take(KEY).collect();
        columns[0].contains(scene) && columns.get(2) == Some(&SCALAR)
    });
    Ok(of_scene.map(str::to_owned).collect())
}

/// The columns that say which run it is, and the others.
fn split(line: &str) -> (&str, &str) {
    let commas = line.match_indices(',');
    let end = commas.map(|(at, _)| at).nth(KEY - 1).unwrap_or(line.len());
    line.split_at(end)
}

/// A line for each run that is new, gone or different.
pub(crate) fn differences(former: &[String], rows: &[Row]) -> Vec<String> {
    let lines: Vec<_> = rows.iter().map(Row::line).collect();
    let now: BTreeMap<_, _> = lines.iter().map(|line| split(line)).collect();
    let before: BTreeMap<_, _> = former.iter().map(|line| split(line)).collect();
    let gone = before.iter().filter(|(run, _)| !now.contains_key(*run));
    let gone = gone.map(|(run, end)| format!("gone {run}{end}"));
    let others = lines.iter().filter_map(|line| {
        let (run, end) = split(line);
        match before.get(run) {
            None => Some(format!("new {line}")),
            Some(&former) if former != end => {
                Some(format!("differs {run}: {} -> {}", &former[1..], &end[1..]))
            }
            Some(_) => None,
        }
    });
    others.chain(gone).collect()
}
