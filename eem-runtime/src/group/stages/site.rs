//! Where the elements write in the system of the stages, found once per scene.
//!
//! The unknowns of that system are those of the middle and then those of the end, so that its matrix
//! has four quarters. An element has a [`Site`] in each.

use super::secant::SecantSite;
use crate::group::Sites;
use crate::group::site::{Contact, Site};
use crate::kinematics::Kinematics;
use crate::scalar::Real;

/// The quarters of the system of the stages: rows, then columns of the middle and of the end.
pub(crate) type Quarters<'a, S, const D: usize> = [[Sites<'a, S, D>; 2]; 2];

/// The places of one element.
#[derive(Clone, Debug)]
pub(super) struct StageSite<K: Kinematics<S, D>, S: Real, const D: usize> {
    pub(super) quarters: [[Site<K, S, D>; 2]; 2],
    pub(super) secant: SecantSite<K, S, D>,
    /// The same for its seen temperatures, if the element conducts heat to others.
    pub(super) contacts: Option<[[Contact<K, S, D>; 2]; 2]>,
}

impl<K: Kinematics<S, D>, S: Real, const D: usize> StageSite<K, S, D> {
    /// The nodes, and no places yet.
    pub(super) fn unconnected(site: Site<K, S, D>) -> Self {
        Self {
            quarters: [[site; 2]; 2],
            secant: SecantSite::unconnected(),
            contacts: None,
        }
    }

    /// The places of an element with these nodes and the thermal slot.
    pub(super) fn new(
        nodes: &K::PerNode<u32>,
        slot: Option<usize>,
        quarters: &Quarters<'_, S, D>,
    ) -> Self {
        let contact = |row: usize, column: usize| {
            let sites = &quarters[row][column];
            Contact::new(nodes, slot, sites)
        };
        let row = |row: usize| Some([contact(row, 0)?, contact(row, 1)?]);
        let contacts = row(0).zip(row(1)).map(|(middle, end)| [middle, end]);
        let site = |sites: &Sites<'_, S, D>| Site::new(*nodes, sites);
        Self {
            quarters: quarters.each_ref().map(|row| row.each_ref().map(site)),
            secant: SecantSite::new(nodes, &quarters[0][0]),
            contacts,
        }
    }

    /// What is the same in all quarters: the nodes.
    pub(super) fn common(&self) -> &Site<K, S, D> {
        &self.quarters[0][0]
    }
}
