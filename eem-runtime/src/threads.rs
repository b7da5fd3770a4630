//! Two pieces of one scene's work at once, on the threads of the present pool of rayon.
//!
//! How work is divided never depends on how many threads there are, so that numbers do not either.

/// Whether work is divided at all.
pub(crate) const DIVIDE: bool = cfg!(feature = "parallel");

/// Does both, at once if a thread is free.
#[cfg(feature = "parallel")]
pub(crate) fn join<A: Send, B: Send>(
    first: impl FnOnce() -> A + Send,
    second: impl FnOnce() -> B + Send,
) -> (A, B) {
    rayon::join(first, second)
}

/// Without threads.
#[cfg(not(feature = "parallel"))]
pub(crate) fn join<A, B>(first: impl FnOnce() -> A, second: impl FnOnce() -> B) -> (A, B) {
    (first(), second())
}
