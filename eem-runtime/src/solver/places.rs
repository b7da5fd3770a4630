//! Where the unknowns of the nodes and of the temperatures are in the global systems.

use core::array;

use crate::layout::Layout;
use crate::scalar::Real;
use crate::system::LinearSystem;

/// A node that moves.
#[derive(Clone, Copy, Debug)]
pub(super) struct MovingNode<S, const D: usize> {
    pub(super) node: usize,
    /// m, kg.
    pub(super) mass: S,
    /// Its first row in the tangent, and its diagonal entries there.
    pub(super) row: usize,
    pub(super) diagonal: [usize; D],
    /// Its row and its diagonal entry in the secant matrix.
    pub(super) secant_row: usize,
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
    layout: &Layout,
    tangent: &LinearSystem<S, 1>,
    secant: &LinearSystem<S, D>,
) -> Vec<MovingNode<S, D>> {
    let nodes = masses.iter().zip(&layout.nodes).enumerate();
    let moving = nodes.filter_map(|(node, (mass, row))| Some((node, (*mass)?, (*row)?)));
    let moving = moving.map(|(node, mass, row)| {
        let own = Some(row / D);
        MovingNode {
            node,
            mass,
            row,
            diagonal: array::from_fn(|axis| tangent.place(Some(row + axis), Some(row + axis))),
            secant_row: row / D,
            secant_diagonal: secant.place(own, own),
        }
    });
    moving.collect()
}

/// The temperatures that neighbours see.
pub(super) fn seen(layout: &Layout) -> Vec<Seen> {
    let coupled = layout.coupled.iter().enumerate();
    let seen = coupled.filter_map(|(slot, row)| row.map(|row| Seen { slot, row }));
    seen.collect()
}
