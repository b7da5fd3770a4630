//! The faces of all cells, grouped by their nodes.

use crate::shape::Shape;

/// The most nodes of a face, those of a `Hex20`.
const MOST: usize = 8;

/// The nodes of a face in ascending order, then `usize::MAX`.
type Key = [usize; MOST];

/// The nodes of a face of a cell, in ascending order.
fn key<H: Shape<D>, const D: usize>(cell: &H::PerNode<usize>, face: usize) -> Key {
    let mut key = [usize::MAX; MOST];
    for (entry, &node) in key.iter_mut().zip(H::FACES[face]) {
        *entry = cell.as_ref()[node];
    }
    key.sort_unstable();
    key
}

/// Calls a function with the faces, each a cell and the number of its face, those with the same nodes together; in the
/// order of their sorted nodes. Stops at an error.
pub(super) fn for_same<H: Shape<D>, const D: usize, E>(
    cells: &[H::PerNode<usize>],
    nodes: usize,
    mut show: impl FnMut(&[[usize; 2]]) -> Result<(), E>,
) -> Result<(), E> {
    let faces = H::FACES.len();
    let least = |cell: &H::PerNode<usize>, face: usize| key::<H, D>(cell, face)[0];
    // Counting sort by the least node: the beginning of its faces, and later their end.
    let mut ends = vec![0; nodes + 1];
    for cell in cells {
        (0..faces).for_each(|face| ends[least(cell, face) + 1] += 1);
    }
    for node in 0..nodes {
        ends[node + 1] += ends[node];
    }
    let mut of_nodes = vec![0; cells.len() * faces];
    for (at, cell) in cells.iter().enumerate() {
        for face in 0..faces {
            let end = &mut ends[least(cell, face)];
            of_nodes[*end] = at * faces + face;
            *end += 1;
        }
    }
    let mut from = 0;
    let (mut near, mut group): (Vec<(Key, [usize; 2])>, Vec<_>) = (Vec::new(), Vec::new());
    for &to in &ends[..nodes] {
        near.clear();
        near.extend(of_nodes[from..to].iter().map(|&number| {
            let [cell, face] = [number / faces, number % faces];
            (key::<H, D>(&cells[cell], face), [cell, face])
        }));
        near.sort_unstable();
        for same in near.chunk_by(|a, b| a.0 == b.0) {
            group.clear();
            group.extend(same.iter().map(|&(_, side)| side));
            show(&group)?;
        }
        from = to;
    }
    Ok(())
}
