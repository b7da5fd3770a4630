//! The faces of all cells, grouped by their nodes.

use crate::shape::Shape;

/// The most nodes of a face, those of a `Hex20`.
const MOST: usize = 8;

/// The nodes of a face in ascending order, then `usize::MAX`.
type Key = [usize; MOST];

/// The cells of a mesh without its shape, so that what follows is compiled once for all shapes.
pub(super) struct Cells<'a> {
    count: usize,
    nodes_of: &'a dyn Fn(usize) -> &'a [usize],
    pub(super) faces: &'static [&'static [usize]],
    pub(super) dimensions: usize,
}

/// Calls a function with cells.
pub(super) fn with_cells<H: Shape<D>, const D: usize, T>(
    cells: &[H::PerNode<usize>],
    call: impl FnOnce(&Cells<'_>) -> T,
) -> T {
    call(&Cells {
        count: cells.len(),
        nodes_of: &|cell| cells[cell].as_ref(),
        faces: H::FACES,
        dimensions: D,
    })
}

impl<'a> Cells<'a> {
    /// The nodes of a cell.
    pub(super) fn nodes_of(&self, cell: usize) -> &'a [usize] {
        (self.nodes_of)(cell)
    }

    /// The nodes of a face of a cell, in ascending order.
    fn key(&self, [cell, face]: [usize; 2]) -> Key {
        let mut key = [usize::MAX; MOST];
        let nodes = self.nodes_of(cell);
        for (entry, &node) in key.iter_mut().zip(self.faces[face]) {
            *entry = nodes[node];
        }
        key.sort_unstable();
        key
    }

    /// Calls a function with the faces, each a cell and the number of its face, those with the same nodes together; in the
    /// order of their sorted nodes. Stops when it returns false.
    pub(super) fn for_same(&self, nodes: usize, show: &mut dyn FnMut(&[[usize; 2]]) -> bool) {
        let faces = self.faces.len();
        let side = |number: usize| [number / faces, number % faces];
        let sides = 0..self.count * faces;
        let least = |number: usize| self.key(side(number))[0];
        // Counting sort by the least node: the beginning of its faces, and later their end.
        let mut ends = vec![0; nodes + 1];
        for number in sides.clone() {
            ends[least(number) + 1] += 1;
        }
        for node in 0..nodes {
            ends[node + 1] += ends[node];
        }
        let mut of_nodes = vec![0; sides.len()];
        for number in sides {
            let end = &mut ends[least(number)];
            of_nodes[*end] = number;
            *end += 1;
        }
        let mut from = 0;
        let (mut near, mut group): (Vec<(Key, [usize; 2])>, Vec<_>) = (Vec::new(), Vec::new());
        for &to in &ends[..nodes] {
            near.clear();
            let sides = of_nodes[from..to].iter().map(|&number| side(number));
            near.extend(sides.map(|side| (self.key(side), side)));
            near.sort_unstable();
            for same in near.chunk_by(|a, b| a.0 == b.0) {
                group.clear();
                group.extend(same.iter().map(|&(_, side)| side));
                if !show(&group) {
                    return;
                }
            }
            from = to;
        }
    }
}
