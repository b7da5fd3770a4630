//! Eliminating the own unknowns of one front, as dense blocks.
//!
//! ```text
//! ⎡ A₁₁  A₁₂ ⎤   ⎡ Pᵀ L₁₁   0 ⎤ ⎡ U₁₁  U₁₂ ⎤
//! ⎣ A₂₁  A₂₂ ⎦ = ⎣    L₂₁   1 ⎦ ⎣  0    S  ⎦     S = A₂₂ − L₂₁ U₁₂
//! ```
//!
//! Partial pivoting within A₁₁ (matrix P) leaves the structure as it was analysed.

use ndarray::Axis;

use crate::dense::{columns, columns_mut, factor, solve, subtract, subtract_product, swap_rows};

/// Fronts with at most this many unknowns are eliminated by loops: on larger ones products of matrices are
/// faster.
const SMALL: usize = 24;

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
#[derive(Debug)]
pub(crate) struct Scratch {
    /// For each step, the row that is swapped with that of the diagonal.
    swaps: Vec<usize>,
}

impl Scratch {
    /// For fronts with at most this many own unknowns.
    pub(crate) fn new(width: usize) -> Self {
        Self {
            swaps: vec![0; width],
        }
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
        let swaps = &mut scratch.swaps[..width];
        factor(columns_mut(self.lower, tall), width, swaps);
        (0..).zip(&mut *self.pivots).for_each(|(k, row)| *row = k);
        for (k, &row) in swaps.iter().enumerate() {
            self.pivots.swap(k, row);
        }
        if tall == width {
            return;
        }
        let (triangle, below) = columns(self.lower, tall).split_at(Axis(0), width);
        let mut upper = columns_mut(self.upper, width);
        swap_rows(&mut upper, swaps);
        solve(&triangle, upper.view_mut());
        subtract_product(columns_mut(self.schur, tall - width), &below, &upper.view());
    }
}
