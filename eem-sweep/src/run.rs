//! What a process runs: which members are missing or have failed, and in which order they come.

use std::path::Path;
use std::thread;

use crate::begun;
use crate::error::SweepError;
use crate::format::Format;
use crate::job::giving_up;
use crate::part::Shelf;
use crate::places::{Places, extend};
use crate::progress::Teller;
use crate::selection::Selection;
use crate::sweep::{Opened, Sweep};
use crate::team::{self, Sizes, Task};
use crate::walk::walk;

/// The generation of members that are given up: a record of a process that is still running one supersedes it.
const GIVEN_UP: u32 = 0;

/// The generation of the first run of a member.
const FIRST_RUN: u32 = 1;

/// How a process runs its members. Records do not depend on it.
///
/// ```
/// use eem::sweep::{RunOptions, Selection};
///
/// let options = RunOptions {
///     selection: Selection::Shard { index: 2, count: 8 },
///     threads: 1,
///     ..RunOptions::default()
/// };
/// assert_eq!(options.selection.to_string(), "shard-2-of-8");
/// assert!(options.batch.is_none());
/// ```
#[derive(Clone, Debug, Default)]
pub struct RunOptions {
    /// Which members. Default: all.
    pub selection: Selection,
    /// Threads; 0, the default, is one for each core that the process may use.
    pub threads: usize,
    /// The format of all tables. Default: that of the directory, or CSV in a new one.
    pub format: Option<Format>,
    /// How many members a thread reports at once. Default: what takes about a second, at most 4096, and never less
    /// than one. Fewer lose less when the process is killed, more need fewer files; a file is read as a whole.
    pub batch: Option<usize>,
    /// Whether a bar shows the progress on a terminal.
    pub bar: bool,
}

/// What a process has done.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RunReport {
    /// Members that were selected.
    pub members: usize,
    /// Members that had been reported before, by any process.
    pub skipped: usize,
    /// Members that were run now.
    pub ran: usize,
    /// Members of the selection that have failed, now or before.
    pub failed: usize,
}

