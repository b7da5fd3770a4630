//! Which entries of a square matrix can differ from zero, found once per scene.
//!
//! The pattern is symmetric, the values are not. Two matrices are solved with in a step:
//!
//! ```text
//! tangent   displacements of the masses and temperatures Θ that neighbours see; each iteration
//! secant    one unknown per mass, the same for every axis of space; once per step, D right sides
//! ```
//!
//! Where elements share nothing but nodes, both are the graph of the masses: unknowns come in *runs*, one per
//! axis of space in the tangent, and the entries of two masses are a block.

use core::ops::Range;

use crate::compact::compact;
use crate::conduction::{Conduction, Partner};
use crate::layout::Layout;
use crate::scalar::Real;
use crate::scene::ElementEntry;

/// The most unknowns in a run: those of a node in space.
pub(crate) const LONGEST_RUN: usize = 3;

/// The structural entries of a matrix whose unknowns come in runs of equal length: which runs share a
/// full block of entries, row by row, columns ascending.
#[derive(Clone, Debug)]
pub(crate) struct Pattern {
    /// Unknowns in a run.
    length: usize,
    /// Run r has blocks with the runs `columns[starts[r]..starts[r + 1]]`.
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
        Self {
            length: 1,
            starts,
            columns,
        }
    }

    /// The pattern with a run of that many unknowns in the place of each.
    pub(crate) fn in_runs(self, length: usize) -> Self {
        Self { length, ..self }
    }

    /// The pattern of the tangent.
    ///
    /// The forces of an element depend on its nodes, on its own Θ and on that of its partners, and
    /// so does its own Θ. If there are no Θ, the coordinates of a node are a run.
    pub(crate) fn of_tangent<S: Real>(
        elements: &[ElementEntry<S>],
        layout: &Layout,
        conduction: &Conduction<S>,
        dimension: usize,
    ) -> Self {
        if dimension <= LONGEST_RUN && layout.coupled.iter().all(Option::is_none) {
            return Self::of_secant(elements, layout, dimension).in_runs(dimension);
        }
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

    /// The pattern of so many sets of its unknowns, set after set: every row has the columns of all sets.
    pub(crate) fn repeated(&self, sets: usize) -> Self {
        let unknowns = self.unknowns();
        Self::new(sets * unknowns, |pair| {
            self.each_entry(|row, column| {
                for [down, right] in (0..sets * sets).map(|at| [at / sets, at % sets]) {
                    pair(row + down * unknowns, column + right * unknowns);
                }
            });
        })
    }

    /// Names all entries.
    fn each_entry(&self, mut visit: impl FnMut(usize, usize)) {
        let length = self.length;
        for row in 0..self.unknowns() {
            for &run in self.row(row / length) {
                let first = run as usize * length;
                (first..first + length).for_each(|column| visit(row, column));
            }
        }
    }

    /// Number of rows and of columns.
    pub(crate) fn unknowns(&self) -> usize {
        self.runs() * self.length
    }

    /// Number of runs.
    pub(crate) fn runs(&self) -> usize {
        self.starts.len() - 1
    }

    /// Number of entries.
    #[cfg(any(feature = "sparse", test))]
    pub(crate) fn entries(&self) -> usize {
        self.columns.len() * self.length * self.length
    }

    /// The runs that share a block with one, ascending.
    pub(crate) fn row(&self, run: usize) -> &[u32] {
        &self.columns[self.blocks(run)]
    }

    /// Where the blocks of a run are among all blocks.
    pub(crate) fn blocks(&self, run: usize) -> Range<usize> {
        self.starts[run] as usize..self.starts[run + 1] as usize
    }
}

/// What a sparse elimination asks.
#[cfg(feature = "sparse")]
impl Pattern {
    /// Number of unknowns in a run.
    pub(crate) fn length(&self) -> usize {
        self.length
    }

    /// Where each run starts among the blocks, and where the last one ends.
    pub(crate) fn starts(&self) -> &[u32] {
        &self.starts
    }

    /// The columns of all runs, one run after the other.
    pub(crate) fn columns(&self) -> &[u32] {
        &self.columns
    }

    /// Where the block of two runs is among all blocks, if it is structural.
    pub(crate) fn block(&self, row: usize, column: usize) -> Option<usize> {
        let place = self.row(row).binary_search(&compact(column)).ok()?;
        Some(self.blocks(row).start + place)
    }

    /// Where an entry is among all entries, block by block and each row by row, if it is structural.
    pub(crate) fn position(&self, row: usize, column: usize) -> Option<usize> {
        let length = self.length;
        let block = self.block(row / length, column / length)?;
        Some((block * length + row % length) * length + column % length)
    }

    /// The same entries for runs of that many unknowns, with each unknown a run of its own.
    pub(crate) fn one_by_one(&self, length: usize) -> Self {
        let with_runs = self.clone().in_runs(length);
        Self::new(with_runs.unknowns(), |pair| with_runs.each_entry(pair))
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
    #[cfg(feature = "sparse")]
    fn entries_of_runs_lie_block_by_block() {
        let pattern = Pattern::new(3, |pair| pair(0, 2)).in_runs(2);
        assert_eq!((pattern.unknowns(), pattern.entries()), (6, 20));
        assert_eq!(pattern.position(0, 1), Some(1));
        assert_eq!(pattern.position(1, 4), Some(6));
        assert_eq!(pattern.position(1, 2), None);
        let single = pattern.one_by_one(2);
        assert_eq!((single.unknowns(), single.entries()), (6, 20));
        assert_eq!(single.row(1), [0, 1, 4, 5]);
    }

    #[test]
    fn a_pattern_of_two_sets_has_every_entry_four_times() {
        let pattern = Pattern::new(2, |_| {}).repeated(2);
        assert_eq!(pattern.unknowns(), 4);
        assert_eq!(pattern.row(1), [1, 3]);
        assert_eq!(pattern.row(2), [0, 2]);
    }
}
