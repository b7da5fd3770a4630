//! Attempts to break the laws at extremes, kind by kind; writes `docs/extremes.md`.
//!
//! An exact scheme keeps the laws in every step, to rounding, or it refuses the step with a typed
//! error. This example tries to break that: step sizes of 18 decades, ratios of stiffness of 12, heat
//! that equalises a billion times within a step, masses that fall through their anchors, scenes at
//! random. A judge forms the laws of every step from the stored states by their definitions,
//!
//! ```text
//! E = Σ p²/2m − Σ m g·q + Σ (ψ + θ s) + Σ θ_r σ_r + lost heat       |ΔE − work − heat| ≤ 64 ε (A + A⁺)
//! S = Σ s + Σ σ_r + entropy of the thermostats                      ΔS ≥ −64 ε² Σ |s|
//! ```
//!
//! with 32 digits and by code that shares nothing with the schemes: values and carries of the state are
//! read from checkpoints, and every free energy is evaluated anew. A, in joules, is the sum of the
//! magnitudes of all terms of the balance, A⁺ the work of what the arguments of the forces round by.
//!
//! | symbol | meaning |
//! |---|---|
//! | E, S | energy (J) and entropy (J/K) of the scene |
//! | q, p, m | positions (m), momenta (kg m/s), masses (kg) |
//! | ψ, θ, s | free energy (J), temperature (K), kept entropy (J/K) of a spring |
//! | `θ_r`, `σ_r` | temperature (K) and received entropy (J/K) of a reservoir |
//! | ε | 2⁻⁵² |
//!
//! The tests `tests/extremes` run the same families of runs in a short form. The subcommand `campaign` makes many
//! fresh steps of every exact scheme, each few of them in another random scene, and prints a table of its own.
//!
//! What the example claims, and fails without: all laws hold in every step that an exact scheme takes,
//! and whatever else a family of runs asks for, for instance that stiff cases complete.

use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{Parser, Subcommand};

mod campaign;
#[path = "../../../../tests/extremes/suite.rs"]
mod extremes;
mod report;

use eem_studies::claims::{self, Claims};
use eem_studies::progress::Progress;
use eem_studies::{command_line, terminal};
use extremes::kinds::{self, Kind};
use extremes::tally::{Effort, Tally};

const ABOUT: &str = "Try to break the laws, kind by kind of extreme, and write what holds";

/// The name of the table in a directory.
const TABLE: &str = "extremes.md";

/// What is tried, and where the table goes.
#[derive(Clone, Debug, Parser)]
#[command(args_conflicts_with_subcommands = true)]
struct Arguments {
    /// Something else than kinds of extremes.
    #[command(subcommand)]
    instead: Option<Instead>,
    /// The counts of the tests in the place of those of the published table.
    #[arg(long)]
    short: bool,
    /// Only this kind, by its number or name; several times for several.
    #[arg(long, value_name = "KIND")]
    only: Vec<String>,
    /// File for the table, or a directory for `extremes.md` [default: print it].
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// The date that the table bears [default: today].
    #[arg(long, value_name = "YYYY-MM-DD")]
    date: Option<String>,
    /// Anything here asks for a glance of a few seconds, as the other examples understand an early end.
    #[arg(long, value_name = "T")]
    end: Option<f64>,
}

#[derive(Clone, Debug, Subcommand)]
enum Instead {
    Campaign(campaign::Campaign),
}

impl Arguments {
    const fn effort(&self) -> Effort {
        match (self.end, self.short) {
            (Some(_), _) => Effort::Glance,
            (None, true) => Effort::Short,
            (None, false) => Effort::Long,
        }
    }

    /// The kinds asked for, with their numbers.
    fn kinds(&self) -> Result<Vec<(usize, &'static Kind)>, String> {
        let numbered = || (1..).zip(&kinds::ALL);
        let names = |asked: &str, (number, kind): &(usize, &Kind)| {
            kind.name == asked || number.to_string() == asked
        };
        for asked in &self.only {
            if !numbered().any(|own| names(asked, &own)) {
                let known: Vec<_> = kinds::ALL.iter().map(|kind| kind.name).collect();
                return Err(format!("no kind `{asked}`; there are {}", known.join(", ")));
            }
        }
        let wanted = |own: &(usize, &Kind)| {
            self.only.is_empty() || self.only.iter().any(|asked| names(asked, own))
        };
        Ok(numbered().filter(wanted).collect())
    }

    /// The command that makes the same table.
    fn command(&self) -> String {
        let mut command = "cargo run --release -p eem-studies --bin extremes".to_owned();
        let mut options = String::new();
        if self.effort() == Effort::Short {
            options.push_str(" --short");
        }
        if self.effort() == Effort::Glance {
            options.push_str(" --end 2");
        }
        for kind in &self.only {
            options.push_str(" --only ");
            options.push_str(kind);
        }
        if !options.is_empty() {
            command.push_str(" --");
            command.push_str(&options);
        }
        command
    }
}

fn main() -> ExitCode {
    claims::verdict(run(&command_line::read(ABOUT)))
}

fn run(arguments: &Arguments) -> Result<Claims, Box<dyn Error>> {
    if let Some(Instead::Campaign(asked)) = &arguments.instead {
        return campaign::run(asked);
    }
    let kinds = arguments.kinds()?;
    let out = arguments.out.as_deref().map(prepare).transpose()?;
    let families = kinds.iter().map(|(_, kind)| kind.families.len()).sum();
    let mut progress = Progress::new("families of runs", families);
    let mut done = 0;
    let mut results = Vec::new();
    for (number, kind) in kinds {
        let mut tallies: Vec<Tally> = Vec::new();
        for family in kind.families {
            tallies.push(family(arguments.effort()));
            done += 1;
            progress.advance(done);
        }
        results.push((number, kind, tallies));
    }
    drop(progress);
    let date = arguments.date.clone().unwrap_or_else(report::today);
    let text = report::markdown(&results, &arguments.command(), &date);
    match out {
        Some(file) => {
            std::fs::write(&file, text)?;
            terminal::say(format_args!("Table: {}", file.display()));
        }
        None => terminal::say(text),
    }
    let mut claims = Claims::default();
    for tally in results.iter().flat_map(|(_, _, tallies)| tallies) {
        for wrong in &tally.wrong {
            claims.holds(false, format!("{}: {wrong}", tally.what));
        }
    }
    Ok(claims)
}

/// The file that `--out` stands for; a path without an extension is a directory.
fn prepare(out: &Path) -> std::io::Result<PathBuf> {
    if out.extension().is_some() {
        return Ok(out.to_owned());
    }
    std::fs::create_dir_all(out)?;
    Ok(out.join(TABLE))
}
