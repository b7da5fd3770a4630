//! Two independent tasks, at the same time if a thread of the current rayon pool is free.
//!
//! Where work is divided never depends on the number of threads, so that results do not either.

/// A task, whatever it does; its outcome is left where it can be found. Not generic, so that rayon is compiled once
/// and not for each material.
pub(crate) type Task<'a> = &'a mut (dyn FnMut() + Send);

/// Runs both tasks.
pub(crate) fn join(first: Task<'_>, second: Task<'_>) {
    #[cfg(feature = "parallel")]
    {
        rayon::join(first, second);
    }
    #[cfg(not(feature = "parallel"))]
    {
        first();
        second();
    }
}
