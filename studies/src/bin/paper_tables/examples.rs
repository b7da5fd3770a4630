//! The two examples behind Table III: their scenes, and what the paper says about them.

use std::error::Error;

use eem::prelude::*;

use super::double_pendulum;
use super::single_pendulum;
use eem_studies::command_line::CommandLine;
use eem_studies::record::Record;
use eem_studies::simulate;
use eem_studies::time_grid::TimeGrid;

/// The paper's reference takes steps of this size, s.
const REFERENCE_STEP: f64 = 0.005;

/// One of the two examples.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Example {
    pub(crate) number: u8,
    pub(crate) step: f64,
    pub(crate) end: f64,
    /// The energy–entropy–momentum scheme that the paper runs, which also makes the reference.
    pub(crate) eem: Scheme,
    pub(crate) rows: [PublishedRow; 2],
}

/// A row of Table III, and the range of Newton iterations in the text.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PublishedRow {
    pub(crate) scheme: Scheme,
    /// Energy, entropy, momentum.
    pub(crate) errors: [f64; 3],
    pub(crate) iterations: &'static str,
}

pub(crate) const SINGLE: Example = Example {
    number: 1,
    step: single_pendulum::STEP,
    end: single_pendulum::END,
    eem: Scheme::EemEntropy,
    rows: [
        PublishedRow {
            scheme: Scheme::Variational,
            errors: [4e-4, 5e-4, 1e-14],
            iterations: "3–4",
        },
        PublishedRow {
            scheme: Scheme::EemEntropy,
            errors: [3e-15, 3e-3, 1e-15],
            iterations: "3–4",
        },
    ],
};

pub(crate) const DOUBLE: Example = Example {
    number: 2,
    step: double_pendulum::LOG.step,
    end: double_pendulum::LOG.end,
    eem: Scheme::EemTemperature,
    rows: [
        PublishedRow {
            scheme: Scheme::Variational,
            errors: [1e-3, 6e-4, 7e-11],
            iterations: "3–4",
        },
        PublishedRow {
            scheme: Scheme::EemTemperature,
            errors: [1e-12, 3e-3, 3e-5],
            iterations: "4–5",
        },
    ],
};

/// The runs of one example.
#[derive(Debug)]
pub(crate) struct Runs {
    pub(crate) example: Example,
    pub(crate) reference: Record,
    pub(crate) by_scheme: Vec<Record>,
    /// Whether they reach the paper's end time.
    pub(crate) is_complete: bool,
    /// Whether they take the paper's step.
    pub(crate) is_published_step: bool,
}

impl Runs {
    /// Whether step and time are the paper's.
    pub(crate) const fn is_as_published(&self) -> bool {
        self.is_complete && self.is_published_step
    }

    /// The run of a scheme, if it was asked for.
    pub(crate) fn of(&self, scheme: Scheme) -> Option<&Record> {
        self.by_scheme
            .iter()
            .find(|run| run.scheme == scheme.name())
    }
}

impl Example {
    /// What the paper lists about a scheme.
    pub(crate) fn row(&self, scheme: &str) -> Option<&PublishedRow> {
        self.rows.iter().find(|row| row.scheme.name() == scheme)
    }

    /// Runs the schemes of the command line and the reference.
    pub(crate) fn run(self, command_line: &CommandLine) -> Result<Runs, Box<dyn Error>> {
        let grid = command_line.time_grid(self.step, self.end);
        let fine = grid.refined(REFERENCE_STEP.min(grid.step), grid.step);
        let name = format!("example {}, reference", self.number);
        let reference = self.record(&name, self.eem, fine)?;
        let mut by_scheme = Vec::new();
        for scheme in command_line.schemes() {
            by_scheme.push(self.record(scheme.name(), scheme, grid)?);
        }
        Ok(Runs {
            example: self,
            reference,
            by_scheme,
            is_complete: grid.end() >= self.end,
            is_published_step: grid.step.to_bits() == self.step.to_bits(),
        })
    }

    fn record(&self, name: &str, scheme: Scheme, grid: TimeGrid) -> Result<Record, Box<dyn Error>> {
        if self.number == 1 {
            let conductance = single_pendulum::CONDUCTANCE;
            let (mut run, watched) = single_pendulum::pendulum(scheme, grid.step, conductance)?;
            simulate::record(name, &mut run, &watched, grid)
        } else {
            let (mut run, watched) = double_pendulum::LOG.pendulum(scheme, grid.step)?;
            simulate::record(name, &mut run, &watched, grid)
        }
    }
}

/// The entropy (J/K) that example 1 ends with when the conductance to the surroundings is another
/// one, W/K.
pub(crate) fn final_entropy(conductance: f64) -> Result<Option<f64>, Box<dyn Error>> {
    let grid = TimeGrid::reaching(single_pendulum::END, REFERENCE_STEP)?;
    let (mut run, watched) = single_pendulum::pendulum(SINGLE.eem, grid.step, conductance)?;
    let run = simulate::record("another conductance", &mut run, &watched, grid)?;
    Ok(run
        .column("entropy")
        .and_then(|entropy| entropy.last().copied()))
}
