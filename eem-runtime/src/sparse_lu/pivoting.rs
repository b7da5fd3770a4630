//! Sparse elimination that looks for its pivots in whole columns; a thin layer over `faer`.
//!
//! Slower and larger than fronts, for matrices whose pivots are not where the pattern expects them.
//! `faer` looks at columns and the entries are stored by rows, so that Aᵀ is what is factored.

use core::fmt;

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::linalg::lu::{LuSymbolicParams, NumericLu, SymbolicLu, factorize_symbolic_lu};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Conj, MatMut, Par, Spec};

use super::gathering::Matrix;
use crate::lu::Singular;
use crate::pattern::Pattern;
use crate::scalar::Real;

/// What solves `A x = b` for matrices with one pattern, whatever their values.
pub(super) struct Pivoting {
    /// Unknowns in a run of the matrix.
    pub(super) length: usize,
    /// Of single unknowns.
    pattern: Pattern,
    symbolic: SymbolicLu<u32>,
    numeric: NumericLu<u32, f64>,
    memory: MemBuffer,
}

impl fmt::Debug for Pivoting {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Pivoting").finish_non_exhaustive()
    }
}

/// The columns of Aᵀ.
fn transposed(pattern: &Pattern) -> SymbolicSparseColMatRef<'_, u32> {
    let unknowns = pattern.unknowns();
    let (starts, rows) = (pattern.starts(), pattern.columns());
    SymbolicSparseColMatRef::new_checked(unknowns, unknowns, starts, None, rows)
}

impl Pivoting {
    /// Orders and analyses a pattern, for runs of this length; `None` if memory is missing.
    pub(super) fn new(pattern: &Pattern, length: usize) -> Option<Self> {
        let pattern = pattern.one_by_one(length);
        let symbolic = factorize_symbolic_lu(transposed(&pattern), LuSymbolicParams::default());
        let symbolic = symbolic.ok()?;
        let factor = symbolic.factorize_numeric_lu_scratch::<f64>(Par::Seq, Spec::default());
        let solve = symbolic.solve_transpose_in_place_scratch::<f64>(1, Par::Seq);
        Some(Self {
            length,
            pattern,
            memory: MemBuffer::try_new(factor.or(solve)).ok()?,
            symbolic,
            numeric: NumericLu::new(),
        })
    }

    /// Overwrites a right-hand side with the solution for a matrix with runs of its length.
    pub(super) fn solve<S: Real, const L: usize>(
        &mut self,
        matrix: &Matrix<'_, S, L>,
        x: &mut [f64],
    ) -> Result<(), Singular> {
        let mut values = Vec::with_capacity(self.pattern.entries());
        for run in 0..matrix.pattern.runs() {
            for row in 0..L {
                let entries = matrix.blocks_of(run).flat_map(|(_, block)| &block[row]);
                values.extend(entries.map(|entry| entry.to_f64()));
            }
        }
        let factors = self.symbolic.factorize_numeric_lu(
            &mut self.numeric,
            SparseColMatRef::new(transposed(&self.pattern), &values),
            Par::Seq,
            MemStack::new(&mut self.memory),
            Spec::default(),
        );
        let factors = factors.map_err(|_| Singular)?;
        let memory = MemStack::new(&mut self.memory);
        let unknowns = x.len();
        let right = MatMut::from_column_major_slice_mut(x, unknowns, 1);
        factors.solve_transpose_in_place_with_conj(Conj::No, right, Par::Seq, memory);
        // A pivot that is zero divides by zero.
        if x.iter().all(|x| x.is_finite()) {
            Ok(())
        } else {
            Err(Singular)
        }
    }
}
