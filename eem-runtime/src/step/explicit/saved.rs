//! What an explicit scheme keeps between steps, as it is saved.

use super::Explicit;
use super::memory::Target;
use crate::number::compensated::Compensated;
use crate::number::scalar::Real;

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
    pub(crate) is_mechanical_first: bool,
    pub(crate) targets: Vec<Target<S>>,
    pub(crate) shares: Compensated<S>,
    pub(crate) held_energies: Vec<S>,
    pub(crate) largest_momentum: S,
    pub(crate) residue: S,
    pub(crate) rates: Vec<S>,
    pub(crate) powers: Vec<S>,
    pub(crate) supply: Vec<S>,
    pub(crate) reactions: Vec<S>,
    pub(crate) loads: Vec<S>,
    pub(crate) forces: Vec<S>,
}

impl<S: Real> SavedExplicit<S> {
    /// All sums with their names.
    pub(crate) fn sums(&self) -> [(&'static str, impl Iterator<Item = (S, S)> + Clone + '_); 1] {
        let of = |target: &Target<S>| {
            let single = [target.energy, target.lost];
            let all = single
                .into_iter()
                .chain(target.linear)
                .chain(target.angular);
            all.map(|sum| (sum.value, sum.carry))
        };
        [("targets", self.targets.iter().flat_map(of))]
    }

    /// Forgets what belongs to no state.
    fn clear(&mut self) {
        self.targets.fill(Target::none());
        self.shares.write(|shares| shares.fill(S::zero()));
        (self.largest_momentum, self.residue) = (S::zero(), S::zero());
        let lists = [
            &mut self.held_energies,
            &mut self.rates,
            &mut self.powers,
            &mut self.supply,
            &mut self.reactions,
            &mut self.loads,
            &mut self.forces,
        ];
        for list in lists {
            list.fill(S::zero());
        }
    }

    /// All lists with their names.
    pub(crate) fn lists(&self) -> [(&'static str, &[S]); 7] {
        [
            ("rates", &self.rates),
            ("powers of dashpots", &self.powers),
            ("powers of thermostats", &self.supply),
            ("reactions of anchors", &self.reactions),
            ("energies of thermostats", &self.held_energies),
            ("loads with weights", &self.loads),
            ("loads", &self.forces),
        ]
    }
}

impl<S: Real, const D: usize> Explicit<S, D> {
    /// What the next step depends on besides the state.
    pub(crate) fn save(&self) -> SavedExplicit<S> {
        let (books, start) = (&self.books, &self.start);
        let mut saved = SavedExplicit {
            is_new: !self.is_ready,
            is_mechanical_first: self.is_mechanical_first,
            targets: books.targets.clone(),
            shares: books.shares.clone(),
            held_energies: books.held_energies.clone(),
            largest_momentum: books.largest_momentum,
            residue: books.residue,
            rates: start.rates.clone(),
            powers: start.powers.clone(),
            supply: start.supply.clone(),
            reactions: start.reactions.as_flattened().to_vec(),
            loads: start.loads.clone(),
            forces: start.forces.clone(),
        };
        if saved.is_new {
            saved.clear();
        }
        saved
    }

    /// Goes on from what was saved of the same scene.
    pub(crate) fn restore(&mut self, saved: &SavedExplicit<S>) {
        self.is_ready = !saved.is_new;
        self.is_mechanical_first = saved.is_mechanical_first;
        let (books, start) = (&mut self.books, &mut self.start);
        books.targets.copy_from_slice(&saved.targets);
        books.shares.copy_from(&saved.shares);
        books.held_energies.copy_from_slice(&saved.held_energies);
        books.largest_momentum = saved.largest_momentum;
        books.residue = saved.residue;
        start.rates.copy_from_slice(&saved.rates);
        start.powers.copy_from_slice(&saved.powers);
        start.supply.copy_from_slice(&saved.supply);
        start.loads.copy_from_slice(&saved.loads);
        start.forces.copy_from_slice(&saved.forces);
        let reactions = start.reactions.as_flattened_mut();
        reactions.copy_from_slice(&saved.reactions);
    }
}
