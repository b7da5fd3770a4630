//! Factors a matrix and solves with it; every solution that is returned has passed the check.

use crate::analysis::Analysis;
use crate::columns::{Column, store};
use crate::error::Error;
use crate::factors::Factors;
use crate::fallback::solve_by_pivoting;
use crate::fronts::Fronts;
use crate::gathering::Matrix;
use crate::pattern::Pattern;
use crate::refinement::Equations;

/// The analysis of a pattern, and the memory for factors of matrices with this pattern.
///
/// ```
/// use eem_sparse::{Pattern, Solver};
///
/// let pattern = Pattern::new(2, |pair| pair(0, 1));
/// let mut solver = Solver::new(&pattern)?;
/// // ⎡ 4 1 ⎤ x = ⎡ 6 ⎤
/// // ⎣ 2 3 ⎦     ⎣ 8 ⎦
/// let mut x = [[6.0], [8.0]];
/// solver.factor(&[4.0, 1.0, 2.0, 3.0])?.solve(&mut x)?;
/// assert_eq!(x, [[1.0], [2.0]]);
/// # Ok::<(), eem_sparse::Error>(())
/// ```
#[derive(Debug)]
pub struct Solver {
    pattern: Pattern,
    fronts: Fronts,
    factors: Factors,
    /// A column of X in the order of elimination.
    solution: Vec<f64>,
    /// Its residual, or the largest entries of the columns of A; empty until a solution fails the check.
    residual: Vec<f64>,
}

/// The work for solutions in addition to the elimination.
///
/// Both counts are zero if the elimination by fronts was accurate enough. See [`Factored::solve`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Report {
    /// Steps of iterative refinement that led to a solution, of all columns together.
    pub refinements: usize,
    /// Columns that were solved by elimination with delayed pivots.
    pub fallbacks: usize,
}

impl Solver {
    /// Orders and analyses a pattern, and reserves the memory for the factors.
    ///
    /// ```
    /// use eem_sparse::{Pattern, Solver};
    ///
    /// let solver = Solver::new(&Pattern::new(3, |_| {}))?;
    /// assert_eq!(solver.pattern().entries(), 3);
    /// # Ok::<(), eem_sparse::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`Error::OutOfMemory`].
    pub fn new(pattern: &Pattern) -> Result<Self, Error> {
        Self::reserve(Analysis::new(pattern)?)
    }

    /// Reserves the memory for the factors of a pattern that has been analysed.
    ///
    /// # Errors
    ///
    /// [`Error::OutOfMemory`]. An operating system that promises more memory than it has, as Linux does, may end the
    /// program later instead: compare [`Analysis::bytes`] with the free memory first.
    pub fn reserve(analysis: Analysis) -> Result<Self, Error> {
        let Analysis { pattern, fronts } = analysis;
        let factors = Factors::new(&fronts, pattern.block_length());
        Ok(Self {
            factors: factors.ok_or(Error::OutOfMemory)?,
            solution: vec![0.0; pattern.unknowns()],
            pattern,
            fronts,
            residual: Vec::new(),
        })
    }

    /// The pattern that was analysed.
    ///
    /// ```
    /// use eem_sparse::{Pattern, Solver};
    ///
    /// let solver = Solver::new(&Pattern::new(3, |pair| pair(0, 2)))?;
    /// assert_eq!(solver.pattern().position(2, 0), Some(3));
    /// # Ok::<(), eem_sparse::Error>(())
    /// ```
    #[must_use]
    pub fn pattern(&self) -> &Pattern {
        &self.pattern
    }

    /// The block rows in the order of their elimination, for comparison with other solvers.
    ///
    /// ```
    /// use eem_sparse::{Pattern, Solver};
    ///
    /// // The middle of a star comes last but one, when it has a single neighbour left.
    /// let star = Pattern::new(5, |pair| (1..5).for_each(|leaf| pair(0, leaf)));
    /// assert!(Solver::new(&star)?.order()[3..].contains(&0));
    /// # Ok::<(), eem_sparse::Error>(())
    /// ```
    #[must_use]
    pub fn order(&self) -> &[u32] {
        &self.fronts.order
    }

