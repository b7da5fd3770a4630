//! Which entries of a square matrix can differ from zero, found once per scene.
//!
//! The pattern is symmetric, the values are not. Two matrices are solved with in a step:
//!
//! ```text
//! tangent   displacements of the masses and temperatures Θ that neighbours see; each iteration
//! secant    one unknown per mass, the same for every axis of space; once per step, D right sides
//! ```

use crate::conduction::{Conduction, Partner};
use crate::layout::Layout;
use crate::scalar::Real;
use crate::scene::ElementEntry;

/// The structural entries of a matrix, row by row, columns ascending.
#[derive(Clone, Debug)]
pub(crate) struct Pattern {
    /// Row r has the columns `columns[starts[r]..starts[r + 1]]`.
    starts: Vec<usize>,
    columns: Vec<usize>,
}

impl Pattern {
    /// The pattern with the whole diagonal, the pairs and their mirror images.
    pub(crate) fn new(unknowns: usize, pairs: impl IntoIterator<Item = (usize, usize)>) -> Self {
        let diagonal = (0..unknowns).map(|row| (row, row));
        let mirrored = pairs.into_iter().flat_map(|(a, b)| [(a, b), (b, a)]);
        let mut entries: Vec<_> = diagonal.chain(mirrored).collect();
        entries.sort_unstable();
        entries.dedup();
        let mut starts = vec![0; unknowns + 1];
        for &(row, _) in &entries {
            starts[row + 1] += 1;
        }
        for row in 0..unknowns {
            starts[row + 1] += starts[row];
        }
        let columns = entries.into_iter().map(|(_, column)| column).collect();
        Self { starts, columns }
    }

    /// The pattern of the tangent.
    ///
    /// The forces of an element depend on its nodes, on its own Θ and on that of its partners, and
    /// so does its own Θ.
    pub(crate) fn of_tangent<S: Real>(
        elements: &[ElementEntry<S>],
        layout: &Layout,
        conduction: &Conduction<S>,
        dimension: usize,
    ) -> Self {
        let mut pairs = Vec::new();
        for (entry, slots) in elements.iter().zip(&layout.elements) {
            let nodes = entry.nodes.iter().filter_map(|&node| layout.nodes[node]);
            let mut own: Vec<_> = nodes.flat_map(|first| first..first + dimension).collect();
            let slot = slots.thermal;
            own.extend(slot.and_then(|slot| layout.coupled[slot]));
            let links = slot.map_or(&[][..], |slot| conduction.links(slot));
            let partners = links.iter().filter_map(|link| match link.partner {
                Partner::Slot(partner) => layout.coupled[partner],
                Partner::Reservoir(_) => None,
            });
            let all: Vec<_> = own.iter().copied().chain(partners).collect();
            for &row in &own {
                pairs.extend(all.iter().map(|&column| (row, column)));
            }
        }
        Self::new(layout.unknowns, pairs)
    }

    /// The pattern of the secant matrix.
    pub(crate) fn of_secant<S>(
        elements: &[ElementEntry<S>],
        layout: &Layout,
        dimension: usize,
    ) -> Self {
        let mut pairs = Vec::new();
        for entry in elements {
            let masses = || {
                let nodes = entry.nodes.iter().filter_map(|&node| layout.nodes[node]);
                nodes.map(|first| first / dimension)
            };
            for row in masses() {
                pairs.extend(masses().map(|column| (row, column)));
            }
        }
        let masses = layout.nodes.iter().flatten().count();
        Self::new(masses, pairs)
    }

    /// The pattern with each unknown twice, first all of them, then all again: every copy of a row
    /// has both copies of its columns.
    pub(crate) fn doubled(&self) -> Self {
        let unknowns = self.unknowns();
        let rows = (0..unknowns).flat_map(|row| self.row(row).iter().map(move |&at| (row, at)));
        let copies = |(row, column)| {
            let both = |at| [at, at + unknowns];
            both(row).map(|row| both(column).map(|column| (row, column)))
        };
        Self::new(2 * unknowns, rows.flat_map(copies).flatten())
    }

    /// Number of rows and of columns.
    pub(crate) fn unknowns(&self) -> usize {
        self.starts.len() - 1
    }

    /// The columns of a row, ascending.
    pub(crate) fn row(&self, row: usize) -> &[usize] {
        &self.columns[self.starts[row]..self.starts[row + 1]]
    }
}

#[cfg(test)]
mod tests {
    use super::Pattern;

    #[test]
    fn patterns_are_symmetric_and_sorted() {
        let pattern = Pattern::new(3, [(2, 0), (2, 0), (0, 1)]);
        assert_eq!(pattern.unknowns(), 3);
        assert_eq!(pattern.row(0), [0, 1, 2]);
        assert_eq!(pattern.row(1), [0, 1]);
        assert_eq!(pattern.row(2), [0, 2]);
    }
    #[test]
    fn a_doubled_pattern_has_every_entry_four_times() {
        let pattern = Pattern::new(2, []).doubled();
        assert_eq!(pattern.unknowns(), 4);
        assert_eq!(pattern.row(1), [1, 3]);
        assert_eq!(pattern.row(2), [0, 2]);
    }
}
