//! The numbers of a scene in a few words: whether two scenes have the same, and if not, which differ.

use crate::run::checkpoint::error::RestoreError;
use eem_material::number::digest::Digest;

/// The digests of all numbers of a scene that a state does not contain.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields)
)]
pub(crate) struct Numbers {
    /// Names and values of the parameters, by element.
    pub(crate) materials: Digest,
    pub(crate) masses: Digest,
    pub(crate) conductances: Digest,
    pub(crate) reservoirs: Digest,
    pub(crate) gravity: Digest,
}

impl Numbers {
    /// An error with the first kind of numbers that differ from those of a simulation.
    pub(super) fn compare(&self, simulation: &Self) -> Result<(), RestoreError> {
        let kinds = |numbers: &Self| {
            [
                ("parameters of materials", numbers.materials),
                ("masses", numbers.masses),
                ("conductances", numbers.conductances),
                ("temperatures of reservoirs", numbers.reservoirs),
                ("gravity", numbers.gravity),
            ]
        };
        let mut pairs = kinds(self).into_iter().zip(kinds(simulation));
        match pairs.find(|((_, own), (_, other))| own != other) {
            None => Ok(()),
            Some(((kind, _), _)) => Err(RestoreError::Numbers { kind }),
        }
    }
}
