//! A process runs its members batch by batch; a batch is reported as a part before the next one begins.

use std::fs;
use std::path::Path;
use std::thread;
use std::time::{Duration, Instant};

use crate::error::SweepError;
use crate::files::{failed, publish};
use crate::format::{Format, Writer};
use crate::part::Shelf;
use crate::places::Places;
use crate::progress::Teller;
use crate::record::Batch;
use crate::selection::Selection;
use crate::sweep::{Opened, Sweep};
use crate::walk::walk;

/// How long a batch should take: what a killed process loses.
const BATCH: Duration = Duration::from_secs(1);

/// The most members of a batch, which bounds the memory.
const MOST: usize = 4096;

/// Members of the first batch, for each thread: those of one bundle of SIMD lanes.
const BUNDLE: usize = 4;

/// A batch has at most so many times as many members as the last, as a few of them say little about the others.
const GROWTH: usize = 8;

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
    /// Threads, with the feature `parallel`; 0, the default, is one for each core that the process may use.
    pub threads: usize,
    /// The format of all tables. Default: that of the directory, or CSV in a new one.
    pub format: Option<Format>,
    /// The most members that are reported at once. Default: what takes about a second, at most 4096. Fewer lose
    /// less when the process is killed; more leave threads waiting less often for the slowest member.
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
    /// It can be called again whatever has happened: what was reported is skipped. Processes that run at the same
    /// time should be given different members; if they have some in common, these are run twice, and
    /// [`merge`](Self::merge) proves that both have the same bits.
    ///
    /// # Errors
    ///
    /// [`SweepError`] if the directory is of another sweep, a file cannot be written, or the selection does not
    /// exist. Members that fail are no error.
    pub fn run(&self, directory: &Path, options: &RunOptions) -> Result<RunReport, SweepError> {
        self.job.check(self.inputs().row(0, &mut Vec::new()))?;
        let wanted = options.selection.places(self.inputs())?;
        let opened = self.open(directory, options.format, true)?;
        let shelf = opened.shelf();
        let mut parts = shelf.parts()?;
        let hull = (wanted.ranges().first(), wanted.ranges().last());
        parts.retain(|part| {
            let (start, end) = (part.span.start, part.span.end);
            matches!(hull, (Some(a), Some(b)) if start < b.end && end > a.start)
        });
        let reported = shelf.reported(&parts)?.within(&wanted);
        let mut report = RunReport {
            members: wanted.count(),
            skipped: reported.count(),
            ..RunReport::default()
        };
        let failed = failed_members(&shelf, &wanted)?.0;
        report.failed = failed.count();
        let missing = wanted.without(&reported);
        let name = options.selection.to_string();
        self.run_places(
            directory,
            &opened,
            options,
            (&missing, 0, &name),
            &mut report,
        )?;
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
        let (failed, generation) = failed_members(&opened.shelf(), &wanted)?;
        let mut report = RunReport {
            members: failed.count(),
            ..RunReport::default()
        };
        let name = format!("rerun-{}", options.selection);
        let work = (&failed, generation + 1, name.as_str());
        self.run_places(directory, &opened, options, work, &mut report)?;
        Ok(report)
    }

    /// Runs members and reports them as parts of a generation; `name` is that of the progress file.
    fn run_places(
        &self,
        directory: &Path,
        opened: &Opened<'_>,
        options: &RunOptions,
        (places, generation, name): (&Places, u32, &str),
        report: &mut RunReport,
    ) -> Result<(), SweepError> {
        let mut teller = Teller::new(directory, name, places.count(), options.bar);
        let mut sizes = Sizes::new(options);
        let mut rest = places.iter().peekable();
        let mut batch = Batch::default();
        while rest.peek().is_some() {
            let chosen: Vec<usize> = rest.by_ref().take(sizes.next).collect();
            self.fill(&mut batch, chosen.iter().copied());
            let begun = Instant::now();
            let columns = self.inputs().columns();
            (self.job.run)(columns, &mut batch, options.threads, &mut |done| {
                teller.at_hand(done);
            });
            sizes.adapt(chosen.len(), begun.elapsed());
            write_part(opened, &chosen, &batch, generation)?;
            report.ran += chosen.len();
            report.failed += batch.failed();
            teller.reported(chosen.len(), batch.failed());
        }
        teller.finish();
        Ok(())
    }

    /// Ids and inputs of members.
    fn fill(&self, batch: &mut Batch, places: impl Iterator<Item = usize>) {
        batch.ids.clear();
        batch.inputs.clear();
        for place in places {
            batch.ids.push(self.inputs().id(place));
            self.inputs().push_values(place, &mut batch.inputs);
        }
    }
}

/// The members that have failed, and the largest generation of their records.
fn failed_members(shelf: &Shelf<'_>, wanted: &Places) -> Result<(Places, u32), SweepError> {
    let mut parts = shelf.parts()?;
    parts.retain(|part| wanted.within(&Places::one(part.span.clone())).count() > 0);
    let (mut failed, mut generation) = (Vec::new(), 0);
    walk(shelf, &parts, |found| {
        if found.reader.has_failed() {
            failed.push(found.place..found.place + 1);
            generation = generation.max(found.generation);
        }
        Ok(())
    })?;
    Ok((Places::new(failed).within(wanted), generation))
}

/// How many members the batches have.
struct Sizes {
    next: usize,
    least: usize,
    most: usize,
}

impl Sizes {
    fn new(options: &RunOptions) -> Self {
        let threads = match options.threads {
            0 => thread::available_parallelism().map_or(1, usize::from),
            threads => threads,
        };
        let most = options.batch.unwrap_or(MOST).max(1);
        let least = (BUNDLE * threads).min(most);
        Self {
            next: least,
            least,
            most,
        }
    }

    /// After so many members have taken so long. Whole bundles, so that no lane is empty.
    fn adapt(&mut self, members: usize, took: Duration) {
        let share = BATCH.as_secs_f64() / took.as_secs_f64().max(f64::MIN_POSITIVE);
        let growth = share.min(GROWTH as f64);
        // At most GROWTH times MOST.
        let wanted = (members as f64 * growth) as usize;
        let bundles = (wanted / BUNDLE * BUNDLE).max(self.least);
        self.next = bundles.min(self.most);
    }
}

/// Reports a batch: one file, there whole or not at all.
fn write_part(
    opened: &Opened<'_>,
    chosen: &[usize],
    batch: &Batch,
    generation: u32,
) -> Result<(), SweepError> {
    let (Some(&first), Some(&last)) = (chosen.first(), chosen.last()) else {
        return Ok(());
    };
    let shelf = opened.shelf();
    let mut generation = generation;
    loop {
        let path = shelf.path(&(first..last + 1), chosen.len(), generation);
        let mut bytes = Vec::new();
        let table = Writer::new(shelf.format, &mut bytes, shelf.heads);
        let written = table.and_then(|mut table| {
            table.batch(batch)?;
            table.finish()
        });
        written.map_err(failed("form", &path))?;
        if publish(&path, |file| file.write_all(&bytes))? {
            return Ok(());
        }
        // Another process has reported a batch of this name: the same members, or others of a list with gaps.
        if fs::read(&path).map_err(failed("read", &path))? == bytes {
            return Ok(());
        }
        if last + 1 - first == chosen.len() {
            return Err(SweepError::Conflict {
                member: batch.ids[0],
                first: path.clone(),
                second: path,
            });
        }
        generation += 1;
    }
}