impl Sweep<'_> {
    /// Runs the selected members that nobody has reported yet, and reports them in `directory`.
    ///
    /// It can be called again whatever has happened: reported members are skipped, and members during which a process
    /// ended come last, in small batches. Processes that run at the same time should be given different members;
    /// those that they have in common are run twice, and [`merge`](Self::merge) proves that both records have the
    /// same bits.
    ///
    /// # Errors
    ///
    /// [`SweepError`] if the directory is of another sweep, a file cannot be written, or the selection does not
    /// exist. Members that fail are no error.
    pub fn run(&self, directory: &Path, options: &RunOptions) -> Result<RunReport, SweepError> {
        self.job.check(self.inputs().row(0, &mut Vec::new()))?;
        let wanted = options.selection.places(self.inputs())?;
        let opened = self.open(directory, options.format, true)?;
        let seen = Seen::of(&opened.shelf(), &wanted)?;
        let mut report = RunReport {
            members: wanted.count(),
            skipped: seen.reported.count(),
            ran: 0,
            failed: seen.failed.count(),
        };
        let missing = wanted.without(&seen.reported);
        let name = options.selection.to_string();
        let work = (&wanted, &missing, FIRST_RUN, name.as_str());
        self.run_places(directory, &opened, options, work, &mut report)?;
        Ok(report)
    }

    /// Runs the selected members again whose last record is a failure; the new record supersedes the old one.
    ///
    /// # Errors
    ///
    /// As for [`run`](Self::run), and if there is no sweep in the directory.
    pub fn rerun_failed(
        &self,
        directory: &Path,
        options: &RunOptions,
    ) -> Result<RunReport, SweepError> {
        let wanted = options.selection.places(self.inputs())?;
        let opened = self.open(directory, options.format, false)?;
        let seen = Seen::of(&opened.shelf(), &wanted)?;
        let mut report = RunReport {
            members: seen.failed.count(),
            ..RunReport::default()
        };
        let name = format!("rerun-{}", options.selection);
        // Notes of members that have not been reported are kept: they say which come last.
        let work = (
            &seen.reported,
            &seen.failed,
            seen.generation.saturating_add(1),
            name.as_str(),
        );
        self.run_places(directory, &opened, options, work, &mut report)?;
        Ok(report)
    }

    /// Reports the selected members that nobody has reported yet as failed ([`GivenUp`](crate::FailureKind::GivenUp))
    /// without running them. This is for members that end every process, by a stack overflow or for lack of memory.
    /// [`rerun_failed`](Self::rerun_failed) runs them nevertheless.
    ///
    /// # Errors
    ///
    /// As for [`run`](Self::run), and if there is no sweep in the directory.
    pub fn give_up(
        &self,
        directory: &Path,
        selection: &Selection,
    ) -> Result<RunReport, SweepError> {
        let wanted = selection.places(self.inputs())?;
        let opened = self.open(directory, None, false)?;
        let seen = Seen::of(&opened.shelf(), &wanted)?;
        let missing = wanted.without(&seen.reported);
        let name = format!("given-up-{selection}");
        let task = Task {
            directory,
            name: &name,
            shelf: opened.shelf(),
            job: &giving_up(opened.heads().outputs.len()),
            generation: GIVEN_UP,
        };
        let mut teller = Teller::new(directory, &name, missing.count(), false);
        let (ran, failed) = team::run(task, &missing, 1, Sizes::adapted(), &mut teller)?;
        begun::forget(directory, &wanted);
        Ok(RunReport {
            members: wanted.count(),
            skipped: seen.reported.count(),
            ran,
            failed: seen.failed.count() + failed,
        })
    }

    /// Runs places, and reports them as parts of a generation. All `settled` places are reported then, so their notes are
    /// removed. `name` is that of files about the run.
    fn run_places(
        &self,
        directory: &Path,
        opened: &Opened<'_>,
        options: &RunOptions,
        (settled, places, generation, name): (&Places, &Places, u32, &str),
        report: &mut RunReport,
    ) -> Result<(), SweepError> {
        let mut teller = Teller::new(directory, name, places.count(), options.bar);
        let threads = match options.threads {
            0 => thread::available_parallelism().map_or(1, usize::from),
            threads => threads,
        };
        let task = Task {
            directory,
            name,
            shelf: opened.shelf(),
            job: &self.job,
            generation,
        };
        for class in begun::classes(directory, places) {
            let sizes = match class.batch.into_iter().chain(options.batch).min() {
                Some(members) => Sizes::Fixed(members.max(1)),
                None => Sizes::adapted(),
            };
            let threads = threads.checked_shr(class.halvings).unwrap_or(0);
            let (ran, failed) = team::run(task, &class.places, threads, sizes, &mut teller)?;
            report.ran += ran;
            report.failed += failed;
        }
        teller.finish();
        begun::forget(directory, settled);
        Ok(())
    }
}

/// The records that some members have.
struct Seen {
    reported: Places,
    /// Those whose last record is a failure.
    failed: Places,
    /// The largest generation of failures.
    generation: u32,
}

impl Seen {
    fn of(shelf: &Shelf<'_>, wanted: &Places) -> Result<Self, SweepError> {
        let mut parts = shelf.parts()?;
        parts.retain(|part| wanted.touches(&part.span));
        let (mut reported, mut failed, mut generation) = (Vec::new(), Vec::new(), 0);
        walk(shelf, &parts, |found| {
            extend(&mut reported, found.place);
            if found.reader.has_failed() {
                extend(&mut failed, found.place);
                generation = generation.max(found.generation);
            }
            Ok(())
        })?;
        Ok(Self {
            reported: Places::new(reported).within(wanted),
            failed: Places::new(failed).within(wanted),
            generation,
        })
    }
}
