//! Eliminating the own unknowns of one front, as dense blocks.
//!
//! ```text
//! ⎡ A₁₁  A₁₂ ⎤   ⎡ Pᵀ L₁₁   0 ⎤ ⎡ U₁₁  U₁₂ ⎤
//! ⎣ A₂₁  A₂₂ ⎦ = ⎣    L₂₁   1 ⎦ ⎣  0    S  ⎦     S = A₂₂ − L₂₁ U₁₂
//! ```
//!
//! Partial pivoting within A₁₁ (matrix P) leaves the structure as it was analysed.

use core::fmt;

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::lu::partial_pivoting::factor::{lu_in_place, lu_in_place_scratch};
use faer::linalg::matmul::matmul;
use faer::linalg::triangular_solve::{
    solve_lower_triangular_in_place, solve_unit_lower_triangular_in_place,
};
use faer::reborrow::{Reborrow, ReborrowMut};
use faer::{Accum, MatMut, MatRef, Par, Spec};

use crate::threads;

/// Fronts with at most this many unknowns are eliminated by loops: on larger ones the dense kernels of
/// `faer` are faster.
const SMALL: usize = 24;

/// Work is split in two tasks if each has more multiplications than this, about a millisecond.
const PIECE: usize = 1 << 22;

/// Products are split at multiples of this many columns, a multiple of the block size of the kernels of
/// `faer`: so the bits are those of the whole product.
const ALIGNED: usize = 64;

/// The blocks of a front, column by column.
pub(crate) struct Blocks<'a> {
    /// A₁₁ above A₂₁; then L₁₁ below the diagonal of U₁₁, and L₂₁.
    pub(crate) lower: &'a mut [f64],
    /// A₁₂, then U₁₂.
    pub(crate) upper: &'a mut [f64],
    /// A₂₂, then S.
    pub(crate) schur: &'a mut [f64],
    /// The row of A₁₁ that becomes each row of L₁₁.
    pub(crate) pivots: &'a mut [u32],
}

/// Working memory of the elimination.
pub(crate) struct Scratch {
    inverse: Vec<u32>,
    column: Vec<f64>,
    memory: MemBuffer,
}

impl fmt::Debug for Scratch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Scratch").finish_non_exhaustive()
    }
}

impl Scratch {
    /// For fronts with at most this many own unknowns; `None` if memory is missing.
    pub(crate) fn new(width: usize) -> Option<Self> {
        let factor = lu_in_place_scratch::<u32, f64>(width, width, Par::Seq, Spec::default());
        Some(Self {
            inverse: vec![0; width],
            column: vec![0.0; width],
            memory: MemBuffer::try_new(factor).ok()?,
        })
    }
}

impl Blocks<'_> {
    /// Sets A to zero.
    pub(crate) fn clear(&mut self) {
        self.lower.fill(0.0);
        self.upper.fill(0.0);
        self.schur.fill(0.0);
    }

    /// Replaces A by L, U and S. A zero pivot makes numbers infinite or NaN, which the check of the solution
    /// finds.
    pub(crate) fn eliminate(&mut self, scratch: &mut Scratch) {
        let width = self.pivots.len();
        if self.lower.len() <= SMALL * width {
            self.eliminate_by_loops();
        } else {
            self.eliminate_by_blocks(scratch);
        }
    }

    fn eliminate_by_loops(&mut self) {
        let width = self.pivots.len();
        let tall = self.lower.len() / width;
        (0..).zip(&mut *self.pivots).for_each(|(k, row)| *row = k);
        for k in 0..width {
            self.bring_up_the_largest(k);
            let (pivot, later) = self.lower[k * tall..].split_at_mut(tall);
            let reciprocal = pivot[k].recip();
            pivot[k + 1..].iter_mut().for_each(|l| *l *= reciprocal);
            for column in later.chunks_exact_mut(tall) {
                subtract(&mut column[k..], &pivot[k..]);
            }
            for column in self.upper.chunks_exact_mut(width) {
                subtract(&mut column[k..], &pivot[k..width]);
            }
        }
        let height = tall - width;
        if height == 0 {
            return;
        }
        let columns = self.schur.chunks_exact_mut(height);
        for (column, upper) in columns.zip(self.upper.chunks_exact(width)) {
            for (&u, lower) in upper.iter().zip(self.lower.chunks_exact(tall)) {
                for (s, &l) in column.iter_mut().zip(&lower[width..]) {
                    *s -= l * u;
                }
            }
        }
    }

    /// Swaps row k of the diagonal block with the row below that has the largest entry in column k.
    fn bring_up_the_largest(&mut self, k: usize) {
        let width = self.pivots.len();
        let tall = self.lower.len() / width;
        let column = &self.lower[k * tall..][..width];
        let mut largest = k;
        for row in k + 1..width {
            if column[row].abs() > column[largest].abs() {
                largest = row;
            }
        }
        if largest != k {
            self.pivots.swap(k, largest);
            let columns = self.lower.chunks_exact_mut(tall);
            for column in columns.chain(self.upper.chunks_exact_mut(width)) {
                column.swap(k, largest);
            }
        }
    }

    fn eliminate_by_blocks(&mut self, scratch: &mut Scratch) {
        let width = self.pivots.len();
        let tall = self.lower.len() / width;
        let lower = MatMut::from_column_major_slice_mut(self.lower, tall, width);
        let (mut diagonal, mut below) = lower.split_at_row_mut(width);
        lu_in_place(
            diagonal.rb_mut(),
            self.pivots,
            &mut scratch.inverse[..width],
            Par::Seq,
            MemStack::new(&mut scratch.memory),
            Spec::default(),
        );
        let height = tall - width;
        if height == 0 {
            return;
        }
        let copy = &mut scratch.column[..width];
        for column in self.upper.chunks_exact_mut(width) {
            copy.copy_from_slice(column);
            for (entry, &row) in column.iter_mut().zip(&*self.pivots) {
                *entry = copy[row as usize];
            }
        }
        let mut upper = MatMut::from_column_major_slice_mut(self.upper, width, height);
        let (transposed, right) = (diagonal.rb().transpose(), below.rb_mut().transpose_mut());
        let mut solve_above = || {
            solve_columns(
                solve_unit_lower_triangular_in_place,
                diagonal.rb(),
                upper.rb_mut(),
            );
        };
        let solve_below = || solve_columns(solve_lower_triangular_in_place, transposed, right);
        if width * width * height > PIECE {
            threads::join(solve_above, solve_below);
        } else {
            solve_above();
            solve_below();
        }
        let schur = MatMut::from_column_major_slice_mut(self.schur, height, height);
        subtract_product(schur, below.rb(), upper.rb());
    }
}

