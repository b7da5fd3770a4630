//! What a checkpoint keeps of step control and of the choice of a scheme.

use crate::step::automatic::Choice;
use crate::step::control::{Controller, StepStatistics, Tolerance};
use crate::step::scheme::Scheme;

/// The history of step control.
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
    /// The limits of the step size, s.
    pub(crate) smallest: S,
    pub(crate) largest: S,
}

/// The scheme in use by `Scheme::Auto`, and the effort of both kinds of schemes.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields)
)]
pub(crate) struct SavedChoice {
    #[cfg_attr(feature = "serde", serde(with = "super::scheme_name"))]
    pub(crate) scheme: Scheme,
    /// The scheme before a trial.
    #[cfg_attr(feature = "serde", serde(with = "super::scheme_name"))]
    pub(crate) previous: Scheme,
    pub(crate) choice: Choice,
}
