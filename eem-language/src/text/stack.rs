//! A stack that is deep enough for every model that is accepted.

use std::panic::resume_unwind;
use std::thread;

/// Bytes of the stack; only those that are used take memory. Nested types cost most: 35 KiB a level in a debug build, and
/// there are 1000 at most.
const STACK: usize = 64 << 20;

/// Does recursive work on a thread of its own, or on the calling thread if there are no threads.
pub(super) fn on_deep_stack<T: Send>(work: impl Fn() -> T + Sync) -> T {
    thread::scope(|scope| {
        let builder = thread::Builder::new().stack_size(STACK);
        match builder.spawn_scoped(scope, &work) {
            Ok(thread) => thread.join().unwrap_or_else(|panic| resume_unwind(panic)),
            Err(_) => work(),
        }
    })
}
