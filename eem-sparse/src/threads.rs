//! Two independent tasks, at the same time if a thread of the current rayon pool is free.
//!
//! Where the work is split never depends on the number of threads, so results do not either.

/// Whether work is split into tasks at all.
pub(crate) const DIVIDE: bool = cfg!(feature = "parallel");

/// Runs both tasks, in parallel if a thread is free.
#[cfg(feature = "parallel")]
pub(crate) fn join<A: Send, B: Send>(
    first: impl FnOnce() -> A + Send,
    second: impl FnOnce() -> B + Send,
) -> (A, B) {
    rayon::join(first, second)
}

/// Runs one task after the other.
#[cfg(not(feature = "parallel"))]
pub(crate) fn join<A, B>(first: impl FnOnce() -> A, second: impl FnOnce() -> B) -> (A, B) {
    (first(), second())
}
