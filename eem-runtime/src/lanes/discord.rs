//! Whether lanes had to take one decision and would have taken different ones.
//!
//! A comparison with an operator that holds in some lanes only is noted here, wherever it is made: by this
//! crate, by a material or by the caller. What was computed meanwhile is good only if there has been none,
//! and then it is what every lane would have computed alone.

use core::cell::Cell;
use std::panic::{self, AssertUnwindSafe};

std::thread_local! {
    static NOTED: Cell<bool> = const { Cell::new(false) };
}

/// Lanes cannot go on together.
#[cold]
pub(crate) fn note() {
    NOTED.set(true);
}

/// Whether that has been noted since the work began.
#[inline]
pub(crate) fn is_noted() -> bool {
    NOTED.get()
}

/// What `work` returns, unless lanes differed in a decision meanwhile. A panic that comes of that goes no
/// further: alone, no lane might have had it.
///
/// Works within works do not disturb each other: a thread that waits for others may take up another
/// bundle in the middle of one.
pub(crate) fn unless_any<T>(work: impl FnOnce() -> Option<T>) -> Option<T> {
    let outer = NOTED.replace(false);
    // After a panic nothing of the work is looked at.
    let result = panic::catch_unwind(AssertUnwindSafe(work));
    let noted = NOTED.replace(outer);
    match result {
        Ok(result) => result.filter(|_| !noted),
        Err(_) if noted => None,
        Err(panic) => panic::resume_unwind(panic),
    }
}

#[cfg(test)]
mod tests {
    use super::{is_noted, note, unless_any};
    use std::panic;

    #[test]
    fn what_was_noted_is_forgotten_with_the_work() {
        assert_eq!(unless_any(|| Some(1)), Some(1));
        let differ = || {
            note();
            Some(2)
        };
        let inner = || unless_any(differ).is_none() && !is_noted();
        assert_eq!(unless_any(|| Some(inner())), Some(true));
        assert!(!is_noted());
    }

    #[test]
    #[expect(clippy::panic, reason = "this is about panics")]
    fn a_panic_is_the_works_own_unless_lanes_differed() {
        let differ = || -> Option<()> {
            note();
            panic!("none of the comparisons held")
        };
        assert_eq!(unless_any(differ), None);
        let own = || unless_any(|| -> Option<()> { panic!("of every lane") });
        assert!(panic::catch_unwind(own).is_err());
        assert!(!is_noted());
    }
}
