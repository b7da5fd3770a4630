//! What step control remembers from step to step.

use crate::step::control::{Controller, StepStatistics, Tolerance};
use eem_material::number::scalar::Real;

/// What step control remembers from step to step.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields)
)]
pub(crate) struct SavedControl<S> {
    pub(crate) tolerance: Tolerance<S>,
    pub(crate) controller: Controller<S>,
    pub(crate) statistics: StepStatistics,
    /// The largest `|p|₂` so far, kg m/s.
    pub(crate) largest_momentum: S,
    /// The smallest and the largest step that may be taken, s.
    pub(crate) smallest: S,
    pub(crate) largest: S,
}

impl<S: Real> SavedControl<S> {
    /// The same for another scheme, to which the errors of earlier steps mean nothing.
    pub(crate) const fn after_change(self) -> Self {
        Self {
            controller: Controller::new(),
            ..self
        }
    }

    /// All sizes of steps, s.
    pub(super) fn sizes(&self) -> [Option<S>; 3] {
        let last = self.controller.last.map(|[_, size]| size);
        [Some(self.smallest), Some(self.largest), last]
    }

    /// What else has to be a number and not negative: the largest momentum, and the error of the last step.
    pub(super) fn others(&self) -> impl Iterator<Item = S> {
        let last = self.controller.last.map(|[error, _]| error);
        [self.largest_momentum].into_iter().chain(last)
    }
}
