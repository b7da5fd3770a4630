//! Where the elements write in the system of the stages, found once per scene.
//!
//! The unknowns of that system come set after set, so that its matrix has a block for every two sets. An
//! element has a [`Site`] in each.

use core::array;

use super::secant::SecantSite;
use crate::element::group::site::{Contact, Site};
use crate::element::group::view::Sites;
use crate::element::kinematics::Kinematics;
use crate::element::tableau::MOST_SETS;
use crate::number::scalar::Real;

/// Something for every two sets of unknowns: that of the rows, and that of the columns.
pub(super) type PerPair<T> = [[T; MOST_SETS]; MOST_SETS];

/// The places of one element.
#[derive(Clone, Debug)]
pub(super) struct StageSite<K: Kinematics<S, D>, S: Real, const D: usize> {
    pub(super) sets: PerPair<Site<K, S, D>>,
    pub(super) secant: SecantSite<K, S, D>,
    /// The same for its seen temperatures, if the element conducts heat to others.
    pub(super) contacts: Option<PerPair<Contact<K, S, D>>>,
}

impl<K: Kinematics<S, D>, S: Real, const D: usize> StageSite<K, S, D> {
    /// The nodes, and no places yet.
    pub(super) fn unconnected(site: Site<K, S, D>) -> Self {
        Self {
            sets: [[site; MOST_SETS]; MOST_SETS],
            secant: SecantSite::unconnected(),
            contacts: None,
        }
    }

    /// The places of an element with these nodes and the thermal slot.
    pub(super) fn new(
        nodes: &K::PerNode<u32>,
        slot: Option<usize>,
        sites: &Sites<'_, S, D>,
    ) -> Self {
        let contact = |row: usize, column: usize| {
            let sites = sites.of_sets([row, column]);
            Contact::new(nodes, slot, &sites)
        };
        let row = |row: usize| Some([contact(row, 0)?, contact(row, 1)?]);
        Self {
            sets: array::from_fn(|row| {
                array::from_fn(|column| Site::new(*nodes, &sites.of_sets([row, column])))
            }),
            secant: SecantSite::new(nodes, sites),
            contacts: row(0).zip(row(1)).map(|(first, second)| [first, second]),
        }
    }

    /// What is the same for all sets: the nodes.
    pub(super) fn common(&self) -> &Site<K, S, D> {
        &self.sets[0][0]
    }
}
