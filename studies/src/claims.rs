//! The claims an example makes about its own run: checked, and explained when they fail.

use std::error::Error;
use std::process::ExitCode;

use super::first_law;
use super::record::Record;
use super::statistics::Statistics;
use super::terminal;

/// What `main` returns: 0 when the example ran and all its claims hold, otherwise 1 and why.
pub fn verdict(outcome: Result<Claims, Box<dyn Error>>) -> ExitCode {
    match outcome {
        Ok(claims) => claims.conclude(),
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

/// What rounding may do to the laws over a run.
#[derive(Clone, Copy, Debug)]
pub struct Laws {
    /// To the energy, relative to itself.
    pub energy: f64,
    /// To the angular momentum, relative to itself.
    pub angular_momentum: f64,
    /// To the entropy in one step, in units in its last place.
    pub entropy: f64,
}

/// The claims checked so far, and those that do not hold.
#[derive(Debug, Default)]
pub struct Claims {
    checked: usize,
    broken: Vec<String>,
}

impl Claims {
    /// Claims that `value` is at most `bound`; a value that is missing or not a number breaks it.
    pub fn at_most(&mut self, what: &str, value: Option<f64>, bound: f64) {
        let value = value.unwrap_or(f64::NAN);
        self.holds(
            value <= bound,
            format!("{what} is {value:e}, claimed is at most {bound:e}"),
        );
    }

    /// Claims that `value` is at least `bound`; a value that is missing or not a number breaks it.
    pub fn at_least(&mut self, what: &str, value: Option<f64>, bound: f64) {
        let value = value.unwrap_or(f64::NAN);
        self.holds(
            value >= bound,
            format!("{what} is {value:e}, claimed is at least {bound:e}"),
        );
    }

    /// Claims that a run reaches its end and keeps the laws to rounding: energy and angular momentum
    /// to the given shares of themselves, and entropy never less by more than `entropy` units in the
    /// last place.
    pub fn keeps_the_laws(&mut self, run: &Record, laws: &Laws) {
        let (scheme, figures) = (&run.scheme, Statistics::of(run));
        self.reaches_the_end(run);
        self.at_most(
            &format!("{scheme}: the relative energy defect"),
            figures.energy_defect,
            laws.energy,
        );
        self.at_most(
            &format!("{scheme}: the relative angular momentum defect"),
            figures.angular_momentum_defect,
            laws.angular_momentum,
        );
        self.loses_no_entropy(run, laws.entropy);
    }

    /// Claims that a run reaches its end.
    pub fn reaches_the_end(&mut self, run: &Record) {
        let scheme = &run.scheme;
        self.holds(
            run.completed(),
            format!("{scheme} does not reach the end time"),
        );
    }

    /// Claims that energy and work differ by at most `bound`, J, at any time of a run.
    pub fn keeps_the_first_law(&mut self, run: &Record, bound: f64) {
        self.at_most(
            &format!("{}: the defect of the energy (J)", run.scheme),
            first_law::largest_defect(run),
            bound,
        );
    }

    /// Claims that no step of a run takes more entropy than what rounding may take: so many units in its last place.
    pub fn loses_no_entropy(&mut self, run: &Record, rounding: f64) {
        self.at_least(
            &format!(
                "{}: the smallest entropy increment (units in the last place)",
                run.scheme
            ),
            Statistics::of(run).entropy_increment_ulps,
            -rounding,
        );
    }

    /// Claims `condition`; `explanation` is what to say when it does not hold.
    pub fn holds(&mut self, condition: bool, explanation: impl Into<String>) {
        self.checked += 1;
        if !condition {
            self.broken.push(explanation.into());
        }
    }

    /// Prints the verdict; the exit code is 1 when a claim is broken.
    fn conclude(self) -> ExitCode {
        if self.broken.is_empty() {
            if self.checked > 0 {
                terminal::say(format_args!(
                    "All {} claims of this example hold.",
                    self.checked
                ));
            }
            return ExitCode::SUCCESS;
        }
        for explanation in &self.broken {
            eprintln!("claim broken: {explanation}");
        }
        ExitCode::FAILURE
    }
}
