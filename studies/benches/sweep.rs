//! What a sweep costs beside the plain ensemble: processes, files and merging; see `README.md`.
//!
//! CPU seconds, user and system, of processes that this one starts one kind after another, as others may be using
//! the machine.

#![allow(clippy::unwrap_used, reason = "a benchmark fails by panicking")]

use std::env;
use std::fs;
use std::path::Path;
use std::process::{Child, Command, Stdio};

use clap::Parser;
use eem::prelude::*;
use eem_sweep::{Inputs, Plan, Sweep, execute};

#[path = "../src/bin/ensemble/pendulum.rs"]
#[allow(dead_code, reason = "members are drawn in another way")]
mod pendulum;

#[path = "../src/bin/sweep/member.rs"]
mod member;

use pendulum::{Pendulum, Spring};

/// Members, and the published step and end of the single pendulum, s.
const MEMBERS: usize = 100_000;
const STEP: f64 = 0.2;
const STEPS: usize = 100;

/// Processes of the sweep.
const SHARDS: usize = 8;

/// How often each kind is measured; the median counts.
const REPEATS: usize = 5;

fn inputs() -> Inputs {
    let columns = Spring::UNKNOWNS.map(|unknown| unknown.name);
    let ranges = [90.0..110.0, 70.0..130.0, 0.05..0.15, 290.0..310.0, 0.5..1.5];
    Inputs::latin_hypercube(MEMBERS, 1, columns.into_iter().zip(ranges)).unwrap()
}

fn sweep() -> Sweep<'static> {
    let plan = Plan::new("pendulums", inputs(), Scheme::EemTemperature, STEP);
    member::sweep(plan, STEPS)
}

/// All members in one call, on one thread.
fn plain() {
    let (inputs, mut row) = (inputs(), Vec::new());
    let springs: Vec<Spring> = (0..MEMBERS)
        .map(|place| Spring {
            values: inputs.row(place, &mut row).values().try_into().unwrap(),
        })
        .collect();
    let ensemble = Ensemble::new(Scheme::EemTemperature, STEP).threads(1);
    let ends = Pendulum { steps: STEPS }.run(ensemble, &springs);
    assert!(ends.iter().all(Result::is_ok));
}

#[derive(Parser)]
struct Line {
    #[command(subcommand)]
    command: eem_sweep::Command,
}

fn start(line: &[&str]) -> Child {
    let mut command = Command::new(env::current_exe().unwrap());
    command.arg("process").args(line).stdout(Stdio::piped());
    command.spawn().unwrap()
}

/// Waits for a process and gives back its peak of memory, MB.
fn peak(process: Child) -> f64 {
    let output = process.wait_with_output().unwrap();
    assert!(output.status.success());
    let said = String::from_utf8(output.stdout).unwrap();
    let line = said.lines().find(|line| line.starts_with("VmHWM")).unwrap();
    line.split_whitespace()
        .nth(1)
        .unwrap()
        .parse::<f64>()
        .unwrap()
        / 1024.0
}

/// CPU seconds of processes that have ended: fields 16 and 17 of `/proc/self/stat`, in hundredths.
fn cpu_of_children() -> f64 {
    let stat = fs::read_to_string("/proc/self/stat").unwrap();
    let (_, rest) = stat.rsplit_once(')').unwrap();
    let fields: Vec<&str> = rest.split_whitespace().collect();
    let ticks = |field: usize| fields[field].parse::<f64>().unwrap();
    (ticks(13) + ticks(14)) / 100.0
}

/// CPU seconds of all shards and of the merge, and the largest peaks of both, MB.
fn measure(format: &str) -> [f64; 4] {
    let folder = env::temp_dir().join(format!("eem-bench-{}", std::process::id()));
    let dir = folder.to_str().unwrap();
    let before = cpu_of_children();
    let mut most: f64 = 0.0;
    // One at a time, as the plain ensemble: neighbours on the same core cost CPU seconds, too.
    for index in 0..SHARDS {
        let shard = format!("{index}/{SHARDS}");
        let line = [
            "run",
            "--dir",
            dir,
            "--threads",
            "1",
            "--format",
            format,
            "--shard",
            &shard,
        ];
        most = most.max(peak(start(&line)));
    }
    let run = cpu_of_children();
    let merged = peak(start(&["merge", "--dir", dir]));
    let end = cpu_of_children();
    let table = folder.join(format!("merged.{format}"));
    println!(
        "{format}: a table of {} bytes",
        fs::metadata(table).unwrap().len()
    );
    fs::remove_dir_all(Path::new(dir)).unwrap();
    [run - before, end - run, most, merged]
}

fn main() {
    let arguments: Vec<String> = env::args().skip(1).collect();
    if arguments.first().is_some_and(|first| first == "process") {
        if arguments[1] == "plain" {
            plain();
        } else {
            let line = Line::parse_from(&arguments);
            assert_eq!(execute(&line.command, &sweep()), 0);
        }
        println!("{}", fs::read_to_string("/proc/self/status").unwrap());
        return;
    }
    let mut rows: Vec<Vec<[f64; 4]>> = vec![Vec::new(); 3];
    for _ in 0..REPEATS {
        let before = cpu_of_children();
        let memory = peak(start(&["plain"]));
        rows[0].push([cpu_of_children() - before, 0.0, memory, 0.0]);
        rows[1].push(measure("csv"));
        if cfg!(feature = "arrow") {
            rows[2].push(measure("arrow"));
        }
    }
    println!("CPU s: run, merge; MB: run, merge");
    for (name, rows) in ["plain", "csv", "arrow"].iter().zip(&rows) {
        let median = |column: usize| {
            let mut values: Vec<f64> = rows.iter().map(|row| row[column]).collect();
            values.sort_by(f64::total_cmp);
            values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
        };
        let [run, merge, memory, merging] = [0, 1, 2, 3].map(median);
        println!("{name:6} {run:8.2} {merge:8.2} {memory:8.1} {merging:8.1}");
    }
}
