//! One recorded run: what every step left behind, and how it ended.

use std::time::Duration;

/// How a run ended.
#[derive(Clone, Debug)]
pub(crate) enum Outcome {
    /// The end time was reached.
    Completed,
    /// A step failed; the recorded states are those before it.
    Failed {
        /// Time of the last good state in seconds.
        time: f64,
        /// The error in words.
        reason: String,
    },
}

/// The state after every step, the initial state first.
#[derive(Clone, Debug)]
pub(crate) struct Record {
    /// Name of the scheme, as on the command line; also the name of the CSV file.
    pub(crate) scheme: String,
    /// How the run ended.
    pub(crate) outcome: Outcome,
    /// Wall time spent in the steps, recording excluded.
    pub(crate) elapsed: Duration,
    columns: Vec<String>,
    rows: Vec<Row>,
}

/// One state.
#[derive(Clone, Debug)]
pub(crate) struct Row {
    /// One value per column.
    pub(crate) values: Vec<f64>,
    /// Newton iterations of the step that led here; 0 for the initial state.
    pub(crate) newton_iterations: usize,
}

impl Record {
    /// An empty record; `columns` are named as in the CSV file, in its order, `time` first.
    pub(crate) fn new(scheme: impl Into<String>, columns: Vec<String>) -> Self {
        Self {
            scheme: scheme.into(),
            outcome: Outcome::Completed,
            elapsed: Duration::ZERO,
            columns,
            rows: Vec::new(),
        }
    }

    /// Appends a state: one value per column.
    pub(crate) fn push(&mut self, values: Vec<f64>, newton_iterations: usize) {
        assert_eq!(values.len(), self.columns.len(), "one value per column");
        self.rows.push(Row {
            values,
            newton_iterations,
        });
    }

    /// Names of the columns.
    pub(crate) fn columns(&self) -> &[String] {
        &self.columns
    }

    /// All states, the initial one first.
    pub(crate) fn rows(&self) -> &[Row] {
        &self.rows
    }

    /// Whether the end time was reached.
    pub(crate) fn completed(&self) -> bool {
        matches!(self.outcome, Outcome::Completed)
    }

    /// Number of recorded steps.
    pub(crate) fn steps(&self) -> usize {
        self.rows.len().saturating_sub(1)
    }

    /// Time (s) of a state; the columns begin with it.
    pub(crate) fn time(&self, row: usize) -> f64 {
        self.rows[row].values[0]
    }

    /// The part of the run up to `time` (s), without the outcome of what follows.
    pub(crate) fn until(&self, time: f64) -> Self {
        let is_early = |row: &&Row| row.values[0] <= time;
        let rows: Vec<Row> = self.rows.iter().take_while(is_early).cloned().collect();
        let outcome = if rows.len() < self.rows.len() {
            Outcome::Completed
        } else {
            self.outcome.clone()
        };
        Self {
            scheme: self.scheme.clone(),
            outcome,
            elapsed: self.elapsed,
            columns: self.columns.clone(),
            rows,
        }
    }

    /// The values of one column; `None` when the scene has no such quantity.
    pub(crate) fn column(&self, name: &str) -> Option<Vec<f64>> {
        let index = self.columns.iter().position(|column| column == name)?;
        Some(self.rows.iter().map(|row| row.values[index]).collect())
    }

    /// The columns whose name satisfies `choose`, as one vector per state.
    pub(crate) fn vectors(&self, choose: impl Fn(&str) -> bool) -> Vec<Vec<f64>> {
        let chosen: Vec<usize> = (0..self.columns.len())
            .filter(|&index| choose(&self.columns[index]))
            .collect();
        self.rows
            .iter()
            .map(|row| chosen.iter().map(|&index| row.values[index]).collect())
            .collect()
    }

    /// |v| over time, where the columns that begin with `v` are the components of v.
    pub(crate) fn norms(&self, v: &str) -> Vec<(f64, f64)> {
        let lengths = self.vectors(|column| column.starts_with(v));
        let norm = |vector: &Vec<f64>| vector.iter().map(|value| value * value).sum::<f64>().sqrt();
        self.over_time(lengths.iter().map(norm))
    }

    /// |v − u| over time, where the columns that begin with `u` and `v` are the components.
    pub(crate) fn distances(&self, u: &str, v: &str) -> Vec<(f64, f64)> {
        let [from, to] = [u, v].map(|name| self.vectors(|column| column.starts_with(name)));
        let distance = |(u, v): (&Vec<f64>, &Vec<f64>)| {
            let squares = u.iter().zip(v).map(|(u, v)| (v - u) * (v - u));
            squares.sum::<f64>().sqrt()
        };
        self.over_time(from.iter().zip(&to).map(distance))
    }

    /// E − E₀ (J) over time.
    pub(crate) fn energy_changes(&self) -> Vec<(f64, f64)> {
        let energies = self.points("time", "energy");
        let first = energies.first().map_or(0.0, |&(_, energy)| energy);
        let change = |(time, energy)| (time, energy - first);
        energies.into_iter().map(change).collect()
    }

    /// A value per state, with the time of the state.
    pub(crate) fn over_time(&self, values: impl Iterator<Item = f64>) -> Vec<(f64, f64)> {
        let times = self.rows.iter().map(|row| row.values[0]);
        times.zip(values).collect()
    }

    /// The points (x, y) of two columns, for a figure; empty when one of them is missing.
    pub(crate) fn points(&self, x: &str, y: &str) -> Vec<(f64, f64)> {
        let (Some(x), Some(y)) = (self.column(x), self.column(y)) else {
            return Vec::new();
        };
        x.into_iter().zip(y).collect()
    }
}
