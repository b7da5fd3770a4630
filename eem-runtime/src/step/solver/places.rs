//! Where the unknowns of the nodes and of the temperatures are in the global systems.

use core::array;

use crate::element::group::Sites;
use crate::element::masses::Masses;
use eem_material::number::compact::compact;
use eem_material::number::scalar::Real;

/// A node that moves.
///
/// Moving nodes come first among the unknowns of a set, in their order: node `i` of them has the rows `D i`
/// to `D i + D − 1` of the set in the tangent and row `i` of the secant matrix.
#[derive(Clone, Copy, Debug)]
pub(super) struct MovingNode<S, const D: usize> {
    node: u32,
    trial: u32,
    /// Its diagonal entries in the tangent.
    diagonal: [u32; D],
    /// Its diagonal entry in the secant matrix, if there is one.
    secant_diagonal: u32,
    /// m, kg, and 1/m.
    pub(super) mass: S,
    pub(super) per_mass: S,
}

impl<S, const D: usize> MovingNode<S, D> {
    #[inline]
    pub(super) fn node(&self) -> usize {
        self.node as usize
    }

    /// Where it is in the trial, which has all nodes of every set of unknowns.
    #[inline]
    pub(super) fn in_trial(&self) -> usize {
        self.trial as usize
    }

    /// Its diagonal entries in the tangent.
    #[inline]
    pub(super) fn diagonal(&self) -> [usize; D] {
        self.diagonal.map(|place| place as usize)
    }

    /// Its diagonal entry in the secant matrix, if there is one.
    #[inline]
    pub(super) fn secant_diagonal(&self) -> usize {
        self.secant_diagonal as usize
    }
}

/// A temperature that neighbours see.
#[derive(Clone, Copy, Debug)]
pub(super) struct Seen {
    /// The thermal slot, and where it is in the trial.
    pub(super) slot: usize,
    pub(super) in_trial: usize,
    pub(super) row: usize,
}

/// The nodes with a mass, and where they write.
pub(super) fn moving<S: Real, const D: usize>(
    masses: &Masses<S>,
    sites: &Sites<'_, S, D>,
) -> Vec<MovingNode<S, D>> {
    let [set, _] = sites.sets;
    let nodes = masses.iter().zip(&sites.layout.nodes).enumerate();
    let moving = nodes.filter_map(|(node, (mass, first))| Some((node, mass?, (*first)?)));
    let moving = moving.map(|(node, mass, first)| {
        let own = Some(first / D);
        MovingNode {
            node: compact(node),
            trial: compact(set * masses.len() + node),
            diagonal: array::from_fn(|axis| {
                let unknown = Some(first + axis);
                compact(sites.place(unknown, unknown))
            }),
            secant_diagonal: compact(sites.secant_place(own, own)),
            mass,
            per_mass: mass.recip(),
        }
    });
    moving.collect()
}

/// The temperatures that neighbours see.
pub(super) fn seen<S: Real, const D: usize>(sites: &Sites<'_, S, D>) -> Vec<Seen> {
    let first = sites.sets[0] * sites.layout.thermal;
    let coupled = sites.layout.coupled.iter().enumerate();
    let seen = coupled.filter(|(_, unknown)| unknown.is_some());
    let seen = seen.map(|(slot, unknown)| Seen {
        slot,
        in_trial: first + slot,
        row: sites.row(*unknown),
    });
    seen.collect()
}
