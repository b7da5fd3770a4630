//! The numbering of the nodes of a box of cells, and how much memory they take.
//!
//! Nodes are on a lattice of twice as many steps as there are cells: corners at even places, middles of edges at one
//! odd one. The first coordinate runs fastest. A *row* has all nodes along the first axis.

use core::marker::PhantomData;

use super::error::MeshError;
use crate::algebra::memory::MemoryLimit;
use crate::element::kinematics::Shape;

/// A box of cells.
#[derive(Debug)]
pub(super) struct Lattice<H, const D: usize> {
    cells: [usize; D],
    /// Whether nodes are where these axes have odd places, by the sum of `2^axis`.
    has: Vec<bool>,
    /// The first node of each row; how many nodes there are.
    starts: Vec<usize>,
    shape: PhantomData<H>,
}

impl<H: Shape<D>, const D: usize> Lattice<H, D> {
    /// An error if there are no cells, or if nodes and cells do not fit in 32 bits or in the memory.
    pub(super) fn of(cells: [usize; D]) -> Result<Self, MeshError> {
        if cells.contains(&0) {
            return Err(MeshError::Empty);
        }
        let mut has = vec![false; 1 << D];
        for node in H::NODES {
            has[odd(&node.map(|side| side == 0))] = true;
        }
        let size = Size::of::<H, D>(cells, &has);
        size.check()?;
        let mut lattice = Self {
            cells,
            has,
            starts: Vec::new(),
            shape: PhantomData,
        };
        let rows = cells[1..]
            .iter()
            .fold(1, |rows, &count| rows * (2 * count + 1));
        lattice.starts = size.reserved(rows + 1)?;
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

    /// Which axes but the first are odd in a row.
    fn parities(&self, mut row: usize) -> usize {
        let mut odd = 0;
        for (axis, count) in self.cells.iter().enumerate().skip(1) {
            odd += ((row % (2 * count + 1)) % 2) << axis;
            row /= 2 * count + 1;
        }
        odd
    }

    /// The number of the node at a place of the lattice.
    pub(super) fn number(&self, place: [usize; D]) -> usize {
        let axes = place.iter().zip(&self.cells).skip(1).rev();
        let row = axes.fold(0, |row, (at, count)| row * (2 * count + 1) + at);
        let parities = self.parities(row);
        let is_whole = self.has[parities] && self.has[parities + 1];
        let own = if is_whole { place[0] } else { place[0] / 2 };
        self.starts[row] + own
    }

    /// The places of all nodes in the order of their numbers.
    pub(super) fn places(&self) -> impl Iterator<Item = [usize; D]> + '_ {
        (0..self.starts.len() - 1).flat_map(move |row| {
            let parities = self.parities(row);
            let along = (0..=2 * self.cells[0]).filter(move |at| self.has[parities + at % 2]);
            along.map(move |at| {
                let mut rest = row;
                core::array::from_fn(|axis| {
                    if axis == 0 {
                        return at;
                    }
                    let steps = 2 * self.cells[axis] + 1;
                    let own = rest % steps;
                    rest /= steps;
                    own
                })
            })
        })
    }

    /// Lists that all nodes and all cells fit in.
    #[expect(clippy::type_complexity, reason = "what a mesh is made of")]
    pub(super) fn reserved(&self) -> Result<(Vec<[f64; D]>, Vec<H::PerNode<usize>>), MeshError> {
        let size = Size::of::<H, D>(self.cells, &self.has);
        let nodes = self.starts.last().copied().unwrap_or_default();
        let cells = self.cells.iter().product();
        Ok((size.reserved(nodes)?, size.reserved(cells)?))
    }
}

/// The sum of `2^axis` of the odd axes.
fn odd<const D: usize>(is_odd: &[bool; D]) -> usize {
    let axes = is_odd.iter().enumerate();
    axes.fold(0, |sum, (axis, &is_odd)| {
        sum + (usize::from(is_odd) << axis)
    })
}

/// How large a mesh is, known before it is made; `u128::MAX` is that or more.
#[derive(Clone, Copy, Debug)]
struct Size {
    cells: u128,
    nodes: u128,
    /// What they take while they are made and checked.
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

    /// An error if nodes have no numbers, or the machine no memory.
    fn check(self) -> Result<(), MeshError> {
        if self.nodes > u128::from(u32::MAX) {
            let Self {
                cells,
                nodes,
                bytes,
            } = self;
            return Err(MeshError::TooMany {
                cells,
                nodes,
                bytes,
            });
        }
        let bytes = u64::try_from(self.bytes).unwrap_or(u64::MAX);
        let refused = MemoryLimit::NONE.check(0, bytes);
        refused.map_err(|refused| self.too_large(refused.available))
    }

    /// An empty list with a place for so many.
    fn reserved<T>(self, count: usize) -> Result<Vec<T>, MeshError> {
        let mut list = Vec::new();
        match list.try_reserve_exact(count) {
            Ok(()) => Ok(list),
            Err(_) => Err(self.too_large(None)),
        }
    }

    const fn too_large(self, available: Option<u64>) -> MeshError {
        let Self {
            cells,
            nodes,
            bytes,
        } = self;
        MeshError::TooLarge {
            cells,
            nodes,
            bytes,
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
    #[cfg(feature = "sparse")]
    fn the_machine_is_asked_for_its_memory() {
        let error = ENDLESS.check().unwrap_err();
        let has_some = |error| {
            matches!(
                error,
                MeshError::TooLarge {
                    available: Some(_),
                    ..
                }
            )
        };
        assert!(has_some(error.clone()), "{error}");
        assert!(error.to_string().contains("are available: use fewer cells"));
    }

    #[test]
    fn what_the_machine_refuses_is_an_error() {
        let error = ENDLESS.reserved::<u64>(usize::MAX).unwrap_err();
        assert!(
            error.to_string().starts_with("8 cells with 27 nodes take")
                && error
                    .to_string()
                    .contains("bytes, which the system refuses"),
            "{error}"
        );
    }
}