    /// The number of entries of the factors L and U, those of the matrix included.
    ///
    /// ```
    /// use eem_sparse::{Pattern, Solver};
    ///
    /// let chain = Pattern::new(40, |pair| (1..40).for_each(|at| pair(at - 1, at)));
    /// assert_eq!(Solver::new(&chain)?.factor_entries(), 118);
    /// # Ok::<(), eem_sparse::Error>(())
    /// ```
    #[must_use]
    pub fn factor_entries(&self) -> usize {
        self.factors.entries()
    }

    /// Factors the matrix whose entries are at their [positions](Pattern::position).
    ///
    /// ```
    /// use eem_sparse::{Pattern, Solver};
    ///
    /// let mut solver = Solver::new(&Pattern::new(1, |_| {}))?;
    /// let mut factored = solver.factor(&[4.0])?;
    /// let mut x = [[1.0, 2.0]];
    /// factored.solve(&mut x)?;
    /// assert_eq!(x, [[0.25, 0.5]]);
    /// # Ok::<(), eem_sparse::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`Error::Count`] unless there are as many values as the pattern has entries. A singular matrix is
    /// found when a right-hand side is solved.
    pub fn factor<'a>(&'a mut self, values: &'a [f64]) -> Result<Factored<'a>, Error> {
        let (expected, found) = (self.pattern.entries(), values.len());
        if found != expected {
            return Err(Error::Count { expected, found });
        }
        match self.pattern.block_length() {
            1 => self.factor_blocks::<1>(values),
            2 => self.factor_blocks::<2>(values),
            _ => self.factor_blocks::<3>(values),
        }
        Ok(Factored {
            solver: self,
            values,
        })
    }

    /// Whether the matrix that was factored last, which must be symmetric, is positive definite to rounding: with n
    /// unknowns, the smallest eigenvalue is known to some n ε times the largest. False for infinite entries or NaN.
    ///
    /// ```
    /// use eem_sparse::{Pattern, Solver};
    ///
    /// let mut solver = Solver::new(&Pattern::new(2, |pair| pair(0, 1)))?;
    /// solver.factor(&[2.0, 1.0, 1.0, 2.0])?;
    /// assert!(solver.is_positive_definite());
    /// solver.factor(&[1.0, 2.0, 2.0, 1.0])?;
    /// assert!(!solver.is_positive_definite());
    /// # Ok::<(), eem_sparse::Error>(())
    /// ```
    #[must_use]
    pub fn is_positive_definite(&self) -> bool {
        let length = self.pattern.block_length();
        self.factors.are_of_positive_definite(&self.fronts, length)
    }

    /// Overwrites `W` right-hand sides with their solutions by the last factors, without the check.
    ///
    /// ```
    /// use eem_sparse::{Pattern, Solver};
    ///
    /// // A step of an iteration for another matrix near the last one.
    /// let mut solver = Solver::new(&Pattern::new(1, |_| {}))?;
    /// solver.factor(&[4.0])?;
    /// let mut x = [[2.0]];
    /// solver.solve_again(&mut x)?;
    /// assert_eq!(x, [[0.5]]);
    /// # Ok::<(), eem_sparse::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`Error::Count`] unless `right` has a row for each unknown; [`Error::NotFinite`] if a solution is infinite or NaN.
    pub fn solve_again<const W: usize>(&mut self, right: &mut [[f64; W]]) -> Result<(), Error> {
        self.expect_rows(right.len())?;
        self.solve_columns_again(right.as_flattened_mut(), W)
    }

    fn solve_columns_again(&mut self, right: &mut [f64], width: usize) -> Result<(), Error> {
        match self.pattern.block_length() {
            1 => self.solve_blocks_again::<1>(right, width),
            2 => self.solve_blocks_again::<2>(right, width),
            _ => self.solve_blocks_again::<3>(right, width),
        }
    }

    /// An error unless there is a row for each unknown.
    fn expect_rows(&self, found: usize) -> Result<(), Error> {
        let expected = self.pattern.unknowns();
        if found == expected {
            return Ok(());
        }
        Err(Error::Count { expected, found })
    }

