//! What step control remembers from step to step.

use crate::step::control::{Controller, StepStatistics, Tolerance};

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
    /// The smallest step that may be taken, s.
    pub(crate) smallest: S,
}
