//! Which entries of a square matrix can differ from zero, found once per scene.
//!
//! The pattern is symmetric, the values are not. Two matrices are solved with in a step:
//!
//! ```text
//! tangent   displacements of the masses and temperatures Θ that neighbours see; each iteration
//! secant    one unknown per mass, the same for every axis of space; once per step, D right sides
//! ```

use core::ops::Range;

use crate::compact::compact;
use crate::conduction::{Conduction, Partner};
use crate::layout::Layout;
use crate::scalar::Real;
use crate::scene::ElementEntry;

/// The structural entries of a matrix, row by row, columns ascending.
#[derive(Clone, Debug)]
pub(crate) struct Pattern {
    /// Row r has the columns `columns[starts[r]..starts[r + 1]]`.
    starts: Vec<u32>,
    columns: Vec<u32>,
}

impl Pattern {
    /// The pattern with the whole diagonal, the pairs that `visit` names, any number of times, and
    /// their mirror images.
    ///
    /// `visit` is called twice: to count, and to write. So the only memory is that of the pattern.
    pub(crate) fn new(unknowns: usize, visit: impl Fn(&mut dyn FnMut(usize, usize))) -> Self {
        let mut ends = vec![0; unknowns + 1];
        for end in &mut ends[1..] {
            *end = 1;
        }
        visit(&mut |a, b| {
            ends[a + 1] += 1;
            ends[b + 1] += 1;
        });
        for row in 0..unknowns {
            ends[row + 1] += ends[row];
        }
        let mut columns = vec![0; ends[unknowns]];
        let mut next = ends.clone();
        let mut write = |row: usize, column: usize| {
            columns[next[row]] = compact(column);
            next[row] += 1;
        };
        (0..unknowns).for_each(|row| write(row, row));
        visit(&mut |a, b| {
            write(a, b);
            write(b, a);
        });
        Self::sorted(&ends, columns)
    }

    /// Sorts rows that end where the next begins, and drops what they have twice.
    fn sorted(ends: &[usize], mut columns: Vec<u32>) -> Self {
        let mut starts = Vec::with_capacity(ends.len());
        let mut length = 0;
        for row in ends.windows(2) {
            starts.push(compact(length));
            columns[row[0]..row[1]].sort_unstable();
            let first = length;
            for at in row[0]..row[1] {
                let column = columns[at];
                if length == first || columns[length - 1] != column {
                    columns[length] = column;
                    length += 1;
                }
            }
        }
        starts.push(compact(length));
        columns.truncate(length);
        columns.shrink_to_fit();
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
        Self::new(layout.unknowns, |pair| {
            for (entry, slots) in elements.iter().zip(&layout.elements) {
                let slot = slots.thermal;
                let own = || {
                    let nodes = entry.nodes.iter().filter_map(|&node| layout.nodes[node]);
                    let positions = nodes.flat_map(|first| first..first + dimension);
                    positions.chain(slot.and_then(|slot| layout.coupled[slot]))
                };
                let links = slot.map_or(&[][..], |slot| conduction.links(slot));
                pair_all(own, pair);
                for row in own() {
                    for link in links {
                        if let Partner::Slot(partner) = link.partner
                            && let Some(column) = layout.coupled[partner]
                        {
                            pair(row, column);
                        }
                    }
                }
            }
        })
    }

    /// The pattern of the secant matrix.
    pub(crate) fn of_secant<S>(
        elements: &[ElementEntry<S>],
        layout: &Layout,
        dimension: usize,
    ) -> Self {
        let masses = layout.nodes.iter().flatten().count();
        Self::new(masses, |pair| {
            for entry in elements {
                let masses = || {
                    let nodes = entry.nodes.iter().filter_map(|&node| layout.nodes[node]);
                    nodes.map(|first| first / dimension)
                };
                pair_all(masses, pair);
            }
        })
    }

    /// The pattern with each unknown twice, first all of them, then all again: every copy of a row
    /// has both copies of its columns.
    pub(crate) fn doubled(&self) -> Self {
        let unknowns = self.unknowns();
        Self::new(2 * unknowns, |pair| {
            for row in 0..unknowns {
                for &column in self.row(row) {
                    let column = column as usize;
                    for shift in [0, unknowns] {
                        pair(row, column + shift);
                        pair(row + unknowns, column + shift);
                    }
                }
            }
        })
    }

    /// Number of rows and of columns.
    pub(crate) fn unknowns(&self) -> usize {
        self.starts.len() - 1
    }

    /// Number of entries.
    #[cfg(any(feature = "sparse", test))]
    pub(crate) fn entries(&self) -> usize {
        self.columns.len()
    }

    /// Where each row starts among the entries, and where the last one ends.
    #[cfg(feature = "sparse")]
    pub(crate) fn starts(&self) -> &[u32] {
        &self.starts
    }

    /// The columns of all rows, one row after the other.
    #[cfg(feature = "sparse")]
    pub(crate) fn columns(&self) -> &[u32] {
        &self.columns
    }

    /// The columns of a row, ascending.
    pub(crate) fn row(&self, row: usize) -> &[u32] {
        &self.columns[self.places(row)]
    }

    /// Where the entries of a row are among all entries.
    pub(crate) fn places(&self, row: usize) -> Range<usize> {
        self.starts[row] as usize..self.starts[row + 1] as usize
    }

    /// Where an entry is among all entries, if it is structural.
    #[cfg(feature = "sparse")]
    pub(crate) fn position(&self, row: usize, column: usize) -> Option<usize> {
        let place = self.row(row).binary_search(&compact(column)).ok()?;
        Some(self.places(row).start + place)
    }
}

/// Names every pair of some unknowns.
fn pair_all<I: Iterator<Item = usize>>(own: impl Fn() -> I, pair: &mut dyn FnMut(usize, usize)) {
    for row in own() {
        own()
            .filter(|&column| column < row)
            .for_each(|column| pair(row, column));
    }
}

#[cfg(test)]
mod tests {
    use super::Pattern;

    #[test]
    fn patterns_are_symmetric_and_sorted() {
        let pattern = Pattern::new(3, |pair| {
            pair(2, 0);
            pair(2, 0);
            pair(0, 1);
        });
        assert_eq!((pattern.unknowns(), pattern.entries()), (3, 7));
        assert_eq!(pattern.row(0), [0, 1, 2]);
        assert_eq!(pattern.row(1), [0, 1]);
        assert_eq!(pattern.row(2), [0, 2]);
    }
    #[test]
    fn a_doubled_pattern_has_every_entry_four_times() {
        let pattern = Pattern::new(2, |_| {}).doubled();
        assert_eq!(pattern.unknowns(), 4);
        assert_eq!(pattern.row(1), [1, 3]);
        assert_eq!(pattern.row(2), [0, 2]);
    }
}
