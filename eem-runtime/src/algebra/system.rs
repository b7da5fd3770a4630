//! A linear system whose matrix keeps its pattern.
//!
//! ```text
//! A X = B     A: unknowns × unknowns, entries only where the Pattern has them;  B: W columns
//! ```
//!
//! The entries of A are one array, [`values`](LinearSystem::values). Their indices are found once, when the scene is built
//! ([`place`](LinearSystem::place)). The entries of a row that belong to the unknowns of one node are consecutive, as are the
//! rows of B. Anchors write to a scratch entry behind all others, which no elimination reads.
//!
//! The [`Storage`] decides how entries are laid out and solved with. A new solver is a new variant there, with its `new`
//! (from the pattern), `entries`, `position` and `solve_each`. Systems of one and two unknowns are solved without it.

use core::{iter, mem};

#[cfg(feature = "sparse")]
use eem_sparse::{Analysis, Solver};

pub(crate) use crate::algebra::lu::MOST_FIXED;
use crate::algebra::lu::{self, Singular};
use crate::algebra::memory::{MemoryLimit, TooLarge, bytes};
use crate::algebra::pattern::Pattern;

/// The most unknowns whose elimination is dense whatever the pattern.
#[cfg(feature = "sparse")]
const MOST_DENSE: usize = 24;

/// A pattern is sparse if at most one in this many entries can differ from zero.
#[cfg(feature = "sparse")]
const SPARSITY: usize = 4;

/// Factors are kept if they have at least this many times the entries of the matrix; a chain has 1, a square lattice of
/// 10 by 10 nodes 3.
#[cfg(feature = "sparse")]
const WORTHWHILE_FILL: usize = 3;

/// `A X = B` with `W` right-hand sides, in memory that is reused.
#[derive(Debug)]
pub(crate) struct LinearSystem<const W: usize> {
    unknowns: usize,
    storage: Storage,
    is_clear: bool,
    /// The entries of A, then a scratch entry for anchors, written but never read.
    values: Vec<f64>,
    /// The rows of B, then a scratch row for anchors, written but never read.
    right: Vec<[f64; W]>,
    /// Rows of X, then a scratch row for anchors.
    solution: Vec<[f64; W]>,
}

/// The entries of A and the rows of B.
pub(crate) type Parts<'a, const W: usize> = (&'a mut [f64], &'a mut [[f64; W]]);

/// How the entries of A are stored and the system is solved.
#[derive(Debug)]
enum Storage {
    /// All entries, row by row; at most [`MOST_FIXED`] unknowns.
    Fixed { unknowns: usize },
    /// All entries, row by row.
    Dense { pivots: Vec<usize> },
    /// The entries of the pattern.
    #[cfg(feature = "sparse")]
    Sparse(Box<Solver>),
}

impl Storage {
    /// The storage for a pattern, unless it is too large.
    fn new(pattern: &Pattern, limit: MemoryLimit) -> Result<Self, TooLarge> {
        let unknowns = pattern.unknowns();
        if unknowns <= MOST_FIXED {
            return Ok(Self::Fixed { unknowns });
        }
        #[cfg(feature = "sparse")]
        if unknowns > MOST_DENSE
            && pattern.entries() < unknowns * unknowns / SPARSITY
            && let Ok(analysis) = Analysis::new(pattern)
        {
            let entries = bytes([pattern.entries(), 1]);
            let needed = analysis.bytes().saturating_add(entries);
            limit.check(unknowns, needed)?;
            let sparse = Solver::reserve(analysis);
            return match sparse {
                Ok(sparse) => Ok(Self::Sparse(Box::new(sparse))),
                Err(_) => Err(TooLarge {
                    unknowns,
                    needed,
                    available: None,
                }),
            };
        }
        limit.check(unknowns, bytes([unknowns, unknowns]))?;
        let pivots = vec![0; unknowns];
        Ok(Self::Dense { pivots })
    }

    /// Number of stored values.
    fn entries(&self) -> usize {
        match self {
            Self::Fixed { unknowns } => unknowns * unknowns,
            Self::Dense { pivots } => pivots.len() * pivots.len(),
            #[cfg(feature = "sparse")]
            Self::Sparse(sparse) => sparse.pattern().entries(),
        }
    }

