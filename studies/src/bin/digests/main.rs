//! A digest of how each of some small scenes ends, with every scheme: what tells whether a change keeps the bits.

mod matrix;
mod planar;
mod solids;
mod spatial;
mod table;
mod watch;

use std::error::Error;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;

/// Digests of all schemes on small scenes, with one and four threads.
#[derive(Debug, Parser)]
struct Options {
    /// Write the table as CSV.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Compare with a former table; print what differs, and fail if something does.
    #[arg(long, value_name = "FILE")]
    against: Option<PathBuf>,
    /// Only scenes whose names contain this.
    #[arg(long, value_name = "TEXT", default_value = "")]
    scene: String,
}

fn main() -> Result<ExitCode, Box<dyn Error>> {
    let Options {
        out,
        against,
        scene,
    } = Options::parse();
    let rows = matrix::rows(&scene)?;
    if let Some(file) = &out {
        table::write(file, &rows)?;
    }
    let Some(former) = against else {
        if out.is_none() {
            print!("{}", table::text(&rows));
        }
        return Ok(ExitCode::SUCCESS);
    };
    let differences = table::differences(&table::read(&former, &scene)?, &rows);
    for line in &differences {
        println!("{line}");
    }
    eprintln!("{} rows, {} differ", rows.len(), differences.len());
    Ok(ExitCode::from(u8::from(!differences.is_empty())))
}
