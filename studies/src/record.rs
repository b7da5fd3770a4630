//! One recorded run: what every step left behind, and how it ended.

use std::time::Duration;

use eem::Recorder;

/// How a run ended.
#[derive(Clone, Debug)]
pub enum Outcome {
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

/// The columns of a recorder, and how the run ended; the initial state comes first.
#[derive(Clone, Debug)]
pub struct Record {
    /// Name of the scheme, as on the command line; also the name of the CSV file.
    pub scheme: String,
    /// How the run ended.
    pub outcome: Outcome,
    /// Wall time spent in the steps, recording excluded.
    pub elapsed: Duration,
    columns: Vec<Column>,
}

/// A quantity in all states.
#[derive(Clone, Debug)]
pub struct Column {
    /// The name in the CSV file.
    pub name: String,
    /// One value per state.
    pub values: Vec<f64>,
}

impl Record {
    /// What `recorder` kept of a run.
    pub fn of<const D: usize>(
        scheme: &str,
        recorder: &Recorder<D>,
        outcome: Outcome,
        elapsed: Duration,
    ) -> Self {
        let column = |column: &eem::Column| Column {
            name: column.name().to_owned(),
            values: column.values().to_vec(),
        };
        Self {
            scheme: scheme.to_owned(),
            outcome,
            elapsed,
            columns: recorder.columns().iter().map(column).collect(),
        }
    }

    /// All columns; the first is the time.
    pub fn columns(&self) -> &[Column] {
        &self.columns
    }

    /// The time (s) of all states.
    pub fn times(&self) -> &[f64] {
        self.columns.first().map_or(&[], |time| &time.values)
    }

    /// The time (s) of the last state.
    pub fn end(&self) -> f64 {
        self.times().last().copied().unwrap_or(0.0)
    }

    /// Whether the end time was reached.
    pub fn completed(&self) -> bool {
        matches!(self.outcome, Outcome::Completed)
    }

    /// Number of recorded steps.
    pub fn steps(&self) -> usize {
        self.times().len().saturating_sub(1)
    }

    /// Time (s) of a state.
    pub fn time(&self, row: usize) -> f64 {
        self.times()[row]
    }

    /// The part of the run up to `time` (s), without the outcome of what follows.
    #[must_use]
    pub fn until(&self, time: f64) -> Self {
        let rows = self.times().partition_point(|&own| own <= time);
        let mut early = self.clone();
        if rows < self.times().len() {
            early.outcome = Outcome::Completed;
        }
        for column in &mut early.columns {
            column.values.truncate(rows);
        }
        early
    }

    /// Changes the values of a column, if there is one of that name.
    pub fn change(&mut self, name: &str, change: impl FnOnce(&mut [f64])) {
        let column = self.columns.iter_mut().find(|column| column.name == name);
        if let Some(column) = column {
            change(&mut column.values);
        }
    }

    /// The values of one column; `None` when the scene has no such quantity.
    pub fn column(&self, name: &str) -> Option<&[f64]> {
        let mut columns = self.columns.iter();
        let column = columns.find(|column| column.name == name)?;
        Some(&column.values)
    }

    /// The columns whose name satisfies `choose`, as one vector per state.
    pub fn vectors(&self, choose: impl Fn(&str) -> bool) -> Vec<Vec<f64>> {
        let chosen = |column: &&Column| choose(&column.name);
        let chosen: Vec<&Column> = self.columns.iter().filter(chosen).collect();
        let vector = |row| chosen.iter().map(|column| column.values[row]).collect();
        (0..self.times().len()).map(vector).collect()
    }

    /// |v| over time, where the columns that begin with `v` are the components of v.
    pub fn norms(&self, v: &str) -> Vec<(f64, f64)> {
        let lengths = self.vectors(|column| column.starts_with(v));
        let norm = |vector: &Vec<f64>| vector.iter().map(|value| value * value).sum::<f64>().sqrt();
        self.over_time(lengths.iter().map(norm))
    }

    /// |v − u| over time, where the columns that begin with `u` and `v` are the components.
    pub fn distances(&self, u: &str, v: &str) -> Vec<(f64, f64)> {
        let [from, to] = [u, v].map(|name| self.vectors(|column| column.starts_with(name)));
        let distance = |(u, v): (&Vec<f64>, &Vec<f64>)| {
            let squares = u.iter().zip(v).map(|(u, v)| (v - u) * (v - u));
            squares.sum::<f64>().sqrt()
        };
        self.over_time(from.iter().zip(&to).map(distance))
    }

    /// E − E₀ (J) over time.
    pub fn energy_changes(&self) -> Vec<(f64, f64)> {
        let energies = self.points("time", "energy");
        let first = energies.first().map_or(0.0, |&(_, energy)| energy);
        let change = |(time, energy)| (time, energy - first);
        energies.into_iter().map(change).collect()
    }

    /// A value per state, with the time of the state.
    pub fn over_time(&self, values: impl Iterator<Item = f64>) -> Vec<(f64, f64)> {
        self.times().iter().copied().zip(values).collect()
    }

    /// The points (x, y) of two columns, for a figure; empty when one of them is missing.
    pub fn points(&self, x: &str, y: &str) -> Vec<(f64, f64)> {
        let (Some(x), Some(y)) = (self.column(x), self.column(y)) else {
            return Vec::new();
        };
        x.iter().copied().zip(y.iter().copied()).collect()
    }
}
