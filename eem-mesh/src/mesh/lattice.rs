//! The numbering of the nodes of a box of cells, and their memory.
//!
//! Nodes are on a lattice with two steps per cell: corners at even positions, middles of edges at one odd one. The first
//! coordinate varies fastest. A *row* has all nodes along the first axis.

use core::marker::PhantomData;

use super::error::MeshError;
use crate::memory::available_for;
use crate::shape::Shape;

/// A box of cells.
#[derive(Debug)]
pub(super) struct Lattice<H, const D: usize> {
    cells: [usize; D],
    /// Whether there are nodes at positions that are odd along some axes, indexed by the sum of `2^axis` of these.
    has: Vec<bool>,
    /// The first node of each row, and the number of nodes.
    starts: Vec<usize>,
    shape: PhantomData<H>,
}

impl<H: Shape<D>, const D: usize> Lattice<H, D> {
    /// An error if there are no cells, or if nodes and cells do not fit in 32 bits or in memory.
    pub(super) fn of(cells: [usize; D]) -> Result<Self, MeshError> {
        if cells.contains(&0) {
            return Err(MeshError::Empty);
        }
        let mut has = vec![false; 1 << D];
        for node in H::NODES {
            // Along an axis with 0, the node is in the middle.
            let axes = node.iter().enumerate();
            has[axes.fold(0, |sum, (axis, &side)| {
                sum + (usize::from(side == 0) << axis)
            })] = true;
        }
        let size = Size::of::<H, D>(cells, &has);
        size.check()?;
        let across = cells[1..].iter();
        let rows = across.fold(1, |rows, &count| rows * (2 * count + 1));
        let mut lattice = Self {
            cells,
            has,
            starts: size.reserved(rows + 1)?,
            shape: PhantomData,
        };
        let mut start = 0;
        for row in 0..rows {
            lattice.starts.push(start);
            let parities = lattice.parities(row);
            let even = usize::from(lattice.has[parities]) * (cells[0] + 1);
            start += even + usize::from(lattice.has[parities + 1]) * cells[0];
        }
        lattice.starts.push(start);
        Ok(lattice)
    }

    /// The sum of `2^axis` of the axes, except the first, along which the position of a row is odd.
    fn parities(&self, mut row: usize) -> usize {
        let mut odd = 0;
        for (axis, count) in self.cells.iter().enumerate().skip(1) {
            odd += ((row % (2 * count + 1)) % 2) << axis;
            row /= 2 * count + 1;
        }
        odd
    }

    /// The number of the node at a position of the lattice.
    pub(super) fn number(&self, place: [usize; D]) -> usize {
        let axes = place.iter().zip(&self.cells).skip(1).rev();
        let row = axes.fold(0, |row, (at, count)| row * (2 * count + 1) + at);
        let parities = self.parities(row);
        let is_whole = self.has[parities] && self.has[parities + 1];
        let own = if is_whole { place[0] } else { place[0] / 2 };
        self.starts[row] + own
    }

    /// The positions of all nodes, in order.
    pub(super) fn places(&self) -> impl Iterator<Item = [usize; D]> + '_ {
        (0..self.starts.len() - 1).flat_map(move |row| {
            let parities = self.parities(row);
            let along = (0..=2 * self.cells[0]).filter(move |at| self.has[parities + at % 2]);
            along.map(move |at| {
                let mut rest = row;
                let mut place = [at; D];
                for (at, count) in place.iter_mut().zip(&self.cells).skip(1) {
                    *at = rest % (2 * count + 1);
                    rest /= 2 * count + 1;
                }
                place
            })
        })
    }

    /// Empty lists with memory for all nodes and cells.
    #[expect(clippy::type_complexity, reason = "what a mesh is made of")]
    pub(super) fn reserved(&self) -> Result<(Vec<[f64; D]>, Vec<H::PerNode<usize>>), MeshError> {
        let size = Size::of::<H, D>(self.cells, &self.has);
        let nodes = self.starts.last().copied().unwrap_or_default();
        let cells = self.cells.iter().product();
        Ok((size.reserved(nodes)?, size.reserved(cells)?))
    }
}

/// The size of a mesh before it is made; a number `u128::MAX` stands for that or more.
#[derive(Clone, Copy, Debug)]
struct Size {
    cells: u128,
    nodes: u128,
    /// Their memory while they are made and checked.
    bytes: u128,
}

impl Size {
    fn of<H: Shape<D>, const D: usize>(cells: [usize; D], has: &[bool]) -> Self {
        let wide = cells.map(|count| count as u128);
        let product = |of: &dyn Fn(usize) -> u128| {
            (0..D).fold(1_u128, |product, axis| product.saturating_mul(of(axis)))
        };
        let cells = product(&|axis| wide[axis]);
        let classes = (0..has.len()).filter(|&class| has[class]);
        let nodes = classes.fold(0_u128, |nodes, class| {
            let along = |axis: usize| wide[axis] + u128::from((class >> axis) & 1 == 0);
            nodes.saturating_add(product(&along))
        });
        let rows = (1..D).fold(1_u128, |rows, axis| rows.saturating_mul(2 * wide[axis] + 1));
        // Places and nodes of cells; the check lists the faces of all cells by their nodes.
        let words = H::NODES.len() + H::FACES.len();
        let of_cells = cells.saturating_mul(words as u128);
        let of_nodes = nodes.saturating_mul(D as u128 + 2);
        let words = of_cells.saturating_add(of_nodes).saturating_add(rows);
        Self {
            cells,
            nodes,
            bytes: words.saturating_mul(8),
        }
    }

    /// An error if nodes do not fit in 32 bits, or the mesh in memory.
    fn check(self) -> Result<(), MeshError> {
        if self.nodes > u128::from(u32::MAX) {
            return Err(MeshError::TooMany {
                cells: self.cells,
                nodes: self.nodes,
                bytes: self.bytes,
            });
        }
        let bytes = u64::try_from(self.bytes).unwrap_or(u64::MAX);
        match available_for(bytes) {
            Some(most) if bytes > most => Err(self.too_large(Some(most))),
            _ => Ok(()),
        }
    }

    /// An empty list with memory for `count` entries.
    fn reserved<T>(self, count: usize) -> Result<Vec<T>, MeshError> {
        let mut list = Vec::new();
        match list.try_reserve_exact(count) {
            Ok(()) => Ok(list),
            Err(_) => Err(self.too_large(None)),
        }
    }

    const fn too_large(self, available: Option<u64>) -> MeshError {
        MeshError::TooLarge {
            cells: self.cells,
            nodes: self.nodes,
            bytes: self.bytes,
            available,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// More bytes than any machine has.
    const ENDLESS: Size = Size {
        cells: 8,
        nodes: 27,
        bytes: u128::MAX,
    };

    #[test]
    #[cfg(feature = "memory")]
    fn the_machine_is_asked_for_its_memory() {
        let error = ENDLESS.check().unwrap_err();
        let text = error.to_string();
        assert!(text.contains("are available: use fewer cells"), "{text}");
    }

    #[test]
    fn what_the_machine_refuses_is_an_error() {
        let text = ENDLESS.reserved::<u64>(usize::MAX).unwrap_err().to_string();
        assert!(text.starts_with("8 cells with 27 nodes take"), "{text}");
        assert!(text.contains("bytes, which the system refuses"), "{text}");
    }
}
