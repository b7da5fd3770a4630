//! The command line of every example: which schemes, which step, how long, where to write.

use std::path::PathBuf;

use clap::builder::PossibleValuesParser;
use clap::error::ErrorKind;
use clap::{CommandFactory, FromArgMatches, Parser};
use eem::Scheme;

use super::time_grid::TimeGrid;

/// The name that stands for every scheme.
const ALL: &str = "all";

/// The options that all examples understand. Every time is in seconds.
#[derive(Clone, Debug, Parser)]
pub struct CommandLine {
    /// Integration scheme to run; `all` compares them.
    #[arg(long, value_name = "NAME", default_value = ALL, value_parser = scheme_names())]
    scheme: String,
    /// Time step in seconds [default: the source's].
    #[arg(long, value_name = "H", allow_negative_numbers = true, value_parser = positive_seconds)]
    step: Option<f64>,
    /// Time at which the run ends, in seconds [default: the source's].
    #[arg(long, value_name = "T", allow_negative_numbers = true, value_parser = positive_seconds)]
    end: Option<f64>,
    /// Directory for a CSV file per scheme and the figures as SVG; created when missing.
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}

impl CommandLine {
    /// Reads the process's arguments; prints help or the error and exits when there is no run.
    pub fn read(about: &'static str) -> Self {
        read(about)
    }

    /// The schemes asked for. The explicit one takes part in no comparison at equal steps, as it needs steps that
    /// resolve all vibrations; by its name it is run.
    pub fn schemes(&self) -> Vec<Scheme> {
        let mut schemes = self.schemes_of_any_step();
        schemes.retain(|&scheme| !self.takes_all_schemes() || scheme != Scheme::EemExplicit);
        schemes
    }

    /// The schemes asked for, or those that are compared where none is asked for by its name; always in the same order.
    pub fn schemes_or(&self, compared: &[Scheme]) -> Vec<Scheme> {
        let mut schemes = self.schemes();
        schemes.retain(|scheme| !self.takes_all_schemes() || compared.contains(scheme));
        schemes
    }

    /// The schemes asked for, by an example in which each has steps of its own.
    pub fn schemes_of_any_step(&self) -> Vec<Scheme> {
        let is_chosen = |scheme: &Scheme| self.takes_all_schemes() || self.scheme == scheme.name();
        Scheme::ALL.into_iter().filter(is_chosen).collect()
    }

    /// Whether no scheme was asked for by its name.
    pub fn takes_all_schemes(&self) -> bool {
        self.scheme == ALL
    }

    /// The end time asked for, or the source's, s.
    pub fn end(&self, default_end: f64) -> f64 {
        self.end.unwrap_or(default_end)
    }

    /// The time grid asked for, with the source's step and end time (s) where nothing was said;
    /// exits with an error message when it has more steps than can be recorded.
    pub fn time_grid(&self, default_step: f64, default_end: f64) -> TimeGrid {
        let step = self.step.unwrap_or(default_step);
        let end = self.end.unwrap_or(default_end);
        TimeGrid::reaching(end, step).unwrap_or_else(|message| {
            Self::command()
                .error(ErrorKind::ValueValidation, message)
                .exit()
        })
    }
}

/// Reads the process's arguments for an example that has options of its own, in which it flattens
/// [`CommandLine`]; prints help or the error and exits when there is no run.
pub fn read<T: CommandFactory + FromArgMatches>(about: &'static str) -> T {
    let matches = T::command().about(about).get_matches();
    T::from_arg_matches(&matches).unwrap_or_else(|error| error.exit())
}

/// Accepts the names of the schemes and `all`.
fn scheme_names() -> PossibleValuesParser {
    let names = Scheme::ALL.into_iter().map(Scheme::name);
    PossibleValuesParser::new(names.chain([ALL]))
}

/// Accepts a finite time that is not zero.
pub fn positive_seconds(text: &str) -> Result<f64, String> {
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
