//! What came of a family of runs: a row of the published table, and a test.

use std::collections::BTreeMap;
use std::fmt::Display;

use eem::prelude::*;

use super::rounding::worse;
use super::watched::Record;

/// Iterations that a step of a stiff case may take with the default settings; a staggered step is two
/// solves.
const ITERATIONS: usize = 10;

/// How much is tried.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Effort {
    /// A few seconds for everything, without optimisation.
    Glance,
    /// The tests.
    Short,
    /// The published table.
    Long,
}

impl Effort {
    /// One of three counts.
    pub(crate) const fn of<T: Copy>(self, [glance, short, long]: [T; 3]) -> T {
        match self {
            Self::Glance => glance,
            Self::Short => short,
            Self::Long => long,
        }
    }
}

/// A family of runs that are tried together.
pub(crate) type Family = fn(Effort) -> Tally;

/// The sum over a family of runs.
#[derive(Clone, Debug, Default)]
pub(crate) struct Tally {
    /// What was tried.
    pub(crate) what: String,
    pub(crate) runs: usize,
    /// Runs that came to their end.
    pub(crate) completed: usize,
    pub(crate) steps: usize,
    iterations: usize,
    pub(crate) most_iterations: usize,
    /// The largest |defect|/bound.
    pub(crate) worst: f64,
    /// The largest |ΔE|/bound by reports, and defect of a momentum in ε of its terms.
    pub(crate) worst_reported: f64,
    pub(crate) worst_momentum: f64,
    /// Steps in which it is above 64.
    pub(crate) loose: usize,
    /// Steps whose bound is far above the rounding of their energies, and those that broke a law.
    pub(crate) wide: usize,
    pub(crate) broken: usize,
    /// How many runs ended with which error.
    pub(crate) refused: BTreeMap<String, usize>,
    /// What else is worth knowing.
    pub(crate) notes: Vec<String>,
    /// What does not hold.
    pub(crate) wrong: Vec<String>,
}

impl Tally {
    pub(crate) fn new(what: impl Into<String>) -> Self {
        Self {
            what: what.into(),
            ..Self::default()
        }
    }

    /// A run that keeps the laws, or is refused with a typed error.
    pub(crate) fn add(&mut self, label: impl Display, record: &Record) {
        self.runs += 1;
        self.steps += record.steps;
        self.iterations += record.iterations;
        self.most_iterations = self.most_iterations.max(record.most_iterations);
        self.worst = worse(self.worst, record.worst);
        self.worst_reported = worse(self.worst_reported, record.worst_reported);
        self.worst_momentum = worse(self.worst_momentum, record.worst_momentum);
        self.loose += record.loose;
        self.wide += record.wide;
        self.broken += record.broken_steps;
        match &record.refused {
            Some(_) => *self.refused.entry(record.refusal()).or_default() += 1,
            None => self.completed += 1,
        }
        if !record.is_lawful() {
            let Record {
                steps,
                broken_steps,
                broken,
                ..
            } = record;
            let first = broken.first().map_or("", String::as_str);
            self.wrong.push(format!(
                "{label}: {broken_steps} of {steps} steps broke a law: {first}"
            ));
        }
    }

    /// A run that has to keep the laws and to complete.
    pub(crate) fn add_complete(&mut self, label: impl Display, record: &Record) {
        self.add(&label, record);
        if let Some(error) = &record.refused {
            self.wrong.push(format!("{label}: {error}"));
        }
    }

    /// A run that also has to complete within ten iterations per step on average, of each of its solves.
    /// The few steps that pass by an anchor may need a second start.
    pub(crate) fn add_swift(&mut self, label: impl Display, record: &Record, scheme: Scheme) {
        self.add_complete(&label, record);
        let solves = if scheme == Scheme::Staggered { 2 } else { 1 };
        let mean = mean(record.iterations, record.steps);
        #[expect(clippy::cast_precision_loss, reason = "a small number")]
        let allowed = (solves * ITERATIONS) as f64;
        if mean > allowed {
            let most = record.most_iterations;
            self.wrong.push(format!(
                "{label}: {mean:.1} iterations per step, {most} at most"
            ));
        }
    }

    /// These runs and others of the same kind.
    #[must_use]
    pub(crate) fn and(mut self, other: Self) -> Self {
        self.runs += other.runs;
        self.completed += other.completed;
        self.steps += other.steps;
        self.iterations += other.iterations;
        self.most_iterations = self.most_iterations.max(other.most_iterations);
        self.worst = worse(self.worst, other.worst);
        self.worst_reported = worse(self.worst_reported, other.worst_reported);
        self.worst_momentum = worse(self.worst_momentum, other.worst_momentum);
        self.loose += other.loose;
        self.wide += other.wide;
        self.broken += other.broken;
        for (name, count) in other.refused {
            *self.refused.entry(name).or_default() += count;
        }
        self.notes.extend(other.notes);
        self.wrong.extend(other.wrong);
        self
    }

    /// Something that has to hold.
    pub(crate) fn claim(&mut self, holds: bool, otherwise: impl Display) {
        if !holds {
            self.wrong.push(otherwise.to_string());
        }
    }

    pub(crate) fn note(&mut self, note: impl Display) {
        self.notes.push(note.to_string());
    }

    /// Iterations per step.
    pub(crate) fn mean_iterations(&self) -> f64 {
        mean(self.iterations, self.steps)
    }

    /// Fails a test unless everything holds.
    pub(crate) fn assert(&self) {
        let Self {
            what,
            runs,
            completed,
            steps,
            worst,
            refused,
            ..
        } = self;
        println!(
            "{what}: {completed} of {runs} runs complete, {steps} steps, {:.1} iterations per step and ≤ {}, \
             worst {worst:.1e} of the bound, refused {refused:?}, {:?}",
            self.mean_iterations(),
            self.most_iterations,
            self.notes,
        );
        let shown: Vec<&str> = self.wrong.iter().take(40).map(String::as_str).collect();
        assert!(
            shown.is_empty(),
            "{} complaints:\n{}",
            self.wrong.len(),
            shown.join("\n")
        );
    }
}

fn mean(iterations: usize, steps: usize) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "for print")]
    let [iterations, steps] = [iterations as f64, steps as f64];
    iterations / steps.max(1.0)
}
