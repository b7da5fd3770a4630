//! The matrix indices of the elements in the systems of the stages, found once per scene.
//!
//! The unknowns of an iteration come set after set, so that the matrix has a block for every two sets. An element has a
//! [`Site`] in each. The secant system, which closes a step stage by stage, has one unknown per mass and a right-hand
//! side per axis.

use crate::element::group::closing::pull_of_arms;
use crate::element::group::site::{ContactSite, HeatContact, Site};
use crate::element::group::view::Sites;
use crate::element::kinematics::{Arms, Kinematics, Weights};
use crate::element::tableau::{MOST_SETS, Tableau};
use eem_material::free_energy::Array;
use eem_material::number::compact::compact;

/// A value for every pair of sets of unknowns: that of the rows, then that of the columns.
pub(super) type PerPair<T> = [[T; MOST_SETS]; MOST_SETS];

/// The interface temperature of a point in a pair of sets, and the matrix indices of its nodes.
pub(super) type StageContact<K, const D: usize> = (HeatContact, ContactSite<K, D>);

/// The matrix indices of one element.
#[derive(Clone, Debug)]
pub(super) struct StageSite<K: Kinematics<D>, const D: usize> {
    pub(super) sets: PerPair<Site<K, D>>,
    /// The entry of two nodes in the secant system.
    secant: K::PerNode<K::PerNode<u32>>,
}

impl<K: Kinematics<D>, const D: usize> StageSite<K, D> {
    /// The nodes, without indices.
    pub(super) fn unconnected(site: Site<K, D>) -> Self {
        Self {
            sets: [[site; MOST_SETS]; MOST_SETS],
            secant: K::PerNode::filled(K::PerNode::filled(0)),
        }
    }

    /// The indices of an element with these nodes in the sets of a rule.
    pub(super) fn new(rule: &Tableau, nodes: &K::PerNode<u32>, sites: &Sites<'_, D>) -> Self {
        let mass = |node: u32| sites.layout.nodes[node as usize].map(|first| first / D);
        let sets = pairs(|sets| Site::new(*nodes, &of_sets(rule, sites, sets)));
        let mut site = Self::unconnected(sets[0][0]);
        for (row, &i) in site.secant.as_mut().iter_mut().zip(nodes.as_ref()) {
            for (entry, &j) in row.as_mut().iter_mut().zip(nodes.as_ref()) {
                *entry = compact(sites.secant_place(mass(i), mass(j)));
            }
        }
        Self { sets, ..site }
    }

    /// Nodes and rows of the first set.
    pub(super) fn first(&self) -> &Site<K, D> {
        &self.sets[0][0]
    }

    /// Adds `factor A` of the nodal forces `A r` to the secant system, for the nodes that move.
    #[inline]
    pub(super) fn add_secant(&self, weights: &Weights<K, D>, factor: f64, values: &mut [f64]) {
        let is_mass = &self.first().is_mass;
        let mut add = |[i, j]: [usize; 2], entry: f64| {
            if is_mass[i] && is_mass[j] {
                values[self.secant[i][j] as usize] += entry;
            }
        };
        for (i, row) in weights.as_ref().iter().enumerate() {
            for (j, &weight) in row.as_ref().iter().enumerate() {
                let entry = factor * weight;
                add([i + 1, j + 1], entry);
                add([i + 1, 0], -entry);
                add([0, j + 1], -entry);
                add([0, 0], entry);
            }
        }
    }
}

impl<K: Kinematics<D>, const D: usize> Site<K, D> {
    /// Adds the motion of anchors, which is known, to arms.
    #[inline]
    pub(super) fn add_anchors(&self, arms: &mut Arms<K, D>, moved: &[[f64; D]]) {
        for (i, arm) in arms.as_mut().iter_mut().enumerate() {
            for (node, sign) in [(i + 1, 1.0), (0, -1.0)] {
                if !self.is_mass[node] {
                    let moved = &moved[self.nodes[node] as usize];
                    for (arm, &moved) in arm.iter_mut().zip(moved) {
                        *arm += sign * moved;
                    }
                }
            }
        }
    }

    /// Subtracts the impulse `h A r` of known arms from the nodes that move.
    #[inline]
    pub(super) fn subtract_known(
        &self,
        weights: &Weights<K, D>,
        (known, h): (&Arms<K, D>, f64),
        right: &mut [[f64; D]],
    ) {
        let force = pull_of_arms::<K, D>(weights, known);
        for (i, force) in force.as_ref().iter().enumerate() {
            for (node, h) in [(i + 1, -h), (0, h)] {
                if self.is_mass[node] {
                    let right = &mut right[self.rows[node] as usize / D];
                    for (right, &force) in right.iter_mut().zip(force) {
                        *right += h * force;
                    }
                }
            }
        }
    }
}

/// The matrix indices of the interface temperature of a point, if it conducts heat to others.
pub(super) fn contacts<K: Kinematics<D>, const D: usize>(
    rule: &Tableau,
    nodes: &K::PerNode<u32>,
    slot: Option<usize>,
    sites: &Sites<'_, D>,
) -> Option<PerPair<StageContact<K, D>>> {
    let contacts: PerPair<_> =
        pairs(|sets| ContactSite::new(nodes, slot, &of_sets(rule, sites, sets)));
    let is_coupled = contacts.iter().flatten().all(Option::is_some);
    let there = |contact: Option<_>| contact.unwrap_or_else(|| unreachable!("all of them are"));
    is_coupled.then(|| contacts.map(|row| row.map(there)))
}

/// The rows of one set and the columns of another. A rule with fewer sets repeats its last one, which is never read.
fn of_sets<'a, const D: usize>(
    rule: &Tableau,
    sites: &Sites<'a, D>,
    sets: [usize; 2],
) -> Sites<'a, D> {
    sites.of_sets(sets.map(|set| set.min(rule.sets() - 1)))
}

fn pairs<T>(make: impl Fn([usize; 2]) -> T) -> PerPair<T> {
    core::array::from_fn(|row| core::array::from_fn(|column| make([row, column])))
}
