//! The multifrontal elimination (Duff & Reid 1983): fronts of a branch in sequence, branches in parallel.
//!
//! A front gathers the matrix entries of its own unknowns and the Schur complements of the fronts below
//! it, eliminates its own unknowns as dense blocks, and leaves a Schur complement for a later front.
//! Schur complements that wait lie on a stack. Each branch has a stack of its own, so the order of all
//! sums, and every bit of the factors, is the same on any number of threads.

use core::array;
use core::ops::Range;

use crate::compact::compact;
use crate::division::Division;
use crate::elimination::{Blocks, Scratch};
use crate::fronts::{Extent, Front, Fronts};
use crate::gathering::{Matrix, Rows, add, gather};
use crate::threads;

/// Memory for the factors of consecutive fronts; the layout is that of `Factors`.
#[derive(Debug)]
pub(crate) struct Memory<'a> {
    pub(crate) lower: &'a mut [f64],
    pub(crate) upper: &'a mut [f64],
    pub(crate) pivots: &'a mut [u32],
}

impl Memory<'_> {
    /// Splits each array after the given number of entries.
    fn split_at(self, [lower, upper, pivots]: [usize; 3]) -> (Self, Self) {
        let (lower, later_lower) = self.lower.split_at_mut(lower);
        let (upper, later_upper) = self.upper.split_at_mut(upper);
        let (pivots, later_pivots) = self.pivots.split_at_mut(pivots);
        let begin = Self {
            lower,
            upper,
            pivots,
        };
        let rest = Self {
            lower: later_lower,
            upper: later_upper,
            pivots: later_pivots,
        };
        (begin, rest)
    }
}

/// If no front of a branch has more nodes below than this, the row of a node is found by search; otherwise rows
/// are written to a table, see `Rows`.
const MOST_SEARCHED: usize = 2;

/// Working memory for the fronts of a division.
#[derive(Debug)]
pub(crate) struct Branch {
    parts: Vec<Branch>,
    own: Range<usize>,
    /// The lengths of the arrays of [`Memory`] for these fronts, with blocks of one row.
    sizes: [usize; 3],
    stack: Stack,
    rows: Rows,
    /// For each row of a Schur complement from below, its row in the current front.
    targets: Vec<u32>,
    scratch: Scratch,
}

/// Schur complements that no front has taken up yet, the latest on top.
#[derive(Debug)]
struct Stack {
    entries: Vec<f64>,
    waiting: Waiting,
}

/// The fronts whose Schur complements are on the stack, and how many numbers these have.
#[derive(Debug)]
struct Waiting {
    fronts: Vec<u32>,
    top: usize,
}

impl Waiting {
    /// Removes the latest front if its Schur complement belongs to the given front, and returns it.
    fn pop_for<'a, const L: usize>(
        &mut self,
        front: &Front<'_>,
        matrix: &Matrix<'a, L>,
    ) -> Option<Front<'a>> {
        let last = matrix.fronts.front(*self.fronts.last()? as usize);
        if !last.contributes_to(front) {
            return None;
        }
        self.fronts.pop();
        let [_, height] = last.sizes(L);
        self.top -= height * height;
        Some(last)
    }
}

impl Branch {
    /// Memory for a division and blocks of this many rows; `None` if it cannot be allocated.
    pub(crate) fn new(fronts: &Fronts, division: Division, length: usize) -> Option<Self> {
        let Division { parts, own } = division;
        let Extent { lower, upper, .. } = fronts.extent(own.clone(), 1);
        let places = fronts.places(&own);
        let own_sizes = [lower, upper, places.len()];
        let Extent {
            left,
            waiting,
            width,
            height,
            ..
        } = fronts.extent(own.clone(), length);
        let parts = parts.into_iter();
        let parts = parts.map(|part| Self::new(fronts, part, length));
        let parts = parts.collect::<Option<Vec<_>>>()?;
        // Rows are found by search in branches of small fronts, and in the few fronts after parts.
        let is_noted = parts.is_empty() && height > MOST_SEARCHED * length;
        let noted = if is_noted { places } else { 0..0 };
        let of_parts = total(&parts);
        let left_by_parts = parts.iter().map(|part| part.targets.len());
        Some(Self {
            own,
            sizes: array::from_fn(|of| of_parts[of] + own_sizes[of]),
            stack: Stack {
                entries: zeros(left)?,
                waiting: Waiting {
                    fronts: Vec::with_capacity(waiting),
                    top: 0,
                },
            },
            rows: Rows::new(noted),
            targets: vec![0; left_by_parts.fold(height, usize::max)],
            scratch: Scratch::new(width),
            parts,
        })
    }

    /// The most numbers on all stacks of a division, with blocks of this many rows.
    pub(crate) fn stacks(fronts: &Fronts, division: &Division, length: usize) -> usize {
        let own = fronts.extent(division.own.clone(), length).left;
        let parts = division.parts.iter();
        parts.fold(own, |sum, part| sum + Self::stacks(fronts, part, length))
    }

    /// Whether some of its fronts can be factored at the same time as others.
    pub(crate) const fn has_parts(&self) -> bool {
        !self.parts.is_empty()
    }

    /// Factors its parts, then its own fronts.
    pub(crate) fn factor<const L: usize>(&mut self, matrix: Matrix<'_, L>, memory: Memory<'_>) {
        let of_parts = in_blocks(total(&self.parts), L);
        let (of_parts, mut memory) = memory.split_at(of_parts);
        factor_together(&mut self.parts, matrix, of_parts);
        for at in self.own.clone() {
            let front = matrix.fronts.front(at);
            let [width, height] = front.sizes(L);
            let sizes = [width * (width + height), width * height, width];
            let (own, later) = memory.split_at(sizes);
            memory = later;
            self.eliminate(at, &front, &matrix, own);
        }
    }

