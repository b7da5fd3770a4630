//! Numbers and places in half the memory.

/// A number that fits; more than it can count would need hundreds of gigabytes.
#[must_use]
pub fn compact(number: usize) -> u32 {
    match u32::try_from(number) {
        Ok(number) => number,
        Err(_) => unreachable!("2³² of them do not fit the memory"),
    }
}
