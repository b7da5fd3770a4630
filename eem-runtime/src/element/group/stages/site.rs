//! Where the elements write in the system of the stages, found once per scene.
//!
//! The unknowns of that system come set after set, so that its matrix has a block for every two sets. An
//! element has a [`Site`] in each.

use core::array;

use super::secant::SecantSite;
use crate::element::group::site::{Contact, Site};
use crate::element::group::view::Sites;
use crate::element::kinematics::Kinematics;
use crate::element::tableau::{MOST_SETS, Tableau};
use eem_material::number::scalar::Real;

/// Something for every two sets of unknowns: that of the rows, and that of the columns.
pub(super) type PerPair<T> = [[T; MOST_SETS]; MOST_SETS];

/// The places of one element.
#[derive(Clone, Debug)]
pub(super) struct StageSite<K: Kinematics<S, D>, S: Real, const D: usize> {
    pub(super) sets: PerPair<Site<K, S, D>>,
    pub(super) secant: SecantSite<K, S, D>,
}

impl<K: Kinematics<S, D>, S: Real, const D: usize> StageSite<K, S, D> {
    /// The nodes, and no places yet.
    pub(super) fn unconnected(site: Site<K, S, D>) -> Self {
        Self {
            sets: [[site; MOST_SETS]; MOST_SETS],
            secant: SecantSite::unconnected(),
        }
    }

    /// The places of an element with these nodes in the sets of a rule.
    pub(super) fn new(rule: &Tableau, nodes: &K::PerNode<u32>, sites: &Sites<'_, S, D>) -> Self {
        Self {
            sets: pairs(|sets| Site::new(*nodes, &of_sets(rule, sites, sets))),
            secant: SecantSite::new(nodes, sites),
        }
    }

    /// What is the same for all sets: the nodes.
    pub(super) fn common(&self) -> &Site<K, S, D> {
        &self.sets[0][0]
    }
}

/// The places of the temperature that is seen of a point, if it conducts heat to others.
pub(super) fn contacts<K: Kinematics<S, D>, S: Real, const D: usize>(
    rule: &Tableau,
    nodes: &K::PerNode<u32>,
    slot: Option<usize>,
    sites: &Sites<'_, S, D>,
) -> Option<PerPair<Contact<K, S, D>>> {
    let contacts: PerPair<_> = pairs(|sets| Contact::new(nodes, slot, &of_sets(rule, sites, sets)));
    let is_coupled = contacts.iter().flatten().all(Option::is_some);
    let there = |contact: Option<_>| contact.unwrap_or_else(|| unreachable!("all of them are"));
    is_coupled.then(|| contacts.map(|row| row.map(there)))
}

/// Where the rows of one set and the columns of another are. Sets that the rule does not have are never looked at:
/// theirs are those of its last one.
fn of_sets<'a, S: Real, const D: usize>(
    rule: &Tableau,
    sites: &Sites<'a, S, D>,
    sets: [usize; 2],
) -> Sites<'a, S, D> {
    sites.of_sets(sets.map(|set| set.min(rule.sets() - 1)))
}

/// Made for every two sets.
fn pairs<T>(make: impl Fn([usize; 2]) -> T) -> PerPair<T> {
    array::from_fn(|row| array::from_fn(|column| make([row, column])))
}
