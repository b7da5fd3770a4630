//! Sparse elimination whose symbolic part is done once; a thin layer over `faer`.
//!
//! The column order that keeps the factors sparse (COLAMD) and the structure that follows from it
//! depend on the pattern alone. What an iteration repeats is the numeric part, with partial
//! pivoting, in memory that is kept. `faer` looks at columns and the entries are stored by rows, so
//! that Aᵀ is what is factored. Factors are in double precision whatever the scene is computed in:
//! they only correct, and the next residual judges the correction.

use core::fmt;

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::lu::partial_pivoting::factor::PartialPivLuParams;
use faer::reborrow::Reborrow;
use faer::sparse::linalg::lu::{
    LuRef, LuSymbolicParams, NumericLu, SymbolicLu, factorize_symbolic_lu,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMat};
use faer::{Conj, MatMut, Par, Spec};

use crate::lu::Singular;
use crate::pattern::Pattern;
use crate::scalar::Real;

/// What solves `A X = B` for matrices with one pattern and `W` columns of B.
pub(crate) struct SparseLu {
    /// The columns of Aᵀ.
    pattern: SymbolicSparseColMat<u32>,
    symbolic: SymbolicLu<u32>,
    numeric: NumericLu<u32, f64>,
    /// The entries in double precision.
    values: Vec<f64>,
    /// B in double precision, column by column.
    right: Vec<f64>,
    factor_memory: MemBuffer,
    solve_memory: MemBuffer,
}

impl fmt::Debug for SparseLu {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("SparseLu")
            .field("unknowns", &self.pattern.ncols())
            .field("entries", &self.values.len())
            .finish_non_exhaustive()
    }
}

impl SparseLu {
    /// Orders and analyses a pattern for this many right-hand sides; `None` if memory is missing, or
    /// if there are more entries than `faer` can count.
    pub(crate) fn new(pattern: &Pattern, columns: usize) -> Option<Self> {
        let unknowns = pattern.unknowns();
        let starts = pattern.starts().iter();
        let starts: Vec<u32> = starts
            .map(|&start| u32::try_from(start).ok())
            .collect::<Option<_>>()?;
        let rows = pattern.columns().to_vec();
        let pattern = SymbolicSparseColMat::new_checked(unknowns, unknowns, starts, None, rows);
        let symbolic = factorize_symbolic_lu(pattern.rb(), LuSymbolicParams::default()).ok()?;
        let factor = symbolic.factorize_numeric_lu_scratch::<f64>(Par::Seq, parameters());
        let solve = symbolic.solve_in_place_scratch::<f64>(columns, Par::Seq);
        Some(Self {
            factor_memory: MemBuffer::try_new(factor).ok()?,
            solve_memory: MemBuffer::try_new(solve).ok()?,
            values: vec![0.0; pattern.row_idx().len()],
            right: vec![0.0; unknowns * columns],
            pattern,
            symbolic,
            numeric: NumericLu::new(),
        })
    }

    /// Number of entries.
    pub(crate) fn entries(&self) -> usize {
        self.values.len()
    }

    /// Where an entry of the pattern is among the entries.
    pub(crate) fn position(&self, row: usize, column: usize) -> Option<usize> {
        let columns = self.pattern.row_idx_of_col_raw(row);
        let column = u32::try_from(column).ok()?;
        let place = columns.binary_search(&column).ok()?;
        Some(self.pattern.col_ptr()[row] as usize + place)
    }

    /// Overwrites the right-hand sides with the solutions for the matrix with these entries.
    pub(crate) fn solve<S: Real, const W: usize>(
        &mut self,
        values: &[S],
        right: &mut [[S; W]],
    ) -> Result<(), Singular> {
        for (own, value) in self.values.iter_mut().zip(values) {
            *own = value.to_f64();
        }
        let unknowns = right.len();
        for (row, b) in right.iter().enumerate() {
            for (column, b) in b.iter().enumerate() {
                self.right[column * unknowns + row] = b.to_f64();
            }
        }
        self.factor_and_solve(W)?;
        for (row, x) in right.iter_mut().enumerate() {
            for (column, x) in x.iter_mut().enumerate() {
                *x = S::from_f64(self.right[column * unknowns + row]);
            }
        }
        Ok(())
    }

    fn factor_and_solve(&mut self, columns: usize) -> Result<(), Singular> {
        let transposed = SparseColMatRef::new(self.pattern.rb(), &self.values);
        let memory = MemStack::new(&mut self.factor_memory);
        let factors = self.symbolic.factorize_numeric_lu(
            &mut self.numeric,
            transposed,
            Par::Seq,
            memory,
            parameters(),
        );
        let factors: LuRef<'_, u32, f64> = factors.map_err(|_| Singular)?;
        let memory = MemStack::new(&mut self.solve_memory);
        let unknowns = self.pattern.ncols();
        let right = MatMut::from_column_major_slice_mut(&mut self.right, unknowns, columns);
        factors.solve_transpose_in_place_with_conj(Conj::No, right, Par::Seq, memory);
        // A pivot that is zero divides by zero.
        if self.right.iter().all(|entry| entry.is_finite()) {
            Ok(())
        } else {
            Err(Singular)
        }
    }
}

fn parameters() -> Spec<PartialPivLuParams, f64> {
    Spec::default()
}