    /// Eliminates the own unknowns of a front.
    fn eliminate<const L: usize>(
        &mut self,
        at: usize,
        front: &Front<'_>,
        matrix: &Matrix<'_, L>,
        memory: Memory<'_>,
    ) {
        let Memory {
            lower,
            upper,
            pivots,
        } = memory;
        let Stack { entries, waiting } = &mut self.stack;
        let [_, height] = front.sizes(L);
        let (square, top) = (height * height, waiting.top);
        let (below, free) = entries.split_at_mut(top);
        let mut blocks = Blocks {
            lower,
            upper,
            schur: &mut free[..square],
            pivots,
        };
        blocks.clear();
        self.rows.note(front);
        gather(&mut blocks, front, &self.rows, matrix);
        let mut take_up = |child: &Front<'_>, left: &[f64]| {
            let targets = &mut self.targets[..child.rows.len() * L];
            let nodes = targets.as_chunks_mut::<L>().0;
            for (node, &place) in nodes.iter_mut().zip(child.rows) {
                let first = compact(self.rows.of(place as usize, front) * L);
                (first..).zip(node).for_each(|(row, target)| *target = row);
            }
            add(&mut blocks, targets, left);
        };
        while let Some(child) = waiting.pop_for(front, matrix) {
            take_up(&child, &below[waiting.top..]);
        }
        // The Schur complements of the parts were pushed before those of the own fronts, so they come
        // after them, and those of the last part first.
        for Stack { entries, waiting } in self.parts.iter_mut().rev().map(|part| &mut part.stack) {
            while let Some(child) = waiting.pop_for(front, matrix) {
                take_up(&child, &entries[waiting.top..]);
            }
        }
        blocks.eliminate(&mut self.scratch);
        if square > 0 {
            waiting.fronts.push(compact(at));
        }
        if waiting.top < top {
            entries.copy_within(top..top + square, waiting.top);
        }
        waiting.top += square;
    }
}

/// The lengths of the arrays of [`Memory`] for several branches.
fn total(branches: &[Branch]) -> [usize; 3] {
    let add = |sum: [usize; 3], branch: &Branch| array::from_fn(|of| sum[of] + branch.sizes[of]);
    branches.iter().fold([0; 3], add)
}

/// The same for blocks of this many rows.
fn in_blocks([lower, upper, pivots]: [usize; 3], length: usize) -> [usize; 3] {
    let square = length * length;
    [lower * square, upper * square, pivots * length]
}

/// Factors independent branches.
fn factor_together<const L: usize>(
    branches: &mut [Branch],
    matrix: Matrix<'_, L>,
    memory: Memory<'_>,
) {
    let Some((first, rest)) = branches.split_first_mut() else {
        return;
    };
    let (own, others) = memory.split_at(in_blocks(first.sizes, L));
    threads::join(
        || first.factor(matrix, own),
        || factor_together(rest, matrix, others),
    );
}

/// A vector of zeros; `None` if its memory cannot be allocated.
pub(crate) fn zeros(count: usize) -> Option<Vec<f64>> {
    let mut zeros = Vec::new();
    zeros.try_reserve_exact(count).ok()?;
    zeros.resize(count, 0.0);
    Some(zeros)
}

#[cfg(test)]
#[cfg(feature = "parallel")]
mod tests {
    use super::*;
    use crate::pattern::Pattern;

    /// Nodes along a side of the lattice.
    const SIDE: usize = 90;

    /// The factors of a matrix of a lattice, which is not symmetric, found by this many threads.
    fn factors(division: fn(&Fronts) -> Division, threads: usize) -> [Vec<u64>; 3] {
        let pattern = Pattern::new(SIDE * SIDE, |pair| {
            for at in 0..SIDE * SIDE {
                if at % SIDE > 0 {
                    pair(at - 1, at);
                }
                if at >= SIDE {
                    pair(at - SIDE, at);
                }
            }
        });
        let mut values = vec![0.0; pattern.entries()];
        for row in 0..pattern.unknowns() {
            for (place, &column) in pattern.blocks(row).zip(pattern.row(row)) {
                let off = u8::try_from((3 * row + 5 * column as usize) % 7).unwrap();
                values[place] = if row == column as usize {
                    9.1
                } else {
                    f64::from(off) - 2.3
                };
            }
        }
        let fronts = Fronts::new(&pattern).unwrap();
        let mut branch = Branch::new(&fronts, division(&fronts), 1).unwrap();
        let [mut lower, mut upper] = [0, 1].map(|at| vec![f64::NAN; branch.sizes[at]]);
        let mut pivots = vec![0; pattern.unknowns()];
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        let pool = pool.build().unwrap();
        // The second time, memory is as the first time left it.
        for _ in 0..2 {
            let matrix = Matrix::<1> {
                fronts: &fronts,
                pattern: &pattern,
                values: &values,
            };
            let memory = Memory {
                lower: &mut lower,
                upper: &mut upper,
                pivots: &mut pivots,
            };
            pool.install(|| branch.factor(matrix, memory));
        }
        let bits = |entries: &[f64]| entries.iter().map(|entry| entry.to_bits()).collect();
        [
            bits(&lower),
            bits(&upper),
            pivots.into_iter().map(u64::from).collect(),
        ]
    }

    #[test]
    fn factors_have_the_same_bits_however_they_are_divided() {
        let divided = |fronts: &Fronts| {
            let division = Division::new(fronts, 1);
            assert!(division.parts.len() >= 2, "{division:?}");
            division
        };
        let whole = factors(|fronts| Division::whole(0..fronts.len()), 1);
        for threads in [1, 2, 4] {
            assert!(factors(divided, threads) == whole, "{threads} threads");
        }
    }
}