    /// The index of an entry among the values, if the pattern has it.
    #[cfg_attr(
        not(feature = "sparse"),
        expect(
            clippy::unnecessary_wraps,
            reason = "all that is dense has every entry"
        )
    )]
    fn position(&self, row: usize, column: usize) -> Option<usize> {
        match self {
            Self::Fixed { unknowns } => Some(row * unknowns + column),
            Self::Dense { pivots } => Some(row * pivots.len() + column),
            #[cfg(feature = "sparse")]
            Self::Sparse(sparse) => sparse.pattern().position(row, column),
        }
    }

    /// Overwrites the right-hand sides with the solutions, and the values with zeros; the scratch entry behind them is not
    /// read.
    #[inline(never)]
    fn solve<const W: usize>(
        &mut self,
        values: &mut [f64],
        right: &mut [[f64; W]],
    ) -> Result<(), Singular> {
        match self {
            Self::Fixed { unknowns } => lu::solve_fixed(*unknowns, values, right),
            _ => self.solve_each(values, &mut iter::once(right)),
        }
    }

    /// The same for several sets of right-hand sides. A is eliminated once, or, with at most [`MOST_FIXED`] unknowns, for each.
    #[inline(never)]
    fn solve_each<const W: usize>(
        &mut self,
        values: &mut [f64],
        all: &mut dyn Iterator<Item = &mut [[f64; W]]>,
    ) -> Result<(), Singular> {
        let values = &mut values[..self.entries()];
        match self {
            Self::Fixed { unknowns } => {
                let given = lu::copied(values);
                for right in all {
                    values.copy_from_slice(&given[..values.len()]);
                    solve_small(*unknowns, values, right)?;
                }
            }
            Self::Dense { pivots } => {
                lu::factor(values, pivots)?;
                all.for_each(|right| lu::solve(values, pivots, right));
            }
            #[cfg(feature = "sparse")]
            Self::Sparse(sparse) => {
                let mut factored = sparse.factor(values).map_err(|_| Singular)?;
                for right in all {
                    factored.solve(right).map_err(|_| Singular)?;
                }
            }
        }
        values.fill(0.0);
        Ok(())
    }
}

/// The same for few unknowns; one and two of them are solved with the bits of [`LinearSystem::solve`].
fn solve_small<const W: usize>(
    unknowns: usize,
    values: &mut [f64],
    right: &mut [[f64; W]],
) -> Result<(), Singular> {
    match *right {
        [given] => lu::solve_one(values, &[given], right),
        [one, other] => lu::solve_two(values, &[one, other], right),
        _ => lu::solve_fixed(unknowns, values, right),
    }
}

impl<const W: usize> LinearSystem<W> {
    /// A system with `run` scratch rows for anchors, unless it exceeds the memory limit.
    pub(crate) fn new(pattern: &Pattern, run: usize, limit: MemoryLimit) -> Result<Self, TooLarge> {
        let storage = Storage::new(pattern, limit)?;
        Ok(Self {
            unknowns: pattern.unknowns(),
            is_clear: true,
            values: vec![0.0; storage.entries() + run],
            right: vec![[0.0; W]; pattern.unknowns() + run],
            solution: vec![[0.0; W]; pattern.unknowns() + run],
            storage,
        })
    }

    /// Whether its elimination keeps nothing between solutions, as that of few unknowns does.
    pub(crate) fn is_fixed(&self) -> bool {
        matches!(self.storage, Storage::Fixed { .. })
    }

    /// The index of a row of B; the scratch row without an unknown.
    pub(crate) fn row(&self, unknown: Option<usize>) -> usize {
        unknown.unwrap_or(self.unknowns)
    }

    /// The index of an entry of A, which the pattern must have; the scratch entry if an unknown is missing.
    pub(crate) fn place(&self, row: Option<usize>, column: Option<usize>) -> usize {
        let position = row.zip(column).map(|(row, column)| {
            let position = self.storage.position(row, column);
            debug_assert!(position.is_some(), "the pattern has no {row}, {column}");
            position
        });
        position.flatten().unwrap_or(self.storage.entries())
    }

