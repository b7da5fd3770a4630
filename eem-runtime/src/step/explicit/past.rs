//! What an explicit scheme keeps between steps, as it is saved.

use eem_material::number::compensated::Sum;
use eem_material::number::digest::Digest;
use eem_material::number::scalar::Real;

/// Targets, what reservoirs have received from each component, and the rates of the present state, bit for
/// bit.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields)
)]
pub(crate) struct SavedExplicit<S> {
    /// Whether the next step takes rates and targets from the state instead of what follows.
    pub(crate) is_new: bool,
    /// The state that it belongs to.
    pub(crate) state: Digest,
    pub(crate) is_motion_first: bool,
    /// All sums of each component.
    pub(crate) targets: Vec<Sum<S>>,
    pub(crate) shares: Vec<Sum<S>>,
    pub(crate) held_energies: Vec<S>,
    pub(crate) largest_momentum: S,
    pub(crate) residue: S,
    pub(crate) rates: Vec<S>,
    pub(crate) productions: Vec<S>,
    pub(crate) supply: Vec<S>,
    pub(crate) loads: Vec<S>,
    pub(crate) forces: Vec<S>,
}

impl<S: Real> SavedExplicit<S> {
    /// All sums with their names.
    pub(crate) fn sums(&self) -> [(&'static str, &[Sum<S>]); 2] {
        [
            ("targets", &self.targets),
            ("shares of reservoirs", &self.shares),
        ]
    }

    /// Forgets what belongs to no state.
    pub(super) fn clear(&mut self) {
        self.targets.fill(Sum::new(S::zero()));
        self.shares.fill(Sum::new(S::zero()));
        (self.largest_momentum, self.residue) = (S::zero(), S::zero());
        let lists = [
            &mut self.held_energies,
            &mut self.rates,
            &mut self.productions,
            &mut self.supply,
            &mut self.loads,
            &mut self.forces,
        ];
        for list in lists {
            list.fill(S::zero());
        }
    }

    /// All lists with their names.
    pub(crate) fn lists(&self) -> [(&'static str, &[S]); 6] {
        [
            ("rates", &self.rates),
            ("productions of dashpots", &self.productions),
            ("powers of thermostats", &self.supply),
            ("energies of thermostats", &self.held_energies),
            ("loads with weights", &self.loads),
            ("loads", &self.forces),
        ]
    }
}
