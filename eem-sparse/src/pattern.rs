//! Which entries of a square matrix can differ from zero.
//!
//! The pattern is symmetric, the values need not be. Entries come in dense square *blocks* of equal
//! size: with three unknowns per node of a mesh, the coupling of two nodes is a block of 3 × 3, and
//! the pattern is the graph of the nodes.

use core::ops::Range;

use crate::compact::compact;
use crate::error::Error;

/// The most rows of a block: the three coordinates of a node in space.
pub const LARGEST_BLOCK: usize = 3;

/// Which blocks of a square matrix can differ from zero; the structure is symmetric.
///
/// ```
/// use eem_sparse::Pattern;
///
/// // Three unknowns in a row, each coupled with the next.
/// let chain = Pattern::new(3, |pair| {
///     pair(0, 1);
///     pair(1, 2);
/// });
/// assert_eq!(chain.entries(), 7);
/// assert_eq!(chain.position(1, 2), Some(4));
/// assert_eq!(chain.position(0, 2), None);
/// // The same chain with two unknowns in the place of each.
/// let chain = chain.in_blocks(2)?;
/// assert_eq!((chain.unknowns(), chain.entries()), (6, 28));
/// # Ok::<(), eem_sparse::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Pattern {
    /// Rows of a block.
    length: usize,
    /// Node r has blocks with the nodes `columns[starts[r]..starts[r + 1]]`, ascending.
    starts: Vec<u32>,
    columns: Vec<u32>,
}

/// Names pairs of unknowns to a function.
type Visit<'a> = dyn Fn(&mut dyn FnMut(usize, usize)) + 'a;

impl Pattern {
    /// The pattern with the whole diagonal, all pairs that `visit` names, and their mirror images.
    ///
    /// A pair may be named any number of times. `visit` is called twice, to count and to write, so that
    /// no list of pairs is stored. Blocks have one row.
    ///
    /// ```
    /// let pattern = eem_sparse::Pattern::new(2, |pair| pair(0, 1));
    /// assert_eq!(pattern.entries(), 4);
    /// ```
    ///
    /// # Panics
    ///
    /// If a pair has an index that is not below `unknowns`, or if the second call names more or fewer pairs
    /// with a row than the first.
    #[must_use]
    pub fn new(unknowns: usize, visit: impl Fn(&mut dyn FnMut(usize, usize))) -> Self {
        Self::of_pairs(unknowns, &visit)
    }

    fn of_pairs(unknowns: usize, visit: &Visit<'_>) -> Self {
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
        let are_full = next[..unknowns] == ends[1..];
        assert!(are_full, "both calls of `visit` name the same pairs");
        Self::sorted(&ends, columns)
    }

    /// Sorts the columns of each row, and drops duplicates. `ends` says where rows begin and end.
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

    /// The pattern with a block of `length × length` in the place of each block.
    ///
    /// The unknowns of block row r are `r * length..(r + 1) * length`.
    ///
    /// ```
    /// let pattern = eem_sparse::Pattern::new(4, |_| {}).in_blocks(3)?;
    /// assert_eq!((pattern.unknowns(), pattern.entries()), (12, 36));
    /// # Ok::<(), eem_sparse::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`Error::BlockLength`] unless `length` is between 1 and [`LARGEST_BLOCK`].
    pub fn in_blocks(self, length: usize) -> Result<Self, Error> {
        if (1..=LARGEST_BLOCK).contains(&length) {
            Ok(Self { length, ..self })
        } else {
            Err(Error::BlockLength { length })
        }
    }

    /// The pattern of several copies of the unknowns, set after set: every entry couples each set with each.
    ///
    /// Unknown u of set k has the number `u + k n`, where n is the number of unknowns here. Blocks have one row.
    ///
    /// ```
    /// let repeated = eem_sparse::Pattern::new(2, |_| {}).repeated(2);
    /// assert_eq!((repeated.unknowns(), repeated.entries()), (4, 8));
    /// assert!(repeated.position(1, 3).is_some());
    /// ```
    #[must_use]
    pub fn repeated(&self, sets: usize) -> Self {
        let unknowns = self.unknowns();
        Self::new(sets * unknowns, |pair| {
            self.each_entry(|row, column| {
                for [down, right] in (0..sets * sets).map(|at| [at / sets, at % sets]) {
                    pair(row + down * unknowns, column + right * unknowns);
                }
            });
        })
    }

    /// Calls `visit` with row and column of every entry.
    fn each_entry(&self, mut visit: impl FnMut(usize, usize)) {
        let length = self.length;
        for row in 0..self.unknowns() {
            for &node in self.row(row / length) {
                let first = node as usize * length;
                (first..first + length).for_each(|column| visit(row, column));
            }
        }
    }

    /// Number of rows and of columns.
    ///
    /// ```
    /// assert_eq!(eem_sparse::Pattern::new(7, |_| {}).unknowns(), 7);
    /// ```
    #[must_use]
    pub fn unknowns(&self) -> usize {
        self.nodes() * self.length
    }

    /// Number of rows of a block.
    ///
    /// ```
    /// assert_eq!(eem_sparse::Pattern::new(7, |_| {}).block_length(), 1);
    /// ```
    #[must_use]
    pub fn block_length(&self) -> usize {
        self.length
    }

