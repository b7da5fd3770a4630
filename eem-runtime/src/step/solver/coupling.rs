//! Masses that couple nodes: what is beside the diagonal of the mass matrix.
//!
//! ```text
//! Δp_a = Σ_b (2 M_ab/h)(Δq_b − h v⁰_b),     v¹ = 2Δq/h − v⁰
//! ```

use core::array;

use super::balance::Balance;
use crate::element::group::{Sites, Trial};
use crate::element::masses::Masses;
use crate::number::compact::compact;
use crate::number::scalar::{Mask, Real};

/// The coupled masses of a scene, and where they write.
#[derive(Debug)]
pub(super) struct Coupling<S, const D: usize> {
    pairs: Vec<CoupledPair<S, D>>,
    /// `Δp` of the nodes that move, and the magnitude of its terms, N s; only where masses couple.
    impulses: Vec<[[S; D]; 2]>,
}

/// Two nodes that move, among those that do.
#[derive(Clone, Copy, Debug)]
struct CoupledPair<S, const D: usize> {
    nodes: [u32; 2],
    /// kg.
    mass: S,
    /// The entries of the tangent: rows of the first node, then rows of the second.
    places: [[u32; D]; 2],
}

impl<S: Real, const D: usize> Coupling<S, D> {
    /// That of a scene with one set of unknowns.
    pub(super) fn new(masses: &Masses<S>, sites: &Sites<'_, S, D>) -> Self {
        let first = |node: usize| sites.layout.nodes[node];
        let pairs = masses.pairs().iter().filter_map(|pair| {
            let [a, b] = pair.nodes().map(first);
            let rows = [a?, b?];
            let place = |[row, column]: [usize; 2]| {
                array::from_fn(|axis| compact(sites.place(Some(row + axis), Some(column + axis))))
            };
            Some(CoupledPair {
                nodes: rows.map(|row| compact(row / D)),
                mass: pair.mass,
                places: [place(rows), place([rows[1], rows[0]])],
            })
        });
        let pairs: Vec<_> = pairs.collect();
        let moving = if pairs.is_empty() {
            0
        } else {
            masses.iter().flatten().count()
        };
        Self {
            pairs,
            impulses: vec![[[S::zero(); D]; 2]; moving],
        }
    }

    /// Whether there are any.
    pub(super) fn is_none(&self) -> bool {
        self.pairs.is_empty()
    }

    /// The largest update that may be the last one, where without coupled masses it is the usual one.
    ///
    /// A stiff body pulls `(ωh)²` times as hard as its inertia, so that what an update u leaves, u², has to
    /// lie as far below ε: with `u = ε^¾` it may be ε^−½.
    pub(super) fn tolerance(&self, usual: S) -> S {
        if self.is_none() {
            return usual;
        }
        let root = S::EPSILON.sqrt();
        usual.minimum(root * root.sqrt())
    }

    /// Whether rounding may be what keeps an update from falling: with coupled masses only a small one, at most ε^⅝, as
    /// the impulses of a stiff body, by which momenta are judged, would hide what a larger one leaves.
    pub(super) fn may_be_rounding(&self, update: S) -> bool {
        let root = S::EPSILON.sqrt();
        self.is_none() || update.at_most(root * root.sqrt().sqrt()).all()
    }

    /// Adds inertia to residual and tangent at a trial, as a [`Balance`] does on the diagonal.
    pub(super) fn balance(
        &self,
        (nodes, trial): (&[Balance<S, D>], &Trial<S, D>),
        inertia_per_mass: S,
        values: &mut [S],
        right: &mut [[S; 1]],
    ) {
        let rows = right.as_flattened_mut().as_chunks_mut::<D>().0;
        for pair in &self.pairs {
            let [a, b] = pair.nodes.map(|node| node as usize);
            let inertia = pair.mass * inertia_per_mass;
            for &place in pair.places.as_flattened() {
                values[place as usize] += inertia;
            }
            for [own, other] in [[a, b], [b, a]] {
                let change = nodes[other].change(trial);
                for (row, change) in rows[own].iter_mut().zip(change) {
                    *row -= inertia * change;
                }
            }
        }
    }

    /// Finds `Δp` of all nodes at a trial, if masses couple them.
    pub(super) fn find_impulses(
        &mut self,
        (nodes, trial): (&[Balance<S, D>], &Trial<S, D>),
        inertia_per_mass: S,
    ) {
        for (node, [impulse, terms]) in nodes.iter().zip(&mut self.impulses) {
            let inertia = node.place.mass * inertia_per_mass;
            *impulse = node.change(trial).map(|change| inertia * change);
            *terms = node.displacement(trial).map(|moved| inertia * moved.abs());
        }
        for pair in &self.pairs {
            let [a, b] = pair.nodes.map(|node| node as usize);
            let inertia = pair.mass * inertia_per_mass;
            for [own, other] in [[a, b], [b, a]] {
                let (change, moved) =
                    (nodes[other].change(trial), nodes[other].displacement(trial));
                let [impulse, terms] = &mut self.impulses[own];
                for axis in 0..D {
                    impulse[axis] += inertia * change[axis];
                    // Masses between corners and middles of edges are negative.
                    terms[axis] += (inertia * moved[axis]).abs();
                }
            }
        }
    }

    /// `Δp` of a node among those that move, at the trial for which it has been found where masses couple,
    /// and the magnitude of its terms, N s.
    #[inline]
    pub(super) fn impulse(
        &self,
        (moving, node): (usize, &Balance<S, D>),
        trial: &Trial<S, D>,
        inertia_per_mass: S,
    ) -> [[S; D]; 2] {
        if let Some(found) = self.impulses.get(moving) {
            return *found;
        }
        let at = node.place.in_trial();
        let displacement = &trial.displacements[at];
        let inertia = node.place.mass * inertia_per_mass;
        let impulse = node.impulse([displacement, &trial.rests[at]], inertia_per_mass);
        [impulse, displacement.map(|moved| inertia * moved.abs())]
    }
}
