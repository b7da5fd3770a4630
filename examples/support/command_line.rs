//! The command line of every example: which schemes, which step, how long, where to write.

use std::path::PathBuf;

use clap::error::ErrorKind;
use clap::{CommandFactory, FromArgMatches, Parser};

use super::scheme::{self, Named};

/// Most steps one run records: a longer run fills the memory before it fills a figure.
const MOST_STEPS: f64 = 1e7;

/// An end time that exceeds the last full step by less than this fraction of a step is reached
/// by that step: 20 s in steps of 0.1 s are 200 steps although 0.1 is not exact in binary.
const END_SLACK: f64 = 1e-6;

/// The options that all examples understand. Every time is in seconds.
#[derive(Clone, Debug, Parser)]
pub(crate) struct CommandLine {
    /// Integration scheme to run; `all` compares them.
    #[arg(long, value_name = "NAME", default_value = scheme::ALL, value_parser = scheme::parser())]
    scheme: String,
    /// Time step in seconds [default: the source's].
    #[arg(long, value_name = "H", allow_negative_numbers = true, value_parser = positive_seconds)]
    step: Option<f64>,
    /// Time at which the run ends, in seconds [default: the source's].
    #[arg(long, value_name = "T", allow_negative_numbers = true, value_parser = positive_seconds)]
    end: Option<f64>,
    /// Directory for a CSV file per scheme and the figures as SVG; created when missing.
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
}

/// The time grid of a run: `steps` equal steps that reach the end time.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TimeGrid {
    /// Step in seconds.
    pub(crate) step: f64,
    /// Number of steps.
    pub(crate) steps: usize,
}

impl CommandLine {
    /// Reads the process's arguments; prints help or the error and exits when there is no run.
    pub(crate) fn read(about: &'static str) -> Self {
        let matches = Self::command().about(about).get_matches();
        Self::from_arg_matches(&matches).unwrap_or_else(|error| error.exit())
    }

    /// The schemes asked for.
    pub(crate) fn schemes(&self) -> Vec<Named> {
        scheme::chosen(&self.scheme)
    }

    /// The time grid asked for, with the source's step and end time (s) where nothing was said;
    /// exits with an error message when it has more steps than can be recorded.
    pub(crate) fn time_grid(&self, default_step: f64, default_end: f64) -> TimeGrid {
        let step = self.step.unwrap_or(default_step);
        let end = self.end.unwrap_or(default_end);
        time_grid(step, end).unwrap_or_else(|message| {
            Self::command()
                .error(ErrorKind::ValueValidation, message)
                .exit()
        })
    }
}

fn time_grid(step: f64, end: f64) -> Result<TimeGrid, String> {
    let steps = (end / step - END_SLACK).ceil().max(1.0);
    if steps > MOST_STEPS {
        return Err(format!(
            "{end} s in steps of {step} s are {steps:.0} steps; at most {MOST_STEPS:.0} are recorded"
        ));
    }
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "1 ≤ steps ≤ 1e7"
    )]
    let steps = steps as usize;
    Ok(TimeGrid { step, steps })
}

fn positive_seconds(text: &str) -> Result<f64, String> {
    let seconds: f64 = text
        .parse()
        .map_err(|_| "not a number; expected seconds, for example 0.1".to_owned())?;
    if !seconds.is_finite() {
        return Err("must be finite".to_owned());
    }
    if seconds <= 0.0 {
        return Err("must be greater than zero".to_owned());
    }
    Ok(seconds)
}
