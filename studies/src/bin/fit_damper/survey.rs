//! A first look over the space of the unknowns: a sweep, whose best member is where the fit begins.

use std::error::Error;
use std::path::{Path, PathBuf};
use std::{env, fs, process};

use eem_sweep::{Inputs, Plan, Record, Row, RunOptions};

use super::drive::{self, Laws, Logs, UNKNOWNS};
use super::recording::Recording;
use eem_studies::time_grid::TimeGrid;

/// Any number would do; the same one draws the same members.
const SEED: u64 = 12;

/// All that is known before: logarithms of 730 kN/m, 990 N s/m and 740 J/K, each off by a factor of 4.5 at most.
const GUESS: Logs = [13.5, 6.9, 6.6];
const DOUBT: f64 = 1.5;

/// A member of the sweep.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sample {
    pub(crate) logs: Logs,
    /// χ², the sum of the squared residuals.
    pub(crate) misfit: f64,
    pub(crate) laws: Laws,
}

/// What is kept of a member.
struct Kept {
    misfit: f64,
    laws: Laws,
}

impl Record for Kept {
    const COLUMNS: &'static [&'static str] = &["misfit", "balance_defect", "entropy_loss"];

    fn write(&self, row: &mut [f64]) {
        row.copy_from_slice(&[
            self.misfit,
            self.laws.balance_defect,
            self.laws.entropy_loss,
        ]);
    }
}

/// The members that reached the end, and how many did not.
#[derive(Debug)]
pub(crate) struct Survey {
    pub(crate) samples: Vec<Sample>,
    pub(crate) failed: usize,
}

impl Survey {
    /// Runs what is missing of the sweep in `directory`, or all of it in a directory that is removed.
    pub(crate) fn run(
        grid: TimeGrid,
        recording: &Recording,
        members: usize,
        directory: Option<&Path>,
    ) -> Result<Self, Box<dyn Error>> {
        let temporary = Temporary::new();
        let directory = directory.map_or_else(|| temporary.0.clone(), |dir| dir.join("sweep"));
        let ranges = UNKNOWNS.iter().zip(GUESS);
        let ranges = ranges
            .map(|(unknown, guess)| (format!("ln {}", unknown.name), guess - DOUBT..guess + DOUBT));
        let inputs = Inputs::latin_hypercube(members, SEED, ranges)?;
        let sweep = Plan::new("fit_damper", inputs, drive::SCHEME, grid.step)
            .setting("steps", grid.steps)
            .closures(
                |row| Ok(logs_of(row)),
                drive::build,
                |run, damper, logs| {
                    let drive = drive::observe(run, damper, logs, grid)?;
                    let residuals = recording.residuals(&drive);
                    Ok(Kept {
                        misfit: residuals.iter().map(|residual| residual.powi(2)).sum(),
                        laws: drive.laws,
                    })
                },
            );
        let options = RunOptions {
            bar: true,
            ..RunOptions::default()
        };
        let report = sweep.run(&directory, &options)?;
        sweep.merge(&directory, None)?;
        let mut samples = Vec::new();
        sweep.each(&directory, |row, result| {
            if let Ok(&[misfit, balance_defect, entropy_loss]) = result {
                samples.push(Sample {
                    logs: logs_of(row),
                    misfit,
                    laws: Laws {
                        balance_defect,
                        entropy_loss,
                    },
                });
            }
        })?;
        Ok(Self {
            samples,
            failed: report.failed,
        })
    }

    /// The member with the least misfit.
    pub(crate) fn best(&self) -> Option<&Sample> {
        let samples = self.samples.iter();
        samples.min_by(|a, b| a.misfit.total_cmp(&b.misfit))
    }
}

/// What is asked of a member.
fn logs_of(row: Row<'_>) -> Logs {
    let mut logs = Logs::default();
    logs.copy_from_slice(row.values());
    logs
}

/// A directory of this process, removed in the end if it is there.
struct Temporary(PathBuf);

impl Temporary {
    fn new() -> Self {
        Self(env::temp_dir().join(format!("eem-fit-damper-{}", process::id())))
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        let _not_there = fs::remove_dir_all(&self.0);
    }
}
