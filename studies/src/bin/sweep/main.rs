//! The pendulums of the example `ensemble` as a sweep: run by as many processes as one likes, on one machine or
//! under Slurm, PBS, HyperQueue, GNU parallel or MPI.
//!
//! ```text
//! sweep run --dir out --shard 0/2 &  sweep run --dir out --shard 1/2 &  wait
//! sweep status --dir out
//! sweep merge --dir out
//! ```
//!
//! Equations, symbols, values and source are those of the example `ensemble`, and so are the members: springs whose
//! stiffness, viscosity, insulation and start are known to some percent only. Each has a row in the table with
//! these five numbers and what is kept of its run.
//!
//! Copied into a package of its own it needs `eem`, `eem-sweep`, `clap` and `rand` in `Cargo.toml`, and the folder
//! `ensemble`. What it takes of `eem_sweep` is `eem::sweep`, too, with the feature `sweep` of `eem`; only options of a
//! program's own need `clap`, which `eem::sweep::main` does not.
//!
//! What the example claims: whatever is killed and run again, the merged table has the bits of a run by one process.
//! The scripts in `cluster` try it with each engine, the tests of `eem-sweep` with plain processes.

use std::error::Error;
use std::process::ExitCode;

use eem::prelude::*;
use eem_sweep::{Command, Inputs, Plan, execute};

#[path = "../ensemble/pendulum.rs"]
#[allow(dead_code, reason = "labels are for pictures")]
mod pendulum;

mod member;

use pendulum::Spring;

/// Step and end time, s.
const STEP: f64 = 0.05;
const END: f64 = 20.0;

/// Pendulums with unknown materials, in as many processes as one likes.
#[derive(Debug, clap::Parser)]
struct Options {
    /// Members of the sweep.
    #[arg(long, value_name = "N", default_value_t = 1000)]
    members: usize,
    /// Integration scheme.
    #[arg(long, value_name = "NAME", default_value_t = Scheme::EemEntropy)]
    scheme: Scheme,
    /// Time step, s.
    #[arg(long, value_name = "H", default_value_t = STEP)]
    step: f64,
    /// Time at which members end, s.
    #[arg(long, value_name = "T", default_value_t = END)]
    end: f64,
    /// What identifies the program, in place of a digest of the executable.
    #[arg(long, value_name = "VERSION")]
    program: Option<String>,
    #[command(subcommand)]
    command: Command,
}

fn main() -> ExitCode {
    let options = <Options as clap::Parser>::parse();
    run(&options).unwrap_or_else(|error| {
        eprintln!("error: {error}");
        ExitCode::from(4)
    })
}

fn run(options: &Options) -> Result<ExitCode, Box<dyn Error>> {
    let springs = Spring::draw(options.members);
    let columns = Spring::UNKNOWNS.map(|unknown| unknown.name);
    let inputs = Inputs::rows(columns, springs.iter().map(|spring| spring.values))?;
    let steps = steps(options)?;
    let mut plan = Plan::new("pendulums", inputs, options.scheme, options.step);
    plan = plan.setting("steps", steps);
    if let Some(version) = &options.program {
        plan = plan.program(version);
    }
    let sweep = member::sweep(plan, steps);
    Ok(ExitCode::from(execute(&options.command, &sweep)))
}

/// How many steps lead to the end.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "checked before"
)]
fn steps(options: &Options) -> Result<usize, String> {
    let steps = (options.end / options.step).round();
    if (1.0..1e9).contains(&steps) {
        Ok(steps as usize)
    } else {
        Err(format!(
            "{} s in steps of {} s are {steps} steps",
            options.end, options.step
        ))
    }
}
