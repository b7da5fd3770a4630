//! Two independent tasks, at the same time if a thread of the current rayon pool is free.
//!
//! Where the work is split never depends on the number of threads, so results do not either.

/// Whether work is split into tasks at all.
pub(crate) const DIVIDE: bool = cfg!(feature = "parallel");

/// Runs a task on a thread of the pool, unless the pool has only one: then its joins need not wake a thread each time.
#[cfg(feature = "parallel")]
pub(crate) fn enter(task: impl FnOnce() + Send) {
    if rayon::current_num_threads() > 1 {
        rayon::scope(|_| task());
    } else {
        task();
    }
}

/// Runs a task.
#[cfg(not(feature = "parallel"))]
pub(crate) fn enter(task: impl FnOnce()) {
    task();
}

/// Runs both tasks, in parallel if a thread is free.
#[cfg(feature = "parallel")]
pub(crate) fn join(first: impl FnOnce() + Send, second: impl FnOnce() + Send) {
    if rayon::current_num_threads() > 1 {
        rayon::join(first, second);
    } else {
        first();
        second();
    }
}

/// Runs one task after the other.
#[cfg(not(feature = "parallel"))]
pub(crate) fn join(first: impl FnOnce(), second: impl FnOnce()) {
    first();
    second();
}
