//! How long tests run.

/// Whether `EEM_LONG` is set: a weekly job sets it, and runs are as long as they have ever been.
pub fn is_long() -> bool {
    std::env::var_os("EEM_LONG").is_some()
}

/// The first of two lengths with `EEM_LONG`, else the second.
pub fn at_length<T>(long: T, short: T) -> T {
    if is_long() { long } else { short }
}

/// All cases with `EEM_LONG`, else one for each index in turn: who goes through many models meets every case with some of them.
pub fn in_turn<T>(cases: &[T], index: usize) -> &[T] {
    if is_long() {
        cases
    } else {
        std::slice::from_ref(&cases[index % cases.len()])
    }
}
