//! How accurate a step has to be, and in which units.

use crate::number::scalar::Real;

/// How accurate a step has to be.
#[derive(Clone, Copy, Debug)]
#[allow(
    dead_code,
    reason = "fixed steps have no tolerance; a controller of the step size has"
)]
pub(crate) enum Accuracy<S> {
    /// As its size makes it.
    Fixed,
    /// Its error is at most this part of positions, momenta and temperatures.
    Within {
        /// The part.
        relative: S,
    },
}

/// The largest correction of a fixed step that counts as truncation.
const LARGEST_FIXED_CORRECTION: f64 = 1e-3;

/// Up to this difference from a rigid rotation a fixed step may be replaced by one.
const LARGEST_FIXED_TURN: f64 = 1e-7;

/// The part of the tolerance that a rigid rotation may differ by.
const TURN_SHARE: f64 = 0.1;

impl<S: Real> Accuracy<S> {
    /// The largest correction before closing, relative to the terms of the energy.
    pub(super) fn largest_correction(self) -> S {
        match self {
            Self::Fixed => S::from_f64(LARGEST_FIXED_CORRECTION),
            Self::Within { relative } => relative,
        }
    }

    /// By how much a rigid rotation may differ from what the stages say, relatively.
    pub(super) fn largest_turn(self) -> S {
        match self {
            Self::Fixed => S::from_f64(LARGEST_FIXED_TURN),
            Self::Within { relative } => S::from_f64(TURN_SHARE) * relative,
        }
    }
}

/// How large positions and momenta are.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scales<S> {
    /// |q|₂ of all masses, m.
    pub(super) position: S,
    /// |p|₂, the largest so far, kg m/s.
    pub(super) momentum: S,
}
