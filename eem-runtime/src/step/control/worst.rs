//! The unknown whose error limits a step.

use eem_material::number::scalar::{Mask, Real};

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
pub(crate) struct Worst<S> {
    pub(crate) found: Option<(Unknown, [S; 2])>,
}

impl<S: Real> Worst<S> {
    pub(crate) const fn none() -> Self {
        Self { found: None }
    }

    /// Takes an error if it is the largest so far, as a share of what is allowed.
    pub(crate) fn see(&mut self, unknown: Unknown, [error, allowed]: [S; 2]) {
        let is_larger = match self.found {
            None => S::zero().less(error).all(),
            Some((_, [largest, scale])) => (largest * allowed).less(error * scale).all(),
        };
        if is_larger {
            self.found = Some((unknown, [error, allowed]));
        }
    }
}
