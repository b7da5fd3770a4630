//! Where the unknowns of the nodes and of the temperatures are in the global systems.

use core::array;

use crate::group::Sites;
use crate::scalar::Real;

/// A node that moves.
///
/// Moving nodes come first among the unknowns, in their order: node `i` of them has the rows `D i` to
/// `D i + D − 1` of the tangent and row `i` of the secant matrix.
#[derive(Clone, Copy, Debug)]
pub(super) struct MovingNode<S, const D: usize> {
    pub(super) node: usize,
    /// m, kg.
    pub(super) mass: S,
    /// Its diagonal entries in the tangent.
    pub(super) diagonal: [usize; D],
    /// Its diagonal entry in the secant matrix, if there is one.
    pub(super) secant_diagonal: usize,
}

/// A temperature that neighbours see.
#[derive(Clone, Copy, Debug)]
pub(super) struct Seen {
    pub(super) slot: usize,
    pub(super) row: usize,
}

/// The nodes with a mass, and where they write.
pub(super) fn moving<S: Real, const D: usize>(
    masses: &[Option<S>],
    sites: &Sites<'_, S, D>,
) -> Vec<MovingNode<S, D>> {
    let nodes = masses.iter().zip(&sites.layout.nodes).enumerate();
    let moving = nodes.filter_map(|(node, (mass, first))| Some((node, (*mass)?, (*first)?)));
    let moving = moving.map(|(node, mass, first)| {
        let own = Some(first / D);
        MovingNode {
            node,
            mass,
            diagonal: array::from_fn(|axis| sites.place(Some(first + axis), Some(first + axis))),
            secant_diagonal: sites.secant_place(own, own),
        }
    });
    moving.collect()
}

/// The temperatures that neighbours see.
pub(super) fn seen<S: Real, const D: usize>(sites: &Sites<'_, S, D>) -> Vec<Seen> {
    let coupled = sites.layout.coupled.iter().enumerate();
    let seen = coupled.filter(|(_, unknown)| unknown.is_some());
    let seen = seen.map(|(slot, unknown)| Seen {
        slot,
        row: sites.row(*unknown),
    });
    seen.collect()
}
