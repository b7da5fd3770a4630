//! A first look over the space of the unknowns: a sweep, whose best member is where the fit begins.

use std::error::Error;
use std::path::{Path, PathBuf};
use std::{env, fs, process};

use eem_sweep::{Inputs, Plan, Record, RunOptions};

use super::drive::{self, Laws, Logs, UNKNOWNS};
use super::recording::Recording;
use super::support::time_grid::TimeGrid;

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
                |row| {
                    let mut logs = Logs::default();
                    logs.copy_from_slice(row.values());
                    Ok(logs)
                },
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
        let merged = sweep.merge(&directory, None)?;
        Ok(Self {
            samples: read(&merged.path)?,
            failed: report.failed,
        })
    }

    /// The member with the least misfit.
    pub(crate) fn best(&self) -> Option<&Sample> {
        let samples = self.samples.iter();
        samples.min_by(|a, b| a.misfit.total_cmp(&b.misfit))
    }
}

/// The members of the merged table that have not failed: `id`, `failure`, inputs, outputs.
fn read(table: &Path) -> Result<Vec<Sample>, Box<dyn Error>> {
    let mut samples = Vec::new();
    for row in csv::Reader::from_path(table)?.records() {
        let row = row?;
        if row.get(1).is_none_or(|failure| !failure.is_empty()) {
            continue;
        }
        let cells = row.iter().skip(2).take(6);
        let cells: Vec<f64> = cells.map(str::parse).collect::<Result<_, _>>()?;
        let [mount, eta0, capacity, misfit, balance_defect, entropy_loss] = cells[..] else {
            return Err(format!("{}: a row is too short", table.display()).into());
        };
        samples.push(Sample {
            logs: [mount, eta0, capacity],
            misfit,
            laws: Laws {
                balance_defect,
                entropy_loss,
            },
        });
    }
    Ok(samples)
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
