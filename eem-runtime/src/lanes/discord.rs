//! Whether lanes had to take one decision and would have taken different ones.
//!
//! A comparison that holds in some lanes only is noted here, wherever it is made: by this crate, by a
//! material or by the caller. What was computed meanwhile is good only if there has been none, and then
//! it is what every lane would have computed alone.

use core::cell::Cell;

std::thread_local! {
    static NOTED: Cell<bool> = const { Cell::new(false) };
}

/// Lanes differ in a decision.
#[cold]
pub(crate) fn note() {
    NOTED.set(true);
}

/// What `work` returns, unless lanes differed in a decision meanwhile.
///
/// Works within works do not disturb each other: a thread that waits for others may take up another
/// bundle in the middle of one.
pub(crate) fn unless_any<T>(work: impl FnOnce() -> Option<T>) -> Option<T> {
    let outer = NOTED.replace(false);
    let result = work();
    let noted = NOTED.replace(outer);
    result.filter(|_| !noted)
}
