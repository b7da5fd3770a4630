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

/// How long a batch should take: what a killed process loses of each thread.
const BATCH: Duration = Duration::from_secs(1);

/// The most members of a batch whose size is not given, which bounds the memory.
const MOST: usize = 4096;

/// A batch has at most so many times as many members as the last, as a few of them say little about the others.
const GROWTH: usize = 8;

/// How many members the batches have.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Sizes {
    /// So many.
    Fixed(usize),
    /// What takes about a second: `next` now, but whole bundles of members that move together.
    Adapted { next: usize, bundle: usize },
}

impl Sizes {
    /// The first batch has one member, so that a process gets on however long members take.
    pub(crate) fn adapted(bundle: usize) -> Self {
        Self::Adapted { next: 1, bundle }
    }

    /// Members of the next batch when so many are left to so many threads.
    fn next(&self, left: usize, threads: usize) -> usize {
        match *self {
            Self::Fixed(size) => size,
            // Towards the end all threads get something.
            Self::Adapted { next, bundle } => next.min(left.div_ceil(threads).max(bundle)),
        }
    }

    /// After so many members have taken so long.
    fn adapt(&mut self, members: usize, took: Duration) {
        if let Self::Adapted { next, bundle } = self {
            let share = BATCH.as_secs_f64() / took.as_secs_f64().max(f64::MIN_POSITIVE);
            // At most GROWTH times MOST.
            let wanted = (members as f64 * share.min(GROWTH as f64)) as usize;
            *next = (wanted / *bundle * *bundle).clamp(*bundle, MOST);
        }
    }
}

/// Where and as what members are reported.
#[derive(Clone, Copy)]
pub(crate) struct Task<'t> {
    pub(crate) directory: &'t Path,
    /// That of the run, for files about it.
    pub(crate) name: &'t str,
    pub(crate) shelf: Shelf<'t>,
    pub(crate) job: &'t Job<'t>,
    pub(crate) generation: u32,
}

/// What threads take from, and tell.
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

/// Runs members on so many threads, one of which is the calling one, and reports them; says how many there were, and
/// how many have failed. An error ends it when all threads have reported what they are at.
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
    /// What one thread does.
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

    /// A thread that panics has left nothing half done.
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

    /// So many members more are done.
    fn tick(&self, members: usize) {
        let before = self.at_hand.fetch_add(members, Ordering::Relaxed);
        // Nobody waits in order to tell.
        if let Ok(mut queue) = self.queue.try_lock() {
            queue.teller.at_hand(before + members);
        }
    }
}

/// Ids and inputs of members.
fn fill(batch: &mut Batch, inputs: &Inputs, places: &[usize]) {
    batch.ids.clear();
    batch.inputs.clear();
    for &place in places {
        batch.ids.push(inputs.id(place));
        inputs.push_values(place, &mut batch.inputs);
    }
}

/// Reports a batch: one file, there whole or not at all.
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
        for bundle in [1, 4] {
            let mut sizes = Sizes::adapted(bundle);
            assert_eq!(sizes.next(1000, 4), 1);
            // Members of ten minutes.
            for _ in 0..3 {
                sizes.adapt(1, 600 * second);
                assert_eq!(sizes.next(1000, 4), bundle);
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
            assert_eq!(sizes.next(1, 4), bundle);
            for _ in 0..9 {
                sizes.adapt(sizes.next(1_000_000, 1), Duration::ZERO);
            }
            assert_eq!(sizes.next(1_000_000, 1), MOST);
        }
        assert_eq!(Sizes::Fixed(7).next(1000, 4), 7);
    }
}
