//! The part of a checkpoint that belongs to an explicit scheme.

use eem_material::number::compensated::Sum;
use eem_material::number::digest::Digest;

/// Targets, the entropies that reservoirs have received from each component, and the rates of the present state, bit for
/// bit.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields)
)]
pub(crate) struct SavedExplicit {
    /// Whether the next step takes rates and targets from the state instead of what follows.
    pub(crate) is_new: bool,
    /// The digest of the state that it belongs to.
    pub(crate) state: Digest,
    pub(crate) is_motion_first: bool,
    /// All sums of the targets of each component.
    pub(crate) targets: Vec<Sum>,
    pub(crate) shares: Vec<Sum>,
    pub(crate) largest_momentum: f64,
    pub(crate) residue: f64,
    /// The rates of the stage vector, of dashpots and of thermostats.
    pub(crate) rates: Vec<f64>,
    /// The loads with weights, then without them.
    pub(crate) loads: Vec<f64>,
}

impl SavedExplicit {
    /// All sums with their names.
    pub(crate) fn sums(&self) -> [(&'static str, &[Sum]); 2] {
        [
            ("targets", &self.targets),
            ("shares of reservoirs", &self.shares),
        ]
    }

    /// All lists with their names.
    pub(crate) fn lists(&self) -> [(&'static str, &[f64]); 2] {
        [("rates", &self.rates), ("loads", &self.loads)]
    }
}
