//! The claims an example makes about its own run: checked, and explained when they fail.

use std::error::Error;
use std::process::ExitCode;

use super::terminal;

/// What `main` returns: 0 when the example ran and all its claims hold, otherwise 1 and why.
pub(crate) fn verdict(outcome: Result<Claims, Box<dyn Error>>) -> ExitCode {
    match outcome {
        Ok(claims) => claims.conclude(),
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

/// The claims checked so far, and those that do not hold.
#[derive(Debug, Default)]
pub(crate) struct Claims {
    checked: usize,
    broken: Vec<String>,
}

impl Claims {
    /// Claims that `value` is at most `bound`; a value that is missing or not a number breaks it.
    pub(crate) fn at_most(&mut self, what: &str, value: Option<f64>, bound: f64) {
        let value = value.unwrap_or(f64::NAN);
        self.holds(
            value <= bound,
            format!("{what} is {value:e}, claimed is at most {bound:e}"),
        );
    }

    /// Claims that `value` is at least `bound`; a value that is missing or not a number breaks it.
    pub(crate) fn at_least(&mut self, what: &str, value: Option<f64>, bound: f64) {
        let value = value.unwrap_or(f64::NAN);
        self.holds(
            value >= bound,
            format!("{what} is {value:e}, claimed is at least {bound:e}"),
        );
    }

    /// Claims `condition`; `explanation` is what to say when it does not hold.
    pub(crate) fn holds(&mut self, condition: bool, explanation: impl Into<String>) {
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