/// Overwrites columns with their solutions for a triangular matrix.
fn solve_columns(
    solve: fn(MatRef<'_, f64>, MatMut<'_, f64>, Par),
    triangle: MatRef<'_, f64>,
    columns: MatMut<'_, f64>,
) {
    let Some(half) = half(columns.ncols(), columns.nrows() * columns.nrows()) else {
        return solve(triangle, columns, Par::Seq);
    };
    let (left, right) = columns.split_at_col_mut(half);
    threads::join(
        || solve_columns(solve, triangle, left),
        || solve_columns(solve, triangle, right),
    );
}

/// `S −= L U`.
fn subtract_product(schur: MatMut<'_, f64>, lower: MatRef<'_, f64>, upper: MatRef<'_, f64>) {
    let Some(half) = half(schur.ncols(), lower.nrows() * lower.ncols()) else {
        return matmul(schur, Accum::Add, lower, upper, -1.0, Par::Seq);
    };
    let (left, right) = schur.split_at_col_mut(half);
    let (first, second) = upper.split_at_col(half);
    threads::join(
        || subtract_product(left, lower, first),
        || subtract_product(right, lower, second),
    );
}

/// Where to split so many columns with so many multiplications each; `None` if that does not pay.
fn half(columns: usize, each: usize) -> Option<usize> {
    let half = (columns / 2).next_multiple_of(ALIGNED);
    (threads::DIVIDE && half < columns && half * each > PIECE).then_some(half)
}

/// `column[i] −= lower[i] · column[0]` for all i > 0.
fn subtract(column: &mut [f64], lower: &[f64]) {
    let Some((&mut first, rest)) = column.split_first_mut() else {
        return;
    };
    for (entry, &l) in rest.iter_mut().zip(&lower[1..]) {
        *entry -= l * first;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    type Solve = fn(MatRef<'_, f64>, MatMut<'_, f64>, Par);

    /// Columns of numbers of different size and sign, and those below the diagonal small.
    fn columns(rows: usize, columns: usize) -> Vec<f64> {
        let entry = |at: usize| {
            let (row, column) = (at % rows, at / rows);
            let digit = u8::try_from((7 * row + 13 * column + row * column) % 23).unwrap();
            let size = if row < column { 0.1 } else { 1e-3 };
            size * (f64::from(digit) - 10.9)
        };
        (0..rows * columns).map(entry).collect()
    }

    fn bits(entries: &[f64]) -> Vec<u64> {
        entries.iter().map(|entry| entry.to_bits()).collect()
    }

    // With the feature `parallel` each task has 64 or 128 columns, the last one less.
    #[test]
    fn divided_work_has_the_bits_of_the_whole() {
        let (tall, width, right) = (310, 250, 300);
        assert_eq!(half(right, tall * width), threads::DIVIDE.then_some(192));
        let (lower, upper) = (columns(tall, width), columns(width, right));
        let lower = MatRef::from_column_major_slice(&lower, tall, width);
        let factor = MatRef::from_column_major_slice(&upper, width, right);
        let [mut whole, mut divided] = [(); 2].map(|()| columns(tall, right));
        let schur = MatMut::from_column_major_slice_mut(&mut whole, tall, right);
        matmul(schur, Accum::Add, lower, factor, -1.0, Par::Seq);
        let schur = MatMut::from_column_major_slice_mut(&mut divided, tall, right);
        subtract_product(schur, lower, factor);
        assert!(bits(&whole) == bits(&divided));

        let triangle = lower.split_at_row(width).0;
        let solves: [Solve; 2] = [
            solve_unit_lower_triangular_in_place,
            solve_lower_triangular_in_place,
        ];
        for solve in solves {
            let [mut whole, mut divided] = [(); 2].map(|()| upper.clone());
            let all = MatMut::from_column_major_slice_mut(&mut whole, width, right);
            solve(triangle, all, Par::Seq);
            let all = MatMut::from_column_major_slice_mut(&mut divided, width, right);
            solve_columns(solve, triangle, all);
            assert!(whole.iter().all(|entry| entry.is_finite()));
            assert!(bits(&whole) == bits(&divided));
        }
    }
}
