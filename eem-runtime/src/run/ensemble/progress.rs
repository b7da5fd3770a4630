//! How many members are done, told in order; and whether further ones begin.

use core::fmt;
use core::ops::ControlFlow;
use core::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};

use super::error::MemberFailure;

/// Called with the number of members done and of all members.
pub(super) type Watch<'w> = Box<dyn FnMut(usize, usize) -> ControlFlow<()> + Send + 'w>;

/// The progress of one ensemble, shared by its threads.
pub(super) struct Progress<'w> {
    total: usize,
    stopped: AtomicBool,
    done: Option<Mutex<(usize, Watch<'w>)>>,
}

impl fmt::Debug for Progress<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Progress")
            .field("total", &self.total)
            .field("stopped", &self.stopped)
            .finish_non_exhaustive()
    }
}

impl<'w> Progress<'w> {
    /// Nothing is done yet; without a watch there is no count.
    pub(super) fn new(watch: Option<Watch<'w>>, total: usize) -> Self {
        Self {
            total,
            stopped: AtomicBool::new(false),
            done: watch.map(|watch| Mutex::new((0, watch))),
        }
    }

    /// Runs a member, unless the ensemble was stopped, and reports that it is done.
    pub(super) fn follow<T>(
        &self,
        member: impl FnOnce() -> Result<T, MemberFailure>,
    ) -> Result<T, MemberFailure> {
        if self.is_stopped() {
            return Err(MemberFailure::Stopped);
        }
        let result = member();
        self.report();
        result
    }

    /// The same for several members that are run by one call.
    pub(super) fn follow_all<T>(
        &self,
        count: usize,
        members: impl FnOnce() -> Vec<Result<T, MemberFailure>>,
    ) -> Vec<Result<T, MemberFailure>> {
        if self.is_stopped() {
            return (0..count).map(|_| Err(MemberFailure::Stopped)).collect();
        }
        let results = members();
        for _ in 0..count {
            self.report();
        }
        results
    }

    fn is_stopped(&self) -> bool {
        self.stopped.load(Ordering::Relaxed)
    }

    /// Another member is done.
    fn report(&self) {
        if let Some(done) = &self.done {
            // A watch that panicked ends the ensemble; until then the count is still right.
            let mut done = done.lock().unwrap_or_else(PoisonError::into_inner);
            let (count, watch) = &mut *done;
            *count += 1;
            if watch(*count, self.total).is_break() {
                self.stopped.store(true, Ordering::Relaxed);
            }
        }
    }
}
