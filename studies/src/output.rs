//! Files of a run: one CSV per scheme that gives back every value bit for bit.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use super::record::{Column, Record};

/// Creates the output directory, so that a wrong path is reported before the run.
pub fn prepare(directory: &Path) -> io::Result<()> {
    fs::create_dir_all(directory).map_err(|error| naming(directory, &error))
}

/// Writes `SCHEME.csv`: the record's columns with 17 significant digits, which identify a
/// double; the Newton iterations are whole numbers.
pub fn write_csv(directory: &Path, record: &Record) -> io::Result<PathBuf> {
    let path = directory.join(format!("{}.csv", record.scheme));
    write_rows(&path, record).map_err(|error| naming(&path, &error))?;
    Ok(path)
}

/// Writes `SCHEME.csv` with some of the record's columns under their names, in the order in which they are named.
pub fn write_columns(directory: &Path, record: &Record, names: &[&str]) -> io::Result<PathBuf> {
    let named = |name: &&str| record.columns().iter().find(|column| column.name == **name);
    let columns: Vec<&Column> = names.iter().filter_map(named).collect();
    let heads: Vec<&str> = columns.iter().map(|column| column.name.as_str()).collect();
    let cells = |row| columns.iter().map(|column| column.text(row)).collect();
    let rows: Vec<Vec<String>> = (0..record.times().len()).map(cells).collect();
    write_texts(directory, &record.scheme, &heads, &rows)
}

/// Writes `NAME.csv` with these column heads and rows of numbers, not a number where one is missing.
pub fn write_numbers(
    directory: &Path,
    name: &str,
    heads: &[&str],
    rows: &[Vec<f64>],
) -> io::Result<PathBuf> {
    let text = |row: &Vec<f64>| row.iter().map(|value| format!("{value:.16e}")).collect();
    let rows: Vec<Vec<String>> = rows.iter().map(text).collect();
    write_texts(directory, name, heads, &rows)
}

/// Writes `NAME.csv` with these column heads and rows of cells.
pub fn write_texts(
    directory: &Path,
    name: &str,
    heads: &[&str],
    rows: &[Vec<String>],
) -> io::Result<PathBuf> {
    let path = directory.join(format!("{name}.csv"));
    let write = || {
        let mut writer = csv::Writer::from_path(&path)?;
        writer.write_record(heads)?;
        for row in rows {
            writer.write_record(row)?;
        }
        writer.flush()
    };
    write().map_err(|error| naming(&path, &error))?;
    Ok(path)
}

fn write_rows(path: &Path, record: &Record) -> io::Result<()> {
    let mut writer = csv::Writer::from_path(path)?;
    let columns = record.columns();
    writer.write_record(columns.iter().map(Column::head))?;
    for row in 0..record.times().len() {
        writer.write_record(columns.iter().map(|column| column.text(row)))?;
    }
    writer.flush()
}

/// Units of columns, by how their names begin.
const UNITS: [(&str, &str); 17] = [
    ("time", "s"),
    ("q", "m"),
    ("p", "kg m/s"),
    ("theta", "K"),
    ("gamma", "m"),
    ("reservoir_entropy", "J/K"),
    ("reservoir_heat", "J"),
    ("energy", "J"),
    ("entropy", "J/K"),
    ("angular_momentum", "kg m²/s"),
    ("acceleration", "m/s²"),
    ("travel", "m"),
    ("road", "m"),
    ("damper_energy", "J"),
    ("tyre_force", "N"),
    ("work", "J"),
    ("balance", "J"),
];

impl Column {
    /// The name with the unit, for example `theta_1 (K)`.
    fn head(&self) -> String {
        let name = &self.name;
        let is_own = |(start, _): &&(&str, &str)| {
            let rest = name.strip_prefix(start);
            rest.is_some_and(|rest| {
                rest.is_empty() || rest.starts_with(|c: char| c == '_' || c.is_ascii_digit())
            })
        };
        let unit = UNITS.iter().find(is_own).map(|(_, unit)| unit);
        unit.map_or_else(|| name.clone(), |unit| format!("{name} ({unit})"))
    }

    fn text(&self, row: usize) -> String {
        let value = self.values[row];
        if self.name == "newton_iterations" {
            format!("{value}")
        } else {
            format!("{value:.16e}")
        }
    }
}

/// The operating system's error does not say which file it is about.
fn naming(path: &Path, error: &io::Error) -> io::Error {
    io::Error::new(error.kind(), format!("{}: {error}", path.display()))
}
