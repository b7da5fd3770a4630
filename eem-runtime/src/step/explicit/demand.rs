//! The required accuracy of a step, and the magnitudes to which its errors are relative.

use crate::step::control::Tolerance;
use crate::step::scheme::Scheme;

/// The required accuracy of a step.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Demand {
    /// None: the step has a fixed size.
    None,
    /// Its error is within this tolerance.
    Within(Tolerance),
}

/// The largest correction of a fixed step that counts as truncation. A vibration at half of the limit of stability
/// loses 1 − |R(2.98 i)|² = 2.9e-3 of its energy in a step; one whose frequency rises by an eighth meanwhile loses this.
const LARGEST_FIXED_CORRECTION: f64 = 1e-2;

/// Up to this difference from a rigid rotation a fixed step may be replaced by one.
const LARGEST_FIXED_TURN: f64 = 1e-7;

/// The fraction of the tolerance by which a rigid rotation may differ from the stages.
const TURN_SHARE: f64 = 0.1;

impl Demand {
    /// The largest energy defect before closing, relative to the terms of the energy.
    pub(super) fn largest_correction(self) -> f64 {
        match self {
            Self::None => LARGEST_FIXED_CORRECTION,
            Self::Within(tolerance) => tolerance.relative,
        }
    }

    /// The largest relative change of motion and shape that step control does not feel: steps keep their size with an error of this
    /// size. Those of a fixed size have none.
    pub(super) fn largest_change(self) -> f64 {
        match self {
            Self::None => f64::INFINITY,
            Self::Within(tolerance) => {
                Scheme::EemExplicit.accuracy().settled() * tolerance.relative
            }
        }
    }

    /// The largest relative difference of a rigid rotation from the stages.
    pub(super) fn largest_turn(self) -> f64 {
        match self {
            Self::None => LARGEST_FIXED_TURN,
            Self::Within(tolerance) => TURN_SHARE * tolerance.relative,
        }
    }
}

/// The magnitudes of positions and momenta.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scales {
    /// |q|₂ of all masses, m.
    pub(super) position: f64,
    /// |p|₂, the largest so far, kg m/s.
    pub(super) momentum: f64,
}