    /// Sets A and B to zero.
    pub(crate) fn clear(&mut self) {
        self.clear_matrix();
        self.right.fill([0.0; W]);
    }

    /// Sets A to zero.
    #[inline]
    pub(crate) fn clear_matrix(&mut self) {
        if !self.is_clear {
            self.values.fill(0.0);
            self.is_clear = true;
        }
    }

    /// The entries of A and the rows of B.
    #[inline]
    pub(crate) fn parts(&mut self) -> Parts<'_, W> {
        self.is_clear = false;
        (&mut self.values, &mut self.right)
    }

    /// The entries of A, set to zero, the rows of B and those of X.
    #[inline]
    pub(crate) fn renew(&mut self) -> (&mut [f64], &mut [[f64; W]], &mut [[f64; W]]) {
        self.clear_matrix();
        self.is_clear = false;
        (&mut self.values, &mut self.right, &mut self.solution)
    }

    /// The rows of B.
    pub(crate) fn right(&self) -> &[[f64; W]] {
        &self.right
    }

    /// The rows of X, once [`solve`](Self::solve) has succeeded.
    pub(crate) fn solution(&self) -> &[[f64; W]] {
        &self.solution
    }

    /// The rows of X, mutable.
    pub(crate) fn solution_mut(&mut self) -> &mut [[f64; W]] {
        &mut self.solution
    }

    /// All entries of A, row-major.
    pub(crate) fn dense(&self) -> Vec<f64> {
        let rows = 0..self.unknowns;
        rows.flat_map(|row| {
            (0..self.unknowns).map(move |column| {
                let position = self.storage.position(row, column);
                position.map_or(0.0, |position| self.values[position])
            })
        })
        .collect()
    }

    /// Whether factors are worth keeping: finding them takes much longer than solving with them.
    pub(crate) fn keeps_factors(&self) -> bool {
        match &self.storage {
            #[cfg(feature = "sparse")]
            Storage::Sparse(sparse) => {
                sparse.factor_entries() >= WORTHWHILE_FILL * sparse.pattern().entries()
            }
            _ => false,
        }
    }

    /// Like [`solve`](Self::solve), but with the factors of the last matrix instead of those of A. Returns false, and changes
    /// nothing, without usable factors.
    pub(crate) fn solve_with_last_factors(&mut self) -> bool {
        match &mut self.storage {
            #[cfg(feature = "sparse")]
            Storage::Sparse(sparse) => {
                let right = &mut self.right[..self.unknowns];
                if sparse.solve_again(right).is_err() {
                    return false;
                }
                mem::swap(&mut self.right, &mut self.solution);
                self.clear_matrix();
                true
            }
            _ => false,
        }
    }

    /// Replaces A by `½(A + Aᵀ)`.
    pub(crate) fn symmetrize(&mut self) {
        for row in 0..self.unknowns {
            for column in 0..row {
                let one = self.storage.position(row, column);
                let other = self.storage.position(column, row);
                if let (Some(one), Some(other)) = (one, other) {
                    let mean = 0.5 * (self.values[one] + self.values[other]);
                    (self.values[one], self.values[other]) = (mean, mean);
                }
            }
        }
    }

    /// Like [`solve`](Self::solve); returns whether A, if symmetric, is positive definite.
    pub(crate) fn solve_and_judge(&mut self) -> Result<bool, Singular> {
        #[cfg(feature = "sparse")]
        if let Storage::Sparse(_) = self.storage {
            self.solve()?;
            let Storage::Sparse(sparse) = &self.storage else {
                return Err(Singular);
            };
            return Ok(sparse.is_positive_definite());
        }
        let n = self.unknowns;
        let is_definite = lu::is_positive_definite(&mut self.values[..n * n].to_vec(), n);
        self.solve()?;
        Ok(is_definite)
    }

    /// Finds X, except the scratch row of anchors; A is then zero, and B is lost.
    #[inline]
    pub(crate) fn solve(&mut self) -> Result<(), Singular> {
        match self.unknowns {
            // Inline: hardly longer than a call.
            1 => lu::solve_one(&mut self.values, &self.right, &mut self.solution)?,
            2 => lu::solve_two(&mut self.values, &self.right, &mut self.solution)?,
            unknowns => {
                self.storage
                    .solve(&mut self.values, &mut self.right[..unknowns])?;
                mem::swap(&mut self.right, &mut self.solution);
            }
        }
        self.is_clear = true;
        Ok(())
    }
}

