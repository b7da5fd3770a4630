//! The program under test: stones on springs, in this process or in others that this test starts.

use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};

use clap::Parser;
use eem::MemberFailure;
use eem::prelude::*;
use eem::sweep::{InputError, Inputs, Plan, Record, Row, Sweep, execute};

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| 0.5 * stiffness * (lambda - length).powi(2))]
pub(crate) struct Spring {
    pub(crate) stiffness: f64,
    pub(crate) length: f64,
}

/// Where a stone is after some steps, and how fast.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct End {
    pub(crate) height: f64,
    pub(crate) energy: f64,
}

impl Record for End {
    const COLUMNS: &'static [&'static str] = &["height (m)", "energy (J)"];

    fn write(&self, row: &mut [f64]) {
        row.copy_from_slice(&[self.height, self.energy]);
    }
}

/// A stone that hangs on a spring; its inputs are stiffness and speed.
pub(crate) struct Stone {
    pub(crate) steps: usize,
}

impl Stone {
    pub(crate) fn build(&[stiffness, speed]: &[f64; 2]) -> (Scene<1>, Node) {
        let mut scene = Scene::<1>::new();
        let hook = scene.anchor([0.0]);
        let stone = scene.mass(1.0, [-1.0], [speed]);
        let length = 1.0;
        scene.spring(Spring { stiffness, length }, [hook, stone]);
        scene.set_gravity([-10.0]);
        (scene, stone)
    }

    pub(crate) fn observe(
        &self,
        run: &mut Simulation<1>,
        stone: Node,
    ) -> Result<End, MemberFailure> {
        for _ in 0..self.steps {
            run.step()?;
        }
        let (height, energy) = (run.position(stone)?.x, run.ledger().energy);
        Ok(End { height, energy })
    }

    /// The sweep whose inputs `input` makes of rows.
    pub(crate) fn sweep<'a>(
        self,
        plan: Plan,
        input: impl Fn(Row<'_>) -> Result<[f64; 2], InputError> + Send + Sync + 'a,
    ) -> Sweep<'a> {
        plan.closures(input, Self::build, move |run, stone, _| {
            self.observe(run, stone)
        })
    }
}

pub(crate) const STEP: f64 = 1e-2;

/// Some stiffness and speed for each member.
pub(crate) fn inputs(members: usize) -> Inputs {
    let columns = [("stiffness", 100.0..900.0), ("speed", -1.0..1.0)];
    Inputs::latin_hypercube(members, 7, columns).unwrap()
}

/// The plan of so many members and steps.
pub(crate) fn plan(members: usize, steps: usize) -> Plan {
    Plan::new("stones", inputs(members), Scheme::EemEntropy, STEP)
        .setting("steps", steps)
        .program("1")
}

/// The sweep of so many members and steps.
pub(crate) fn stones(members: usize, steps: usize) -> Sweep<'static> {
    let abort: Option<u64> = env::var(ABORT).ok().map(|id| id.parse().unwrap());
    Stone { steps }.sweep(plan(members, steps), move |row| {
        if Some(row.id()) == abort {
            std::process::abort();
        }
        Ok([row.number("stiffness")?, row.number("speed")?])
    })
}

/// An empty directory, and the sweep in it.
pub(crate) fn directory(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("sweep-{name}"));
    let _absent = fs::remove_dir_all(&folder);
    folder
}

/// The files below a folder with their contents, but for the progress.
pub(crate) fn contents(folder: &Path) -> Vec<(PathBuf, Vec<u8>)> {
    let mut files = Vec::new();
    let Ok(entries) = fs::read_dir(folder) else {
        return files;
    };
    for entry in entries {
        let path = entry.unwrap().path();
        if path.is_dir() && !path.ends_with("progress") {
            files.extend(contents(&path));
        } else if let Ok(bytes) = fs::read(&path) {
            files.push((path, bytes));
        }
    }
    files.sort();
    files
}

/// What the other process reads.
const LINE: &str = "EEM_SWEEP_LINE";

/// The member at which the other process aborts.
const ABORT: &str = "EEM_SWEEP_ABORT";

/// A process of the program with this command line: members, steps, and what [`eem::sweep::Command`] understands.
pub(crate) fn start(line: &[&str]) -> Child {
    let command = Command::new(env::current_exe().unwrap());
    start_by(command, line)
}

/// The same, which aborts where it comes to a member.
pub(crate) fn abort_at(member: u64, line: &[&str]) -> Child {
    let mut command = Command::new(env::current_exe().unwrap());
    command.env(ABORT, member.to_string());
    start_by(command, line)
}

/// The same, which may have so many files open.
pub(crate) fn with_files(files: usize, line: &[&str]) -> Child {
    let mut command = Command::new("sh");
    let script = format!("ulimit -n {files}; exec \"$0\" \"$@\"");
    command.args(["-c", &script]);
    command.arg(env::current_exe().unwrap());
    start_by(command, line)
}

fn start_by(mut command: Command, line: &[&str]) -> Child {
    command.args(["program::process", "--exact", "--ignored", "--nocapture"]);
    command.env(LINE, line.join("\n")).stdin(Stdio::null());
    command.stdout(Stdio::piped()).stderr(Stdio::piped());
    command.spawn().unwrap()
}

/// The same, and waits for its end: the exit code, and what it said.
pub(crate) fn finish(line: &[&str]) -> (i32, String) {
    ended(start(line))
}

/// The exit code of a process, and what it said.
pub(crate) fn ended(process: Child) -> (i32, String) {
    let output = process.wait_with_output().unwrap();
    let said = [output.stdout, output.stderr].concat();
    (
        output.status.code().unwrap(),
        String::from_utf8(said).unwrap(),
    )
}

#[derive(Parser)]
struct Line {
    members: usize,
    steps: usize,
    #[command(subcommand)]
    command: eem::sweep::Command,
}

/// No test, but what the other process does.
#[test]
#[ignore = "the program that other tests start"]
fn process() {
    if let Ok(line) = env::var(LINE) {
        let line = Line::parse_from(["stones"].into_iter().chain(line.split('\n')));
        let code = execute(&line.command, &stones(line.members, line.steps));
        std::process::exit(code.into());
    }
}
