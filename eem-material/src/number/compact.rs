//! Indices of 32 bits, half the size of a `usize`.

/// An index in 32 bits; more entries would need hundreds of gigabytes.
#[must_use]
pub fn compact(number: usize) -> u32 {
    match u32::try_from(number) {
        Ok(number) => number,
        Err(_) => unreachable!("2³² of them do not fit the memory"),
    }
}
