//! A smaller system in the memory of a large one.

use super::{LinearSystem, Parts, Storage};
use crate::lu::Singular;
use crate::scalar::Real;

/// One unknown in the place of each run of `W`, and `W` right-hand sides.
impl<S: Real> LinearSystem<S, 1> {
    /// The number of runs of so many unknowns, if that is how they are stored.
    #[cfg(feature = "sparse")]
    pub(crate) fn runs(&self, length: usize) -> Option<usize> {
        let sparse = self.storage.sparse()?;
        (sparse.length() == length).then_some(self.unknowns / length)
    }

    /// Without sparse elimination nothing is stored by runs.
    #[cfg(not(feature = "sparse"))]
    #[expect(clippy::unused_self, reason = "as with sparse elimination")]
    pub(crate) fn runs(&self, _: usize) -> Option<usize> {
        None
    }

    /// The entries of the smaller A, all zero, whose place is that of their block over `W²`, and the rows
    /// of its B.
    pub(crate) fn renew_by_runs<const W: usize>(&mut self) -> Parts<'_, S, W> {
        let (entries, unknowns) = (self.storage.entries() / (W * W), self.unknowns);
        self.is_clear = false;
        let values = &mut self.values[..entries];
        values.fill(S::zero());
        let right = self.right[..unknowns].as_flattened_mut();
        (values, right.as_chunks_mut().0)
    }

    /// The rows of the smaller X, once [`solve_by_runs`](Self::solve_by_runs) has succeeded.
    pub(crate) fn solution_by_runs<const W: usize>(&self) -> &[[S; W]] {
        self.right[..self.unknowns].as_flattened().as_chunks().0
    }

    /// Finds the smaller X, in the place of its B.
    pub(crate) fn solve_by_runs<const W: usize>(&mut self) -> Result<(), Singular> {
        match &mut self.storage {
            Storage::Fixed { .. } | Storage::Dense { .. } => Err(Singular),
            #[cfg(feature = "sparse")]
            Storage::Sparse(sparse) => {
                let entries = sparse.entries() / (W * W);
                let right = self.right[..self.unknowns].as_flattened_mut();
                sparse.solve(1, &self.values[..entries], right.as_chunks_mut::<W>().0)
            }
        }
    }
}
