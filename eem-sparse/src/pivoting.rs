//! Elimination that delays unknowns without a good pivot, for matrices with tiny pivots near the diagonal.
//!
//! ```text
//! front   own rows and columns, and those that fronts below delayed;   rows and columns of later fronts
//! pivot   in an own column, the largest entry of own rows, unless one of a later row is much larger
//! ```
//!
//! A column without a pivot, and a row that became none, are left to the next front with the Schur complement, where
//! more rows can be pivots (Duff & Reid 1983). In the last front all rows can. This takes more time and memory than
//! the elimination without delays. The caller checks the solution.

use core::mem;
use core::ops::Range;

use ndarray::Axis;

use crate::branch::zeros;
use crate::compact::compact;
use crate::dense::{columns, columns_mut, solve, subtract, subtract_product};
use crate::error::Error;
use crate::fronts::Front;
use crate::gathering::Matrix;

/// A pivot is at least this share of the largest entry of its column, so L has no larger entry than 1 / SHARE.
const SHARE: f64 = 0.25;

/// At most this many columns are eliminated by loops before later columns are updated.
const BLOCK: usize = 32;

/// The factors of one front. Unknowns are numbered in the order of elimination by fronts.
#[derive(Debug)]
struct Factor {
    /// The rows and columns of the front, those of the pivots first.
    rows: Vec<u32>,
    columns: Vec<u32>,
    /// The columns of the pivots, with L below the diagonal of U.
    lower: Vec<f64>,
    /// The rows of the pivots in later columns.
    upper: Vec<f64>,
}

/// What is left of a front for the next: a Schur complement.
struct Left {
    front: usize,
    /// How many of its rows and columns have been delayed.
    delayed: usize,
    rows: Vec<u32>,
    columns: Vec<u32>,
    entries: Vec<f64>,
}

/// The factors of a matrix.
#[derive(Debug)]
pub(crate) struct Pivoting {
    factors: Vec<Factor>,
    /// The solution, numbered by columns; right-hand sides are numbered by rows.
    solution: Vec<f64>,
}

impl Pivoting {
    /// Factors a matrix; `None` if it is singular.
    pub(crate) fn new<const L: usize>(matrix: &Matrix<'_, L>) -> Result<Option<Self>, Error> {
        let count = matrix.pattern.unknowns();
        let mut at = [vec![0; count], vec![0; count]];
        let mut waiting: Vec<Left> = Vec::new();
        let mut factors = Vec::with_capacity(matrix.fronts.len());
        for number in 0..matrix.fronts.len() {
            let front = matrix.fronts.front(number);
            let mut children = Vec::new();
            let belongs = |left: &mut Left| matrix.fronts.front(left.front).contributes_to(&front);
            while let Some(child) = waiting.pop_if(belongs) {
                children.push(child);
            }
            let mut dense = Dense::gather(matrix, &front, &children, &mut at)?;
            drop(children);
            let pivots = dense.eliminate();
            let (factor, left) = dense.split(pivots, number);
            factors.push(factor);
            if front.rows.is_empty() && left.delayed > 0 {
                return Ok(None);
            }
            if !front.rows.is_empty() {
                waiting.push(left);
            }
        }
        Ok(Some(Self {
            factors,
            solution: vec![0.0; count],
        }))
    }

    /// Overwrites a right-hand side by the solution.
    pub(crate) fn solve(&mut self, x: &mut [f64]) {
        let mut part = Vec::new();
        for Factor { rows, lower, .. } in &self.factors {
            part.clear();
            part.extend(rows.iter().map(|&row| x[row as usize]));
            for (k, column) in lower.chunks_exact(rows.len()).enumerate() {
                subtract(&mut part[k..], &column[k..]);
            }
            for (&row, &value) in rows.iter().zip(&part) {
                x[row as usize] = value;
            }
        }
        for factor in self.factors.iter().rev() {
            let Factor {
                rows,
                columns,
                lower,
                upper,
            } = factor;
            let pivots = lower.len() / rows.len();
            part.clear();
            part.extend(rows[..pivots].iter().map(|&row| x[row as usize]));
            if pivots > 0 {
                for (&column, entries) in columns[pivots..].iter().zip(upper.chunks_exact(pivots)) {
                    subtract_multiple(&mut part, entries, self.solution[column as usize]);
                }
            }
            for (k, entries) in lower.chunks_exact(rows.len()).enumerate().rev() {
                let value = part[k] / entries[k];
                subtract_multiple(&mut part[..k], &entries[..k], value);
                self.solution[columns[k] as usize] = value;
            }
        }
        x.copy_from_slice(&self.solution);
    }
}

