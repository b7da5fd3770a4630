//! Rows of a study as CSV, with the columns of the library's.

use std::error::Error;
use std::path::Path;

use eem::StudyReport;

use eem_studies::output;

/// What a setting costs, and how accurate it is.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Row {
    pub(crate) scheme: String,
    pub(crate) tolerance: Option<f64>,
    /// s.
    pub(crate) step: Option<f64>,
    /// Of q, p and θ at the end time, relative; none where they are unknown.
    pub(crate) errors: [Option<f64>; 3],
    /// The largest of them, which may be known although a much smaller one is not; not a column.
    pub(crate) largest_error: Option<f64>,
    /// max |ΔE|/|E| over the run.
    pub(crate) energy_defect: Option<f64>,
    pub(crate) steps: u64,
    pub(crate) rejected: u64,
    /// Evaluations of the rates of all unknowns.
    pub(crate) evaluations: u64,
    /// Wall time of the steps, the least of all repeats.
    pub(crate) seconds: Option<f64>,
}

impl Row {
    /// A run that did not reach its end.
    pub(crate) fn failed(tolerance: f64, energy_defect: f64) -> Self {
        Self {
            tolerance: Some(tolerance),
            energy_defect: Some(energy_defect),
            ..Self::default()
        }
    }

    /// The line of a picture that the row belongs to, as the library calls its own.
    pub(crate) fn line(&self) -> String {
        if self.is_of_a_peer() || self.tolerance.is_none() {
            self.scheme.clone()
        } else {
            format!("{}, controlled", self.scheme)
        }
    }

    /// Whether another crate's solver made it: its name has two words.
    pub(crate) fn is_of_a_peer(&self) -> bool {
        self.scheme.contains(' ')
    }

    fn cells(&self) -> Vec<String> {
        let number =
            |value: Option<f64>| value.map_or_else(String::new, |value| format!("{value:.16e}"));
        let [q, p, theta] = self.errors.map(number);
        vec![
            self.scheme.clone(),
            number(self.tolerance),
            number(self.step),
            q,
            p,
            theta,
            number(self.energy_defect),
            self.steps.to_string(),
            self.rejected.to_string(),
            self.evaluations.to_string(),
            number(self.seconds),
        ]
    }
}

/// Writes `peers.csv`.
pub(crate) fn write(directory: &Path, rows: &[Row]) -> Result<(), Box<dyn Error>> {
    let cells: Vec<Vec<String>> = rows.iter().map(Row::cells).collect();
    output::write_texts(directory, "peers", &StudyReport::CSV_HEADS, &cells)?;
    Ok(())
}

/// Reads a file with these columns; the largest error is that of rows in which all three are known.
pub(crate) fn read(path: &Path) -> Result<Vec<Row>, Box<dyn Error>> {
    let mut reader = csv::Reader::from_path(path)?;
    if reader.headers()? != StudyReport::CSV_HEADS.as_slice() {
        return Err(format!("{}: the columns are not those of a study", path.display()).into());
    }
    let mut rows = Vec::new();
    for record in reader.records() {
        let record = record?;
        let number = |column: usize| record[column].parse::<f64>().ok();
        let errors = [number(3), number(4), number(5)];
        let all: Option<Vec<f64>> = errors.into_iter().collect();
        rows.push(Row {
            scheme: record[0].to_owned(),
            tolerance: number(1),
            step: number(2),
            errors,
            largest_error: all.and_then(|all| all.into_iter().reduce(f64::max)),
            energy_defect: number(6),
            steps: record[7].parse()?,
            rejected: record[8].parse()?,
            evaluations: record[9].parse()?,
            seconds: number(10),
        });
    }
    Ok(rows)
}
