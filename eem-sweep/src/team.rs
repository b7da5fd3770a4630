//! Threads that take members batch by batch; a batch is reported as a part before its thread takes the next one.

use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use crate::begun::Note;
use crate::error::SweepError;
use crate::files::failed;
use crate::format::Writer;
use crate::inputs::Inputs;
use crate::job::Job;
use crate::part::Shelf;
use crate::places::Places;
use crate::progress::Teller;
use crate::record::Batch;

/// The time that a batch should take: a killed process loses as much per thread.
const BATCH: Duration = Duration::from_secs(1);

/// The most members of a batch whose size is not given, which bounds the memory.
const MOST: usize = 4096;

/// The largest factor by which a batch may exceed the last one, as a few members say little about the others.
const GROWTH: usize = 8;

/// The number of members of the batches.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Sizes {
    /// Always this many.
    Fixed(usize),
    /// As many as take about a second: `next` at present.
    Adapted { next: usize },
}

impl Sizes {
    /// The first batch has one member, so that a process gets on however long members take.
    pub(crate) fn adapted() -> Self {
        Self::Adapted { next: 1 }
    }

    /// Members of the next batch when `left` members remain for `threads` threads.
    fn next(&self, left: usize, threads: usize) -> usize {
        match *self {
            Self::Fixed(size) => size,
            // Towards the end all threads get something.
            Self::Adapted { next } => next.min(left.div_ceil(threads)),
        }
    }

    /// Adapts the size after a batch of `members` has taken this time.
    fn adapt(&mut self, members: usize, took: Duration) {
        if let Self::Adapted { next } = self {
            let share = BATCH.as_secs_f64() / took.as_secs_f64().max(f64::MIN_POSITIVE);
            // At most GROWTH times MOST.
            let wanted = (members as f64 * share.min(GROWTH as f64)) as usize;
            *next = wanted.clamp(1, MOST);
        }
    }
}

/// How members are run, and where they are reported.
#[derive(Clone, Copy)]
pub(crate) struct Task<'t> {
    pub(crate) directory: &'t Path,
    /// The name of the run, for files about it.
    pub(crate) name: &'t str,
    pub(crate) shelf: Shelf<'t>,
    pub(crate) job: &'t Job<'t>,
    pub(crate) generation: u32,
}

/// The members that are left and the progress, which threads share.
struct Queue<'q, P> {
    places: P,
    left: usize,
    sizes: Sizes,
    teller: &'q mut Teller,
    ran: usize,
    failed: usize,
    error: Option<SweepError>,
}

/// Threads at work.
struct Team<'t, P> {
    task: Task<'t>,
    threads: usize,
    queue: Mutex<Queue<'t, P>>,
    /// Members that are done and not yet reported.
    at_hand: AtomicUsize,
}

/// Runs members on this many threads, one of which is the calling one, and reports them. Returns how many there were, and
/// how many have failed. After an error, threads report their present batch and take no other.
pub(crate) fn run(
    task: Task<'_>,
    places: &Places,
    threads: usize,
    sizes: Sizes,
    teller: &mut Teller,
) -> Result<(usize, usize), SweepError> {
    let left = places.count();
    let team = Team {
        task,
        threads: threads.clamp(1, left.max(1)),
        queue: Mutex::new(Queue {
            places: places.iter(),
            left,
            sizes,
            teller,
            ran: 0,
            failed: 0,
            error: None,
        }),
        at_hand: AtomicUsize::new(0),
    };
    thread::scope(|scope| {
        for _ in 1..team.threads {
            // Where the system refuses a thread, the others do its work.
            let _refused = thread::Builder::new().spawn_scoped(scope, || team.work());
        }
        team.work();
    });
    let queue = team.queue.into_inner();
    let queue = queue.unwrap_or_else(PoisonError::into_inner);
    match queue.error {
        Some(error) => Err(error),
        None => Ok((queue.ran, queue.failed)),
    }
}