    fn solve_blocks_again<const L: usize>(
        &mut self,
        right: &mut [f64],
        width: usize,
    ) -> Result<(), Error> {
        let order = &self.fronts.order;
        let x = self.solution.as_chunks_mut::<L>().0;
        for at in 0..width {
            let rows = &*right;
            Column { rows, width, at }.copy_to(x, order);
            self.factors.solve(&self.fronts, x);
            store(x, order, (right, width, at))?;
        }
        Ok(())
    }

    fn factor_blocks<const L: usize>(&mut self, values: &[f64]) {
        let matrix = Matrix::<L> {
            fronts: &self.fronts,
            pattern: &self.pattern,
            values,
        };
        self.factors.factor(matrix);
    }
}

/// A matrix with its factors.
#[derive(Debug)]
pub struct Factored<'a> {
    solver: &'a mut Solver,
    values: &'a [f64],
}

impl Factored<'_> {
    /// Overwrites `W` right-hand sides with their solutions.
    ///
    /// Each solution has a componentwise backward error of a few roundings: in row i with k entries
    ///
    /// ```text
    /// |b − A x|ᵢ ≤ max(256, k + 1) ε (|A| |x| + |b|)ᵢ        ε = 2⁻⁵²
    /// ```
    ///
    /// Magnitudes below the smallest normal number count as that number. If the largest entries of all columns of A are within a factor 1/ε
    /// of each other, components of x below `ε max |x|` count as `ε max |x|`. A solution that does not pass is
    /// refined up to three times. If it still fails, elimination with delayed pivots solves, with the same check.
    ///
    /// ```
    /// use eem_sparse::{Error, Pattern, Solver};
    ///
    /// let mut solver = Solver::new(&Pattern::new(2, |pair| pair(0, 1)))?;
    /// let mut x = [[2.0], [3.0]];
    /// let report = solver.factor(&[0.0, 1.0, 1.0, 0.0])?.solve(&mut x)?;
    /// assert_eq!(x, [[3.0], [2.0]]);
    /// assert_eq!(report.fallbacks, 0);
    /// // Two equations that contradict each other.
    /// let refused = solver.factor(&[1.0, 1.0, 1.0, 1.0])?.solve(&mut x);
    /// assert!(matches!(refused, Err(Error::Unsolved { .. })));
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// - [`Error::Count`] unless `right` has a row for each unknown;
    /// - [`Error::NotFinite`] if an entry or a right-hand side is infinite or NaN;
    /// - [`Error::Unsolved`] if no solution passes the check, as for a singular matrix, or overflows;
    /// - [`Error::OutOfMemory`] if the elimination with delayed pivots is needed and has no memory.
    ///
    /// After an error, columns before the one that failed are solved, and all others are unchanged.
    pub fn solve<const W: usize>(&mut self, right: &mut [[f64; W]]) -> Result<Report, Error> {
        self.solver.expect_rows(right.len())?;
        self.solve_columns(right.as_flattened_mut(), W)
    }

    fn solve_columns(&mut self, right: &mut [f64], width: usize) -> Result<Report, Error> {
        match self.solver.pattern.block_length() {
            1 => self.solve_blocks::<1>(right, width),
            2 => self.solve_blocks::<2>(right, width),
            _ => self.solve_blocks::<3>(right, width),
        }
    }

    fn solve_blocks<const L: usize>(
        &mut self,
        right: &mut [f64],
        width: usize,
    ) -> Result<Report, Error> {
        let Solver {
            pattern,
            fronts,
            factors,
            solution,
            residual,
        } = &mut *self.solver;
        let matrix = Matrix::<L> {
            fronts,
            pattern,
            values: self.values,
        };
        let mut report = Report::default();
        for at in 0..width {
            let rows = &*right;
            let b = Column { rows, width, at };
            let equations = Equations { matrix, b };
            let x = solution.as_chunks_mut::<L>().0;
            b.copy_to(x, &fronts.order);
            factors.solve(fronts, x);
            if !equations.are_solved(x, residual) {
                let mut correct = |rest: &mut [[f64; L]]| factors.solve(fronts, rest);
                if let Some(refinements) = equations.refine(x, residual, &mut correct) {
                    report.refinements += refinements;
                } else {
                    report.refinements += solve_by_pivoting(&equations, (x, residual))?;
                    report.fallbacks += 1;
                }
            }
            store(x, &fronts.order, (right, width, at))?;
        }
        Ok(report)
    }
}
