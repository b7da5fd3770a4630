//! A progress bar on the terminal for runs that take more than two seconds; silent otherwise.

use std::io::{IsTerminal, stderr};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};

/// How long a run may take before a bar appears.
const PATIENCE: Duration = Duration::from_secs(2);

/// The progress of one run, in steps.
#[derive(Debug)]
pub struct Progress {
    label: String,
    steps: u64,
    started: Instant,
    wanted: bool,
    bar: Option<ProgressBar>,
}

impl Progress {
    /// Starts the clock; nothing is shown yet.
    pub fn new(label: impl Into<String>, steps: usize) -> Self {
        Self {
            label: label.into(),
            steps: steps as u64,
            started: Instant::now(),
            wanted: stderr().is_terminal(),
            bar: None,
        }
    }

    /// Reports that `done` steps are made.
    pub fn advance(&mut self, done: usize) {
        if !self.wanted {
            return;
        }
        if self.bar.is_none() && self.started.elapsed() >= PATIENCE {
            self.bar = Some(bar(&self.label, self.steps));
        }
        if let Some(bar) = &self.bar {
            bar.set_position(done as u64);
        }
    }

    /// Reports that `done` of `steps` steps are made, where more may have to be made than was said.
    pub fn advance_of(&mut self, done: u64, steps: u64) {
        self.steps = steps;
        if let Some(bar) = &self.bar {
            bar.set_length(steps);
        }
        self.advance(usize::try_from(done).unwrap_or(usize::MAX));
    }
}

impl Drop for Progress {
    /// Removes the bar, also after a failed step: what follows is the table.
    fn drop(&mut self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

fn bar(label: &str, steps: u64) -> ProgressBar {
    let template = "{prefix} [{bar:40}] {pos}/{len} steps, {eta} left";
    let style = ProgressStyle::with_template(template)
        .unwrap_or_else(|_| ProgressStyle::default_bar())
        .progress_chars("=> ");
    ProgressBar::new(steps)
        .with_style(style)
        .with_prefix(label.to_owned())
}