impl<'t, P: Iterator<Item = usize> + Send> Team<'t, P> {
    /// Runs batches on one thread until none is left.
    fn work(&self) {
        let Task { shelf, job, .. } = self.task;
        let note = Note::new(self.task.directory, self.task.name);
        let mut batch = Batch::default();
        loop {
            let chosen = self.take();
            if chosen.is_empty() {
                return;
            }
            note.begin(&chosen);
            fill(&mut batch, shelf.inputs, &chosen);
            let begun = Instant::now();
            let mut done = 0;
            (job.run)(shelf.inputs.columns(), &mut batch, &mut |now| {
                self.tick(now - done);
                done = now;
            });
            let took = begun.elapsed();
            let reported = write_part(&self.task, &chosen, &batch);
            self.at_hand.fetch_sub(done, Ordering::Relaxed);
            let mut queue = self.queue();
            match reported {
                Ok(()) => {
                    queue.ran += chosen.len();
                    queue.failed += batch.failed();
                    queue.sizes.adapt(chosen.len(), took);
                    queue.teller.reported(chosen.len(), batch.failed());
                }
                Err(error) => {
                    queue.error.get_or_insert(error);
                }
            }
        }
    }

    /// The queue. A thread that panics leaves it consistent.
    fn queue(&self) -> MutexGuard<'_, Queue<'t, P>> {
        self.queue.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The next batch; empty when there is nothing left to do.
    fn take(&self) -> Vec<usize> {
        let mut queue = self.queue();
        if queue.error.is_some() {
            return Vec::new();
        }
        let size = queue.sizes.next(queue.left, self.threads).min(queue.left);
        queue.left -= size;
        queue.places.by_ref().take(size).collect()
    }

    /// Counts further members that are done.
    fn tick(&self, members: usize) {
        let before = self.at_hand.fetch_add(members, Ordering::Relaxed);
        // No thread waits to report progress.
        if let Ok(mut queue) = self.queue.try_lock() {
            queue.teller.at_hand(before + members);
        }
    }
}

/// Fills in ids and inputs of members.
fn fill(batch: &mut Batch, inputs: &Inputs, places: &[usize]) {
    batch.ids.clear();
    batch.inputs.clear();
    for &place in places {
        batch.ids.push(inputs.id(place));
        inputs.push_values(place, &mut batch.inputs);
    }
}

/// Reports a batch: one file, complete or absent.
fn write_part(task: &Task<'_>, chosen: &[usize], batch: &Batch) -> Result<(), SweepError> {
    let (Some(&first), Some(&last)) = (chosen.first(), chosen.last()) else {
        return Ok(());
    };
    let shelf = task.shelf;
    let mut bytes = Vec::new();
    let table = Writer::new(shelf.format, &mut bytes, shelf.heads);
    let written = table.and_then(|mut table| {
        table.batch(batch)?;
        table.finish()
    });
    written.map_err(failed("form a table in", shelf.folder))?;
    shelf.report(first..last + 1, chosen.len(), task.generation, &bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn batches_are_about_a_second_and_never_so_long_that_a_process_gets_nowhere() {
        let second = Duration::from_secs(1);
        let mut sizes = Sizes::adapted();
        assert_eq!(sizes.next(1000, 4), 1);
        // Members of ten minutes.
        for _ in 0..3 {
            sizes.adapt(1, 600 * second);
            assert_eq!(sizes.next(1000, 4), 1);
        }
        // Members of 10 ms: a hundred a second, reached step by step.
        let mut members = 1;
        for expected in [8, 64, 100, 100] {
            sizes.adapt(members, second * u32::try_from(members).unwrap() / 100);
            members = sizes.next(1000, 4);
            assert_eq!(members, expected);
        }
        // The last ones are divided.
        assert_eq!(sizes.next(40, 4), 10);
        assert_eq!(sizes.next(1, 4), 1);
        for _ in 0..9 {
            sizes.adapt(sizes.next(1_000_000, 1), Duration::ZERO);
        }
        assert_eq!(sizes.next(1_000_000, 1), MOST);
        assert_eq!(Sizes::Fixed(7).next(1000, 4), 7);
    }
}