/// A front as one matrix, column by column.
struct Dense {
    rows: Vec<u32>,
    columns: Vec<u32>,
    /// The first rows and columns, which may have pivots.
    own: usize,
    entries: Vec<f64>,
}

impl Dense {
    /// The entries of the matrix and what is left of earlier fronts. `at` is memory for the places of rows and
    /// columns.
    fn gather<const L: usize>(
        matrix: &Matrix<'_, L>,
        front: &Front<'_>,
        children: &[Left],
        at: &mut [Vec<u32>; 2],
    ) -> Result<Self, Error> {
        let of_node = |place: usize| compact(place * L)..compact(place * L + L);
        let mut lists = [Vec::new(), Vec::new()];
        for (which, list) in lists.iter_mut().enumerate() {
            list.extend(of_node(front.own.start).start..of_node(front.own.end).start);
            for child in children {
                let all = [&child.rows, &child.columns][which];
                list.extend_from_slice(&all[..child.delayed]);
            }
            for &place in front.rows {
                list.extend(of_node(place as usize));
            }
            for (place, &unknown) in list.iter().enumerate() {
                at[which][unknown as usize] = compact(place);
            }
        }
        let [rows, columns] = lists;
        let count = rows.len();
        let [row_at, column_at] = at;
        let mut entries = zeros(count * count).ok_or(Error::OutOfMemory)?;
        let mut add = |row: usize, column: usize, entry: f64| {
            entries[column_at[column] as usize * count + row_at[row] as usize] += entry;
        };
        for own in front.own.clone() {
            let node = matrix.fronts.order[own] as usize;
            for (other, block) in matrix.blocks_of(node) {
                let place = matrix.fronts.places[other] as usize;
                if place < front.own.start {
                    continue;
                }
                each(block, |row, column, entry| {
                    add(own * L + row, place * L + column, entry);
                });
                if place >= front.own.end
                    && let Some(mirror) = matrix.pattern.block(other, node)
                {
                    each(matrix.block(mirror), |row, column, entry| {
                        add(place * L + row, own * L + column, entry);
                    });
                }
            }
        }
        for child in children {
            let columns = child.entries.chunks_exact(child.rows.len());
            for (&column, entries) in child.columns.iter().zip(columns) {
                for (&row, &entry) in child.rows.iter().zip(entries) {
                    add(row as usize, column as usize, entry);
                }
            }
        }
        let delayed: usize = children.iter().map(|child| child.delayed).sum();
        Ok(Self {
            rows,
            columns,
            own: front.own.len() * L + delayed,
            entries,
        })
    }

    /// Eliminates as many own unknowns as have a pivot, and returns their number.
    fn eliminate(&mut self) -> usize {
        let own = self.own;
        let (mut pivots, mut end, mut before) = (0, own, 0);
        loop {
            if pivots == end {
                // A column without a pivot may have one after others were eliminated.
                if end == own || pivots == before {
                    break;
                }
                (before, end) = (pivots, own);
            }
            let (first, stop) = (pivots, end.min(pivots + BLOCK));
            let mut last = stop;
            while pivots < last {
                if let Some(row) = self.pivot_of(pivots) {
                    self.swap_rows(pivots, row);
                    self.subtract_pivot(pivots, stop);
                    pivots += 1;
                } else {
                    last -= 1;
                    self.swap_columns(pivots, last);
                }
            }
            self.subtract_pivots(first..pivots, stop..own);
            for column in pivots..stop {
                end -= 1;
                self.swap_columns(column, end);
            }
        }
        self.subtract_pivots(0..pivots, own..self.rows.len());
        pivots
    }

