//! The unknown whose error limits a step.

/// An unknown of the state, by its index there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Unknown {
    /// A coordinate.
    Position(usize),
    /// A component of a momentum, by coordinate.
    Momentum(usize),
    /// A viscous stretch or strain.
    Viscous(usize),
    /// A temperature, by thermal slot.
    Temperature(usize),
}

/// An unknown, with its error and what the tolerance allows.
pub(crate) type UnknownError = (Unknown, [f64; 2]);

/// Takes an error if it is the largest so far, as a share of what is allowed.
pub(crate) fn see_worst(worst: &mut Option<UnknownError>, unknown: Unknown, error: [f64; 2]) {
    let [size, allowed] = error;
    let is_larger = match worst {
        None => size > 0.0,
        Some((_, [largest, scale])) => *largest * allowed < size * *scale,
    };
    if is_larger {
        *worst = Some((unknown, error));
    }
}
