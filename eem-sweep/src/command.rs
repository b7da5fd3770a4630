//! The command line of a program that runs a sweep.

use std::env;
use std::fmt::Display;
use std::io::{Write, stderr, stdout};
use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::{ArgGroup, Args, Parser, Subcommand};

use crate::engine;
use crate::error::SweepError;
use crate::files;
use crate::format::Format;
use crate::run::{RunOptions, RunReport};
use crate::selection::Selection;
use crate::sweep::Sweep;

/// Exit code: members have failed; every member has a record.
const FAILED: u8 = 3;

/// Exit code: members are missing.
const INCOMPLETE: u8 = 6;

/// The commands of a program that runs a sweep. A program with options of its own takes them as its subcommand and
/// passes it to [`execute`]; for this it needs `clap` 4 with the feature `derive` in `Cargo.toml`. Others call
/// [`main`](fn@main).
///
/// ```
/// use clap::Parser;
/// use eem::sweep::Command;
///
/// #[derive(Parser)]
/// struct Options {
///     /// How many pendulums.
///     #[arg(long, default_value_t = 1000)]
///     members: usize,
///     #[command(subcommand)]
///     command: Command,
/// }
///
/// let line = ["pendulums", "--members", "50", "run", "--dir", "out", "--shard", "2/8"];
/// let options = Options::parse_from(line);
/// assert_eq!(options.members, 50);
/// assert!(matches!(options.command, Command::Run(_)));
/// ```
#[derive(Clone, Debug, Subcommand)]
pub enum Command {
    /// Runs members that have not been reported yet; can be repeated whatever has happened.
    Run(Work),
    /// Says how many members have been reported, and what is missing.
    Status(Look),
    /// Writes one table of all members after proving that each has exactly one record.
    Merge(Join),
    /// Runs members again that have failed.
    Rerun(Again),
    /// Reports members that end every process as failed, so that the others can be merged.
    GiveUp(Leave),
}

/// The directory of a sweep.
#[derive(Clone, Debug, Args)]
struct Place {
    /// The directory with all files of the sweep, shared by all processes.
    #[arg(long = "dir", alias = "out", value_name = "DIR")]
    directory: PathBuf,
}

/// How members are run.
#[derive(Clone, Debug, Args)]
#[command(group = ArgGroup::new("selection"))]
pub struct Work {
    #[command(flatten)]
    place: Place,
    /// One of n shards, counted from 0; `auto` takes it from a whole Slurm array or MPI, `auto/n` from HyperQueue, PBS or
    /// GNU parallel, or from tasks of a Slurm array of n that are submitted again.
    #[arg(long, value_name = "i/n", group = "selection", value_parser = shard)]
    shard: Option<Shard>,
    /// Members with ids from a to below b.
    #[arg(long, value_name = "a..b", group = "selection", value_parser = Selection::range)]
    range: Option<Selection>,
    /// Members with these ids, such as 3,7,10-12.
    #[arg(long, value_name = "LIST", group = "selection", value_parser = Selection::list)]
    members: Option<Selection>,
    /// Threads; 0 is one for each core that the process may use.
    #[arg(long, value_name = "N", default_value_t = 0)]
    threads: usize,
    /// The format of tables [default: that of the directory, csv in a new one].
    #[arg(long, value_name = "NAME")]
    format: Option<Format>,
    /// Members that a thread reports at once [default: what takes a second].
    #[arg(long, value_name = "N")]
    batch: Option<NonZeroUsize>,
}

/// How the status is printed.
#[derive(Clone, Debug, Args)]
pub struct Look {
    #[command(flatten)]
    place: Place,
    /// Print JSON.
    #[arg(long)]
    json: bool,
}

/// Where to merge.
#[derive(Clone, Debug, Args)]
pub struct Join {
    #[command(flatten)]
    place: Place,
    /// The table [default: merged.csv or merged.arrow in DIR].
    #[arg(long, value_name = "FILE")]
    into: Option<PathBuf>,
}

/// Which members are run again.
#[derive(Clone, Debug, Args)]
pub struct Again {
    /// Members that have failed.
    #[arg(long, required = true)]
    failed: bool,
    #[command(flatten)]
    work: Work,
}

/// Which members are given up.
#[derive(Clone, Debug, Args)]
pub struct Leave {
    #[command(flatten)]
    place: Place,
    /// The members, such as 3,7,10-12; those that have been reported stay as they are.
    #[arg(long, value_name = "LIST", value_parser = Selection::list)]
    members: Selection,
}

/// A shard that is given, or taken from the environment.
#[derive(Clone, Debug)]
enum Shard {
    Given(Selection),
    Auto(Option<u64>),
}

fn shard(text: &str) -> Result<Shard, String> {
    match text.strip_prefix("auto") {
        Some("") => Ok(Shard::Auto(None)),
        Some(count) => match count.strip_prefix('/').map(str::parse) {
            Some(Ok(count)) if count > 0 => Ok(Shard::Auto(Some(count))),
            _ => Err("expected auto or auto/n, for example auto/8".to_owned()),
        },
        None => Selection::shard(text).map(Shard::Given),
    }
}

impl Work {
    fn options(&self) -> Result<RunOptions, SweepError> {
        let shard = match &self.shard {
            Some(Shard::Given(selection)) => Some(selection.clone()),
            Some(Shard::Auto(count)) => {
                let (index, count) = engine::shard(|name| env::var(name).ok(), *count)?;
                Some(Selection::Shard { index, count })
            }
            None => None,
        };
        let selection = shard.or_else(|| self.range.clone());
        let selection = selection.or_else(|| self.members.clone());
        Ok(RunOptions {
            selection: selection.unwrap_or_default(),
            threads: self.threads,
            format: self.format,
            batch: self.batch.map(NonZeroUsize::get),
            bar: true,
        })
    }
}

