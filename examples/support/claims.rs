//! The claims an example makes about its own run: checked, and explained when they fail.

use std::process::ExitCode;

/// The claims checked so far, and those that do not hold.
#[derive(Debug, Default)]
pub(crate) struct Claims {
    checked: usize,
    broken: Vec<String>,
}

impl Claims {
    /// Claims that `value` is at most `bound`; a value that is not a number breaks the claim.
    pub(crate) fn at_most(&mut self, what: &str, value: f64, bound: f64) {
        self.holds(
            value <= bound,
            format!("{what} is {value:e}, claimed is at most {bound:e}"),
        );
    }

    /// Claims that `value` is at least `bound`; a value that is not a number breaks the claim.
    pub(crate) fn at_least(&mut self, what: &str, value: f64, bound: f64) {
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
    pub(crate) fn conclude(self) -> ExitCode {
        if self.broken.is_empty() {
            if self.checked > 0 {
                println!("All {} claims of this example hold.", self.checked);
            }
            return ExitCode::SUCCESS;
        }
        for explanation in &self.broken {
            eprintln!("claim broken: {explanation}");
        }
        ExitCode::FAILURE
    }
}
