//! The error of a step as a function of its size, and the largest that is accepted.

use eem_material::number::scalar::{Mask, Real};

/// The error that a step aims at, in units of the tolerance.
pub(super) const AIM: f64 = 0.8;

/// The error beyond which a step in two halves is rejected, in units of the tolerance.
const MOST: f64 = 1.2;

/// The least fraction of the step size after a rejected step.
const LEAST_AFTER_ERROR: f64 = 0.2;

/// The error of a scheme as a function of its step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Accuracy {
    /// p: the error of a step is of order p + 1.
    pub(crate) order: u8,
    pub(crate) estimate: Estimate,
}

/// The source of the error estimate of a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Estimate {
    /// The step in two halves. Tolerances are those of the state and not of a step.
    Halves,
    /// An embedded scheme; the estimate is of order p.
    Embedded,
}

/// Errors of fewer roundings cannot be distinguished from rounding.
const ROUNDINGS: f64 = 16.0;

impl Accuracy {
    pub(crate) fn order(self) -> f64 {
        f64::from(self.order)
    }

    /// The relative tolerance of a step.
    pub(super) fn of_step<S: Real>(self, relative: S) -> S {
        if self.estimate == Estimate::Halves {
            relative.powf(S::from_f64(1.0 + 1.0 / self.order()))
        } else {
            relative
        }
    }

    /// The smallest relative tolerance whose errors are above rounding.
    pub(super) fn floor<S: Real>(self) -> f64 {
        let rounding = ROUNDINGS * S::EPSILON.to_f64();
        if self.estimate == Estimate::Halves {
            rounding.powf(self.order() / (self.order() + 1.0))
        } else {
            rounding
        }
    }

    /// Whether a step with this error, in units of the tolerance, is accepted.
    pub(crate) fn accepts<S: Real>(self, error: S) -> bool {
        let most = match self.estimate {
            Estimate::Halves => MOST,
            Estimate::Embedded => 1.0,
        };
        error.at_most(S::from_f64(most)).all()
    }

    /// The fraction of its size with which a rejected step is tried again.
    pub(crate) fn left_after<S: Real>(self, error: S) -> S {
        let power = S::from_f64(-1.0 / self.order_of_estimate());
        let left = S::from_f64(AIM) * error.powf(power);
        let least = S::from_f64(LEAST_AFTER_ERROR);
        // NaN if the error is NaN.
        if least.less(left).all() { left } else { least }
    }

    /// The power of the step size to which its estimated error is proportional.
    pub(super) fn order_of_estimate(self) -> f64 {
        match self.estimate {
            Estimate::Halves => self.order() + 1.0,
            Estimate::Embedded => self.order(),
        }
    }
}
