//! Which scheme a run with `Scheme::Auto` was using.

use crate::step::automatic::Choice;
use crate::step::scheme::Scheme;

/// The scheme in use, and what is remembered of both kinds.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields)
)]
pub(crate) struct SavedChoice {
    #[cfg_attr(feature = "serde", serde(with = "super::scheme_name"))]
    pub(crate) scheme: Scheme,
    /// That before a trial.
    #[cfg_attr(feature = "serde", serde(with = "super::scheme_name"))]
    pub(crate) previous: Scheme,
    pub(crate) choice: Choice,
}