    /// The row of a pivot for a column, if there is one.
    fn pivot_of(&self, k: usize) -> Option<usize> {
        let count = self.rows.len();
        let (own, later) = self.entries[k * count..][..count].split_at(self.own);
        let largest = |rows: &[f64]| {
            rows.iter()
                .fold(0.0_f64, |most, entry| most.max(entry.abs()))
        };
        let most = largest(&own[k..]);
        let is_good = most > 0.0 && most >= SHARE * largest(later);
        is_good.then(|| {
            k + own[k..]
                .iter()
                .take_while(|entry| entry.abs() < most)
                .count()
        })
    }

    fn swap_rows(&mut self, one: usize, other: usize) {
        self.rows.swap(one, other);
        for column in self.entries.chunks_exact_mut(self.rows.len()) {
            column.swap(one, other);
        }
    }

    fn swap_columns(&mut self, one: usize, other: usize) {
        self.columns.swap(one, other);
        let (count, [first, second]) = (self.rows.len(), [one.min(other), one.max(other)]);
        if first < second {
            let (left, right) = self.entries.split_at_mut(second * count);
            left[first * count..][..count].swap_with_slice(&mut right[..count]);
        }
    }

    /// Divides column k by its pivot, and subtracts its multiples from the columns after it.
    fn subtract_pivot(&mut self, k: usize, end: usize) {
        let count = self.rows.len();
        let (pivot, later) = self.entries[k * count..end * count].split_at_mut(count);
        let divisor = pivot[k];
        pivot[k + 1..].iter_mut().for_each(|l| *l /= divisor);
        for column in later.chunks_exact_mut(count) {
            subtract(&mut column[k..], &pivot[k..]);
        }
    }

    /// Subtracts multiples of pivots that have been divided from later columns.
    fn subtract_pivots(&mut self, pivots: Range<usize>, later: Range<usize>) {
        let count = self.rows.len();
        let (left, right) = self.entries.split_at_mut(later.start * count);
        let left = columns(&left[pivots.start * count..pivots.end * count], count);
        let right = columns_mut(&mut right[..later.len() * count], count);
        let (_, left) = left.split_at(Axis(0), pivots.start);
        let (_, right) = right.split_at(Axis(0), pivots.start);
        let (triangle, below) = left.split_at(Axis(0), pivots.len());
        let (mut upper, rest) = right.split_at(Axis(0), pivots.len());
        solve(&triangle, upper.view_mut());
        subtract_product(rest, &below, &upper.view());
    }

    /// The factors, and what is left for the next front.
    fn split(mut self, pivots: usize, front: usize) -> (Factor, Left) {
        let count = self.rows.len();
        let (mut upper, mut entries) = (Vec::new(), Vec::new());
        for column in self.entries[pivots * count..].chunks_exact(count) {
            upper.extend_from_slice(&column[..pivots]);
            entries.extend_from_slice(&column[pivots..]);
        }
        let left = Left {
            front,
            delayed: self.own - pivots,
            rows: self.rows[pivots..].to_vec(),
            columns: self.columns[pivots..].to_vec(),
            entries,
        };
        self.entries.truncate(pivots * count);
        self.entries.shrink_to_fit();
        let factor = Factor {
            rows: mem::take(&mut self.rows),
            columns: mem::take(&mut self.columns),
            lower: self.entries,
            upper,
        };
        (factor, left)
    }
}

/// Calls a function with row, column and value of every entry of a block.
fn each<const L: usize>(block: &[[f64; L]; L], mut call: impl FnMut(usize, usize, f64)) {
    for (row, entries) in block.iter().enumerate() {
        for (column, &entry) in entries.iter().enumerate() {
            call(row, column, entry);
        }
    }
}

/// `x −= factor · column`.
fn subtract_multiple(x: &mut [f64], column: &[f64], factor: f64) {
    for (x, entry) in x.iter_mut().zip(column) {
        *x -= entry * factor;
    }
}