#[cfg(feature = "gradients")]
impl LinearSystem<1> {
    /// Replaces B by `B − A x`.
    pub(crate) fn subtract_product(&mut self, x: &[[f64; 1]]) {
        let n = self.unknowns;
        let rows = self.right[..n].iter_mut().enumerate();
        #[cfg(feature = "sparse")]
        if let Storage::Sparse(sparse) = &self.storage {
            for (row, [right]) in rows {
                for (place, column) in sparse.pattern().entries_of(row) {
                    *right -= self.values[place] * x[column][0];
                }
            }
            return;
        }
        for (row, [right]) in rows {
            for (&value, [x]) in self.values[row * n..].iter().zip(&x[..n]) {
                *right -= value * *x;
            }
        }
    }

    /// Overwrites right-hand sides with their solutions, except the scratch rows of anchors, and A with zeros.
    pub(crate) fn solve_each<'a>(
        &mut self,
        columns: impl Iterator<Item = &'a mut Vec<[f64; 1]>>,
    ) -> Result<(), Singular> {
        let n = self.unknowns;
        let mut columns = columns.map(|column| &mut column[..n]);
        self.storage.solve_each(&mut self.values, &mut columns)?;
        self.is_clear = true;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Diagonally dominant, not symmetric, of any size and width of its band.
    fn solves(unknowns: usize, band: usize) {
        let pattern = Pattern::new(unknowns, |pair| {
            for row in 0..unknowns {
                (0..row)
                    .filter(|column| row - column <= band)
                    .for_each(|column| pair(row, column));
            }
        });
        let mut system = LinearSystem::<2>::new(&pattern, 1, MemoryLimit::NONE).unwrap();
        let entry = |row: usize, column: usize| {
            let off = f64::from(u8::try_from((3 * row + 5 * column) % 7).unwrap()) - 3.0;
            if row == column { 50.0 } else { off }
        };
        let exact = |row: usize| {
            let x = f64::from(u8::try_from(row).unwrap());
            [1.0 + x, 2.0 - x]
        };
        for row in 0..unknowns {
            for column in (0..unknowns).filter(|&column| row.abs_diff(column) <= band) {
                let place = system.place(Some(row), Some(column));
                let x = exact(column);
                let (values, right) = system.parts();
                values[place] = entry(row, column);
                for (b, x) in right[row].iter_mut().zip(x) {
                    *b += entry(row, column) * x;
                }
            }
        }
        system.solve().unwrap();
        for (row, found) in system.solution()[..unknowns].iter().enumerate() {
            for (found, exact) in found.iter().zip(exact(row)) {
                // Condition number at most 4, numbers up to 61, and a rounding per entry of a row.
                assert!(
                    (found - exact).abs() <= 1e3 * f64::EPSILON,
                    "{unknowns} unknowns"
                );
            }
        }
    }

    #[test]
    fn systems_of_every_size_are_solved() {
        (0..=MOST_FIXED + 2).for_each(|unknowns| solves(unknowns, unknowns));
        solves(60, 2);
    }

    #[test]
    fn entries_of_anchors_are_not_read() {
        let mut system =
            LinearSystem::<1>::new(&Pattern::new(1, |_| {}), 1, MemoryLimit::NONE).unwrap();
        let (own, scratch) = (system.place(Some(0), Some(0)), system.place(Some(0), None));
        let (values, right) = system.parts();
        (values[own], values[scratch]) = (2.0, 9.0);
        (right[0], right[1]) = ([6.0], [9.0]);
        system.solve().unwrap();
        assert_eq!(system.solution()[0].map(f64::to_bits), [3.0_f64.to_bits()]);
    }
}
