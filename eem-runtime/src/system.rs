//! The global linear system of one Newton iteration.

use crate::lu::{self, Singular};
use crate::scalar::Real;

/// `A x = b` over the unknowns of a [`Layout`](crate::layout::Layout), in memory that is reused.
#[derive(Clone, Debug)]
pub(crate) struct LinearSystem<S> {
    unknowns: usize,
    matrix: Vec<S>,
    right: Vec<S>,
    pivots: Vec<usize>,
}

impl<S: Real> LinearSystem<S> {
    /// A system with this many unknowns.
    pub(crate) fn new(unknowns: usize) -> Self {
        Self {
            unknowns,
            matrix: vec![S::zero(); unknowns * unknowns],
            right: vec![S::zero(); unknowns],
            pivots: vec![0; unknowns],
        }
    }

    /// Makes everything zero.
    pub(crate) fn clear(&mut self) {
        self.matrix.fill(S::zero());
        self.right.fill(S::zero());
    }

    /// Adds to an entry of A.
    pub(crate) fn add(&mut self, row: usize, column: usize, value: S) {
        self.matrix[row * self.unknowns + column] += value;
    }

    /// Adds to an entry of b.
    pub(crate) fn add_right(&mut self, row: usize, value: S) {
        self.right[row] += value;
    }

    /// The right-hand side, or the solution once [`solve`](Self::solve) has succeeded.
    pub(crate) fn right(&self) -> &[S] {
        &self.right
    }

    /// The same, to be written.
    pub(crate) fn right_mut(&mut self) -> &mut [S] {
        &mut self.right
    }

    /// A, row-major.
    pub(crate) fn matrix(&self) -> &[S] {
        &self.matrix
    }

    /// Replaces A by its factors and b by the solution.
    pub(crate) fn solve(&mut self) -> Result<(), Singular> {
        lu::factor(&mut self.matrix, &mut self.pivots)?;
        lu::solve(&self.matrix, &self.pivots, &mut self.right);
        Ok(())
    }
}