    /// Number of entries, which is the length of an array of values.
    ///
    /// ```
    /// assert_eq!(eem_sparse::Pattern::new(7, |pair| pair(3, 6)).entries(), 9);
    /// ```
    #[must_use]
    pub fn entries(&self) -> usize {
        self.columns.len() * self.length * self.length
    }

    /// Where an entry is in an array of values: block by block, each block row by row.
    ///
    /// `None` if the pattern does not have the entry.
    ///
    /// ```
    /// let pattern = eem_sparse::Pattern::new(2, |_| {}).in_blocks(2)?;
    /// assert_eq!(pattern.position(1, 0), Some(2));
    /// assert_eq!(pattern.position(3, 2), Some(6));
    /// assert_eq!(pattern.position(0, 3), None);
    /// # Ok::<(), eem_sparse::Error>(())
    /// ```
    #[must_use]
    pub fn position(&self, row: usize, column: usize) -> Option<usize> {
        let length = self.length;
        if row >= self.unknowns() {
            return None;
        }
        let block = self.block(row / length, column / length)?;
        Some((block * length + row % length) * length + column % length)
    }

    /// The entries of a row, each as its place in an array of values and its column; columns ascend.
    ///
    /// ```
    /// let pattern = eem_sparse::Pattern::new(3, |pair| pair(0, 2));
    /// assert_eq!(pattern.entries_of(2).collect::<Vec<_>>(), [(3, 0), (4, 2)]);
    /// ```
    ///
    /// # Panics
    ///
    /// If there is no such row.
    pub fn entries_of(&self, row: usize) -> impl Iterator<Item = (usize, usize)> {
        let length = self.length;
        let node = row / length;
        let blocks = self.blocks(node).zip(self.row(node));
        blocks.flat_map(move |(block, &column)| {
            let position = (block * length + row % length) * length;
            (0..length).map(move |at| (position + at, column as usize * length + at))
        })
    }

    /// Number of nodes, which is that of block rows.
    pub(crate) fn nodes(&self) -> usize {
        self.starts.len() - 1
    }

    /// The nodes that share a block with this one, ascending.
    pub(crate) fn row(&self, node: usize) -> &[u32] {
        &self.columns[self.blocks(node)]
    }

    /// The numbers of the blocks of a node.
    pub(crate) fn blocks(&self, node: usize) -> Range<usize> {
        self.starts[node] as usize..self.starts[node + 1] as usize
    }

    /// The column of each block.
    pub(crate) fn columns(&self) -> &[u32] {
        &self.columns
    }

    /// The number of the block of two nodes.
    pub(crate) fn block(&self, row: usize, column: usize) -> Option<usize> {
        let column = u32::try_from(column).ok()?;
        let place = self.row(row).binary_search(&column).ok()?;
        Some(self.blocks(row).start + place)
    }
}

#[cfg(test)]
mod tests {
    use core::cell::Cell;

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

    // Without the check, the second row would be coupled with the first, but not the first with it.
    #[test]
    #[should_panic(expected = "the same pairs")]
    fn a_second_call_with_other_pairs_is_refused() {
        let calls = Cell::new(0);
        let _ = Pattern::new(3, |pair| {
            calls.set(calls.get() + 1);
            pair(1, [2, 0][calls.get() - 1]);
        });
    }

    #[test]
    fn entries_of_nodes_lie_block_by_block() {
        let pattern = Pattern::new(3, |pair| pair(0, 2)).in_blocks(2).unwrap();
        assert_eq!((pattern.unknowns(), pattern.entries()), (6, 20));
        assert_eq!(pattern.position(0, 1), Some(1));
        assert_eq!(pattern.position(1, 4), Some(6));
        assert_eq!(pattern.position(1, 2), None);
    }

    #[test]
    fn a_pattern_of_two_sets_has_every_entry_four_times() {
        let pattern = Pattern::new(2, |_| {}).repeated(2);
        assert_eq!(pattern.unknowns(), 4);
        assert_eq!(pattern.row(1), [1, 3]);
        assert_eq!(pattern.row(2), [0, 2]);
    }

    #[test]
    fn positions_are_counted_block_by_block_and_row_by_row() {
        for length in 1..=3 {
            let pattern = Pattern::new(4, |pair| {
                pair(0, 2);
                pair(1, 2);
                pair(3, 0);
            });
            let pattern = pattern.in_blocks(length).unwrap();
            let mut count = 0;
            for (node, row) in [&[0, 2, 3][..], &[1, 2], &[0, 1, 2], &[0, 3]]
                .iter()
                .enumerate()
            {
                for other in *row {
                    for at in 0..length * length {
                        let [down, right] = [at / length, at % length];
                        let position =
                            pattern.position(node * length + down, other * length + right);
                        assert_eq!(position, Some(count));
                        count += 1;
                    }
                }
            }
            assert_eq!(pattern.entries(), count);
            let outside = pattern.unknowns();
            assert_eq!(pattern.position(outside, 0), None);
            assert_eq!(pattern.position(0, outside), None);
        }
    }

    #[test]
    fn sets_share_every_entry_with_each_other_and_no_more() {
        let pattern = Pattern::new(3, |pair| pair(0, 2)).in_blocks(2).unwrap();
        let repeated = pattern.repeated(3);
        assert_eq!(repeated.unknowns(), 18);
        for row in 0..18 {
            for column in 0..18 {
                let expected = pattern.position(row % 6, column % 6).is_some();
                assert_eq!(repeated.position(row, column).is_some(), expected);
            }
        }
    }
}
