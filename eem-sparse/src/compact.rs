//! Indices in 32 bits, which halves the memory of a pattern.

/// An index as `u32`. An index that does not fit would need a pattern of 16 GB.
pub(crate) fn compact(number: usize) -> u32 {
    match u32::try_from(number) {
        Ok(number) => number,
        Err(_) => unreachable!("a pattern has fewer than 2³² blocks"),
    }
}
