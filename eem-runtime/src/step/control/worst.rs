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

/// The unknown with the largest error, with its error and what the tolerance allows.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Worst {
    pub(crate) found: Option<(Unknown, [f64; 2])>,
}

impl Worst {
    pub(crate) const fn none() -> Self {
        Self { found: None }
    }

    /// Takes an error if it is the largest so far, as a share of what is allowed.
    pub(crate) fn see(&mut self, unknown: Unknown, [error, allowed]: [f64; 2]) {
        let is_larger = match self.found {
            None => error > 0.0,
            Some((_, [largest, scale])) => largest * allowed < error * scale,
        };
        if is_larger {
            self.found = Some((unknown, [error, allowed]));
        }
    }
}