#[derive(Parser)]
struct Line {
    #[command(subcommand)]
    command: Command,
}

/// The `main` of a program that runs a sweep and has no options of its own:
///
/// ```text
/// PROGRAM run    --dir DIR [--shard i/n | --range a..b | --members LIST] [--threads N] [--format csv|arrow]
/// PROGRAM status --dir DIR [--json]
/// PROGRAM merge  --dir DIR [--into FILE]
/// PROGRAM rerun  --dir DIR --failed [--shard i/n …]
/// PROGRAM give-up --dir DIR --members LIST
/// ```
///
/// Every command can be repeated, and killed at any time. Exit codes, which engines understand:
///
/// | code | meaning | what to do |
/// |---|---|---|
/// | 0 | done | – |
/// | 2 | the command line, or what `--shard auto` finds, is invalid | correct it |
/// | 3 | members have failed; the records of all are there | look at `failure` and `message` |
/// | 4 | refused: another program, inputs or settings, a damaged file, a member with two results | as the message says |
/// | 5 | a file cannot be written or read: a full disk, no permission | as it says, then the same command again |
/// | 6 | members are missing | `run` |
///
/// A process that is killed has the code of its signal. There is no need to react to SIGTERM before a time limit:
/// what was reported stays, and the next `run` goes on.
///
/// ```no_run
/// use std::process::ExitCode;
///
/// use eem::sweep::{Inputs, Plan, Sweep, SweepError};
/// use eem::{Scene, Scheme};
///
/// fn sweep() -> Result<Sweep<'static>, SweepError> {
///     let inputs = Inputs::csv("speeds.csv")?;
///     let plan = Plan::new("stones", inputs, Scheme::EemEntropy, 0.1);
///     Ok(plan.closures(
///         |row| row.number("speed"),
///         |&speed| {
///             let mut scene = Scene::<2>::new();
///             let stone = scene.mass(0.5, [0.0, 0.0], [0.0, speed]);
///             (scene, stone)
///         },
///         |run, stone, _| {
///             run.step()?;
///             Ok(run.position(stone)?.y)
///         },
///     ))
/// }
///
/// fn main() -> ExitCode {
///     match sweep() {
///         Ok(sweep) => eem::sweep::main(&sweep),
///         // Inputs that cannot be read: 4, where a panic would be 101.
///         Err(error) => {
///             eprintln!("error: {error}");
///             ExitCode::from(error.exit_code())
///         }
///     }
/// }
/// ```
#[must_use]
pub fn main(sweep: &Sweep<'_>) -> ExitCode {
    ExitCode::from(execute(&Line::parse().command, sweep))
}

/// Executes a command and returns the exit code, see [`main`](fn@main).
#[must_use]
pub fn execute(command: &Command, sweep: &Sweep<'_>) -> u8 {
    attempt(command, sweep).unwrap_or_else(|error| {
        let _closed_pipe = writeln!(stderr(), "error: {error}");
        error.exit_code()
    })
}

fn attempt(command: &Command, sweep: &Sweep<'_>) -> Result<u8, SweepError> {
    match command {
        Command::Run(work) => {
            let options = work.options()?;
            let report = sweep.run(&work.place.directory, &options)?;
            Ok(conclude(&options.selection, report))
        }
        Command::Rerun(Again { work, .. }) => {
            let options = work.options()?;
            let report = sweep.rerun_failed(&work.place.directory, &options)?;
            Ok(conclude(&options.selection, report))
        }
        Command::GiveUp(Leave { place, members }) => {
            let report = sweep.give_up(&place.directory, members)?;
            Ok(conclude(members, report))
        }
        Command::Status(look) => {
            let status = sweep.status(&look.place.directory)?;
            if look.json {
                let text = files::json(&look.place.directory, &status)?;
                say(String::from_utf8_lossy(&text).trim_end());
            } else {
                say(&status);
            }
            Ok(match (status.reported < status.members, status.failed) {
                (true, _) => INCOMPLETE,
                (false, 0) => 0,
                (false, _) => FAILED,
            })
        }
        Command::Merge(join) => {
            let merged = sweep.merge(&join.place.directory, join.into.as_deref())?;
            say(format_args!(
                "{} members, {} failed, none missing, each once ({} records superseded, {} repeated with the same \
                 bits)\ndigest of program, inputs and settings: {}\ndigest of the table: {}\n{}",
                merged.members,
                merged.failed,
                merged.superseded,
                merged.repeated,
                merged.sweep,
                merged.table,
                merged.path.display()
            ));
            Ok(if merged.failed == 0 { 0 } else { FAILED })
        }
    }
}

/// Prints the report of a run, and returns the exit code.
fn conclude(selection: &Selection, report: RunReport) -> u8 {
    let RunReport {
        members,
        skipped,
        ran,
        failed,
    } = report;
    say(format_args!(
        "{selection}: {members} members, {skipped} were there, {ran} run, {failed} failed"
    ));
    if failed == 0 { 0 } else { FAILED }
}

/// Prints a line. A closed pipe is not an error: the exit code still tells the outcome.
fn say(line: impl Display) {
    let _closed_pipe = writeln!(stdout(), "{line}");
}
