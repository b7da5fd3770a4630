//! Two independent tasks, in parallel if a thread of the current rayon pool is free.
//!
//! The division of work never depends on the number of threads, so that results do not either.

/// A task, which stores its result itself. Not generic, so that rayon is compiled once and not for each material.
pub(crate) type Task<'a> = &'a mut (dyn FnMut() + Send);

/// Runs a task on a thread of the pool, unless that is the only one: its joins then need not wake a thread each time.
pub(crate) fn enter(task: Task<'_>) {
    #[cfg(feature = "parallel")]
    if rayon::current_num_threads() > 1 {
        return rayon::scope(|_| task());
    }
    task();
}

/// Runs both tasks.
pub(crate) fn join(first: Task<'_>, second: Task<'_>) {
    #[cfg(feature = "parallel")]
    if rayon::current_num_threads() > 1 {
        rayon::join(first, second);
        return;
    }
    first();
    second();
}
