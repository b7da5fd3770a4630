//! The progress of an ensemble: finished members are reported in order, and no member begins after a stop.

use core::ops::ControlFlow;
use core::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};

/// Called with the numbers of finished and of all members.
pub(super) type Watch<'w> = Box<dyn FnMut(usize, usize) -> ControlFlow<()> + Send + 'w>;

/// The progress of one ensemble, shared by its threads.
pub(super) struct Progress<'w> {
    total: usize,
    stopped: AtomicBool,
    done: Option<Mutex<(usize, Watch<'w>)>>,
}

impl<'w> Progress<'w> {
    pub(super) fn new(watch: Option<Watch<'w>>, total: usize) -> Self {
        Self {
            total,
            stopped: AtomicBool::new(false),
            done: watch.map(|watch| Mutex::new((0, watch))),
        }
    }

    /// Runs `count` members and reports each; `None` if the ensemble was stopped before.
    pub(super) fn follow<T>(&self, count: usize, members: impl FnOnce() -> T) -> Option<T> {
        if self.stopped.load(Ordering::Relaxed) {
            return None;
        }
        let results = members();
        (0..count).for_each(|_| self.report());
        Some(results)
    }

    fn report(&self) {
        if let Some(done) = &self.done {
            // A panic in `watch` ends the ensemble; until then the count is right.
            let mut done = done.lock().unwrap_or_else(PoisonError::into_inner);
            let (count, watch) = &mut *done;
            *count += 1;
            if watch(*count, self.total).is_break() {
                self.stopped.store(true, Ordering::Relaxed);
            }
        }
    }
}
