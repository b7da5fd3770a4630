//! Records which messages were written, for the test that every one has a case.

use std::cell::RefCell;
use std::collections::BTreeSet;
use std::panic::Location;

thread_local! {
    /// File and line of the messages written since the last [`take`].
    static WRITTEN: RefCell<BTreeSet<(String, u32)>> = const { RefCell::new(BTreeSet::new()) };
}

/// Remembers that a message was written.
pub(super) fn record(location: &'static Location<'static>) {
    let place = (location.file().to_owned(), location.line());
    WRITTEN.with_borrow_mut(|written| written.insert(place));
}

/// File and line of the messages written since the last call.
pub(crate) fn take() -> BTreeSet<(String, u32)> {
    WRITTEN.take()
}
