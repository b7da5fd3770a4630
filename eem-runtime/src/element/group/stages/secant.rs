//! The system that closes a step through stages: one unknown per mass and a right-hand side per axis.

use super::super::closing::pull_of_arms;
use super::super::site::Site;
use crate::element::group::view::Sites;
use crate::element::kinematics::{Arms, Kinematics, Weights};
use eem_material::free_energy::Array;
use eem_material::number::compact::compact;
use eem_material::number::scalar::Real;

/// The places of one element in the secant system.
#[derive(Clone, Copy, Debug)]
pub(super) struct SecantSite<K: Kinematics<S, D>, S: Real, const D: usize> {
    /// The entry of two nodes.
    pub(super) entries: K::PerNode<K::PerNode<u32>>,
}

impl<K: Kinematics<S, D>, S: Real, const D: usize> SecantSite<K, S, D> {
    /// No places yet.
    pub(super) fn unconnected() -> Self {
        Self {
            entries: K::PerNode::filled(K::PerNode::filled(0)),
        }
    }

    /// The places of an element with these nodes.
    pub(super) fn new(nodes: &K::PerNode<u32>, sites: &Sites<'_, S, D>) -> Self {
        let mass = |node: usize| sites.layout.nodes[nodes[node] as usize].map(|first| first / D);
        let mut site = Self::unconnected();
        for i in 0..K::PerNode::<u32>::LEN {
            for j in 0..K::PerNode::<u32>::LEN {
                site.entries[i][j] = compact(sites.secant_place(mass(i), mass(j)));
            }
        }
        site
    }

    /// Adds the matrix `factor A` of nodal forces `A r` for the nodes that move.
    #[inline]
    pub(super) fn add_matrix(
        &self,
        is_mass: &K::PerNode<bool>,
        weights: &Weights<K, S, D>,
        factor: S,
        values: &mut [S],
    ) {
        let mut add = |[i, j]: [usize; 2], entry: S| {
            if is_mass[i] && is_mass[j] {
                values[self.entries[i][j] as usize] += entry;
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

impl<K: Kinematics<S, D>, S: Real, const D: usize> Site<K, S, D> {
    /// Adds the fraction `share` of the motion of anchors, which is known, to arms.
    #[inline]
    pub(super) fn add_anchors(&self, arms: &mut Arms<K, S, D>, moved: &[[S; D]], share: S) {
        for (i, arm) in arms.as_mut().iter_mut().enumerate() {
            for (node, share) in [(i + 1, share), (0, -share)] {
                if !self.is_mass[node] {
                    let moved = &moved[self.nodes[node] as usize];
                    for (arm, &moved) in arm.iter_mut().zip(moved) {
                        *arm += share * moved;
                    }
                }
            }
        }
    }

    /// Subtracts the impulse `h A r` of known arms from the nodes that move.
    #[inline]
    pub(super) fn subtract_known(
        &self,
        weights: &Weights<K, S, D>,
        (known, h): (&Arms<K, S, D>, S),
        right: &mut [[S; D]],
    ) {
        let force = pull_of_arms::<K, S, D>(weights, known);
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
