//! Sparse elimination with partial pivoting, for matrices with tiny pivots near the diagonal.
//!
//! It is `faer`'s. It takes more time and memory than the elimination by fronts, as any row of a column
//! can become the pivot. `faer` stores columns and this crate stores rows, so Aᵀ is factored. Nothing is
//! checked here: the caller checks.

use core::fmt;

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::linalg::lu::{LuSymbolicParams, NumericLu, SymbolicLu, factorize_symbolic_lu};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Conj, MatMut, Par, Spec};

use crate::error::Error;
use crate::gathering::Matrix;
use crate::pattern::Pattern;
use crate::precision::Precision;

/// The symbolic analysis of a pattern, and memory for the factors.
pub(crate) struct Pivoting {
    /// With blocks of one row.
    pattern: Pattern,
    symbolic: SymbolicLu<u32>,
    numeric: NumericLu<u32, f64>,
    memory: MemBuffer,
    /// A right-hand side in the order of the unknowns.
    natural: Vec<f64>,
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
    /// Orders and analyses a pattern.
    pub(crate) fn new(pattern: &Pattern) -> Result<Self, Error> {
        let pattern = pattern.one_by_one();
        let symbolic = factorize_symbolic_lu(transposed(&pattern), LuSymbolicParams::default());
        let symbolic = symbolic.map_err(|_| Error::OutOfMemory)?;
        let factor = symbolic.factorize_numeric_lu_scratch::<f64>(Par::Seq, Spec::default());
        let solve = symbolic.solve_transpose_in_place_scratch::<f64>(1, Par::Seq);
        Ok(Self {
            natural: vec![0.0; pattern.unknowns()],
            pattern,
            memory: MemBuffer::try_new(factor.or(solve)).map_err(|_| Error::OutOfMemory)?,
            symbolic,
            numeric: NumericLu::new(),
        })
    }

    /// Factors a matrix and calls `with` with a function that overwrites a right-hand side by the
    /// solution, both in the order of `matrix.fronts`. `None` if the matrix cannot be factored.
    pub(crate) fn factor<P: Precision, R, const L: usize>(
        &mut self,
        matrix: &Matrix<'_, P, L>,
        with: impl FnOnce(&mut dyn FnMut(&mut [[f64; L]])) -> R,
    ) -> Option<R> {
        let mut values = Vec::with_capacity(self.pattern.entries());
        for node in 0..matrix.pattern.nodes() {
            for row in 0..L {
                let entries = matrix.blocks_of(node).flat_map(|(_, block)| &block[row]);
                values.extend(entries.map(|&entry| P::widen(entry)));
            }
        }
        let factors = self.symbolic.factorize_numeric_lu(
            &mut self.numeric,
            SparseColMatRef::new(transposed(&self.pattern), &values),
            Par::Seq,
            MemStack::new(&mut self.memory),
            Spec::default(),
        );
        let factors = factors.ok()?;
        let (memory, natural) = (&mut self.memory, &mut self.natural);
        let order = &matrix.fronts.order;
        Some(with(&mut |x| {
            let nodes = natural.as_chunks_mut::<L>().0;
            for (x, &node) in x.iter().zip(order) {
                nodes[node as usize] = *x;
            }
            let unknowns = natural.len();
            let right = MatMut::from_column_major_slice_mut(natural, unknowns, 1);
            let memory = MemStack::new(memory);
            factors.solve_transpose_in_place_with_conj(Conj::No, right, Par::Seq, memory);
            let nodes = natural.as_chunks::<L>().0;
            for (x, &node) in x.iter_mut().zip(order) {
                *x = nodes[node as usize];
            }
        }))
    }
}
