//! What eem is measured against: solvers of other crates, and a scheme written by hand. See the README.
//!
//! The binary `eem-peers` puts solvers of other crates into the pictures of the study `work_precision`; the binary
//! `ratios` compares the library with the prototype. The modules:
//!
//! | module | what it knows |
//! |---|---|
//! | `springs`, `inversion`, `systems` | the equations, written by hand, in entropy and in temperature variables |
//! | `solvers` | the solvers of other crates |
//! | `cases`, `reference` | the library's scenes, their start and their state at the end time |
//! | `study` | errors, energy defects and wall times |
//! | `rows`, `summary`, `pictures` | CSV, table and pictures |
//! | `prototype` | the scheme `eem-explicit` by hand |
//! | `ratios` | library and prototype in turn |
//!
//! Command line, tables and drawing are those of `eem-studies`; scenes and numbers are its files, included as they are.

use std::error::Error;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;

mod cases;
#[path = "../../studies/src/bin/double_pendulum/cases.rs"]
mod double_pendulum;
mod inversion;
mod pictures;
mod prototype;
mod ratios;
mod reference;
mod rows;
#[path = "../../studies/src/bin/single_pendulum/scene.rs"]
mod single_pendulum;
mod solvers;
mod springs;
mod study;
mod summary;
mod systems;
#[cfg(test)]
mod tests;

use cases::CaseName;
use eem_studies::{command_line, output, terminal};
use rows::Row;

pub use ratios::ratios;

const ABOUT: &str = "Solvers of other crates on the cases of eem's study work_precision";

/// The file of the study `work_precision`.
const LIBRARY_FILE: &str = "work_precision.csv";

#[derive(Debug, Parser)]
struct Options {
    /// Which scene.
    #[arg(long, value_name = "NAME", default_value = "single")]
    case: CaseName,
    /// Time at which the runs end, in seconds.
    #[arg(long, value_name = "T", default_value_t = 5.0)]
    end: f64,
    /// Directory for peers.csv, and for the pictures if the study `work_precision` has left its CSV there.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

/// The program `eem-peers`.
#[must_use]
pub fn peers() -> ExitCode {
    exit_code(run(&command_line::read(ABOUT)))
}

fn exit_code(result: Result<(), Box<dyn Error>>) -> ExitCode {
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run(options: &Options) -> Result<(), Box<dyn Error>> {
    if !(options.end.is_finite() && options.end > 0.0) {
        return Err("--end must be a positive number of seconds".into());
    }
    let directory = options.out.as_deref();
    directory.map_or(Ok(()), output::prepare)?;
    let peers = study::study(options.case, options.end)?;
    let Some(directory) = directory else {
        terminal::say(summary::table(&peers));
        return Ok(());
    };
    rows::write(directory, &peers)?;
    let library = directory.join(LIBRARY_FILE);
    if library.exists() {
        let library = rows::read(&library)?;
        let all: Vec<Row> = library.into_iter().chain(peers).collect();
        terminal::say(summary::table(&all));
        pictures::write(directory, options.case.name(), options.end, &all)?;
    } else {
        terminal::say(summary::table(&peers));
        terminal::say(format_args!(
            "No pictures: there is no {LIBRARY_FILE} in {}.",
            directory.display()
        ));
    }
    Ok(())
}
