//! Sparse elimination whose symbolic part is done once, and whose every solution is checked.
//!
//! A tangent has large entries on its diagonal, masses and ones, so that its pivots stay near the
//! diagonal and an order of elimination found from the symmetric pattern alone can be kept: far fewer
//! entries fill in than if every row had to be ready to become a pivot. That this is enough for the
//! matrix at hand is not believed but measured, by the backward error of the solution (Arioli, Demmel
//! & Duff 1989)
//!
//! ```text
//! ω = maxᵢ |b − A x|ᵢ / (|A| |x| + |b|)ᵢ
//! ```
//!
//! which is a few roundings. If refinement does not bring it there, elimination with pivots from
//! whole columns solves instead. Factors are in double precision whatever the scene is computed in:
//! they only correct, and the next residual judges the correction.

mod branch;
mod dissection;
mod division;
mod elimination;
mod factors;
mod fronts;
mod gathering;
mod pivoting;

use crate::lu::Singular;
use crate::pattern::Pattern;
use crate::scalar::Real;
use factors::Factors;
use fronts::Fronts;
use gathering::Matrix;
use pivoting::Pivoting;

/// The backward error that counts as rounding: sums of some thousand terms.
const ROUNDING: f64 = 256.0 * f64::EPSILON;

/// How often a solution is refined before its factors are given up.
const REFINEMENTS: usize = 3;

/// What solves `A X = B` for matrices with one pattern, and for those with one unknown in the place of
/// each of its runs.
#[derive(Debug)]
pub(crate) struct SparseLu {
    pattern: Pattern,
    fronts: Fronts,
    factors: Factors,
    /// For matrices that need it, from the first of them on; one for each length of runs.
    pivoting: Vec<Pivoting>,
    /// A column of X.
    solution: Vec<f64>,
    /// What is to be solved for, in the order of elimination.
    residual: Vec<f64>,
}

impl SparseLu {
    /// Orders and analyses a pattern; `None` if memory is missing.
    pub(crate) fn new(pattern: &Pattern) -> Option<Self> {
        let fronts = Fronts::new(pattern)?;
        Some(Self {
            pattern: pattern.clone(),
            factors: Factors::new(&fronts, pattern.length())?,
            fronts,
            pivoting: Vec::new(),
            solution: vec![0.0; pattern.unknowns()],
            residual: vec![0.0; pattern.unknowns()],
        })
    }

    /// Number of entries.
    pub(crate) fn entries(&self) -> usize {
        self.pattern.entries()
    }

    /// Number of unknowns in a run.
    pub(crate) fn length(&self) -> usize {
        self.pattern.length()
    }

    /// Where an entry of the pattern is among the entries.
    pub(crate) fn position(&self, row: usize, column: usize) -> Option<usize> {
        self.pattern.position(row, column)
    }

    /// Overwrites the right-hand sides with the solutions for the matrix with these entries, whose runs
    /// are as long as those of the pattern, or one unknown.
    pub(crate) fn solve<S: Real, const W: usize>(
        &mut self,
        length: usize,
        values: &[S],
        right: &mut [[S; W]],
    ) -> Result<(), Singular> {
        let Self {
            pattern,
            fronts,
            factors,
            pivoting,
            solution,
            residual,
        } = self;
        let matrix = Matrix {
            fronts,
            pattern,
            length,
            values,
        };
        factors.factor(matrix);
        let mut vectors = Vectors {
            solution: &mut solution[..right.len()],
            residual: &mut residual[..right.len()],
        };
        for column in 0..W {
            let b = |row: usize| right[row][column].to_f64();
            if !vectors.solve_by_fronts(&matrix, factors, b) {
                vectors.solve_by_pivoting(&matrix, pivoting, b)?;
            }
            for (row, x) in right.iter_mut().zip(&*vectors.solution) {
                row[column] = S::from_f64(*x);
            }
        }
        Ok(())
    }
}

/// A column of X and of the residual, at work.
struct Vectors<'a> {
    solution: &'a mut [f64],
    residual: &'a mut [f64],
}

impl Vectors<'_> {
    /// Whether the factors lead to the solution.
    fn solve_by_fronts<S: Real>(
        &mut self,
        matrix: &Matrix<'_, S>,
        factors: &mut Factors,
        b: impl Fn(usize) -> f64,
    ) -> bool {
        let length = matrix.length;
        self.solution.fill(0.0);
        let runs = self.residual.chunks_exact_mut(length);
        for (residual, &run) in runs.zip(&matrix.fronts.order) {
            for (row, residual) in (run as usize * length..).zip(residual) {
                *residual = b(row);
            }
        }
        for _ in 0..=REFINEMENTS {
            factors.solve(matrix.fronts, length, self.residual);
            let runs = self.residual.chunks_exact(length);
            for (corrections, &run) in runs.zip(&matrix.fronts.order) {
                let solution = &mut self.solution[run as usize * length..][..length];
                for (x, correction) in solution.iter_mut().zip(corrections) {
                    *x += correction;
                }
            }
            if self.is_solved(matrix, &b) {
                return true;
            }
        }
        false
    }

    /// Finds the residual, and whether it is what rounding leaves.
    fn is_solved<S: Real>(&mut self, matrix: &Matrix<'_, S>, b: impl Fn(usize) -> f64) -> bool {
        let (x, length) = (&*self.solution, matrix.length);
        let largest = x.iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
        // Below a rounding of a rounding of the largest, no digit of an unknown counts.
        let floor = f64::EPSILON * largest;
        let mut is_solved = largest <= f64::MAX;
        for (run, &place) in matrix.fronts.places.iter().enumerate() {
            let residuals = &mut self.residual[place as usize * length..][..length];
            for (row, rest) in (run * length..).zip(residuals) {
                let b = b(row);
                let (mut residual, mut size) = (b, b.abs());
                matrix.each_in_row(row, |column, value| {
                    let (value, x) = (value.to_f64(), x[column]);
                    residual -= value * x;
                    size += value.abs() * (x.abs() + floor);
                });
                is_solved &= residual.abs() <= ROUNDING * size;
                *rest = residual;
            }
        }
        is_solved
    }

    #[cold]
    fn solve_by_pivoting<S: Real>(
        &mut self,
        matrix: &Matrix<'_, S>,
        known: &mut Vec<Pivoting>,
        b: impl Fn(usize) -> f64,
    ) -> Result<(), Singular> {
        let length = matrix.length;
        for (row, x) in self.solution.iter_mut().enumerate() {
            *x = b(row);
        }
        let mut numbers = matrix.values.iter().map(|value| value.to_f64());
        let mut right = self.solution.iter().copied();
        if !numbers.all(f64::is_finite) || !right.all(f64::is_finite) {
            return Err(Singular);
        }
        if known.iter().all(|pivoting| pivoting.length != length) {
            known.extend(Pivoting::new(matrix.pattern, length));
        }
        let mut known = known.iter_mut();
        let pivoting = known.find(|pivoting| pivoting.length == length);
        pivoting.ok_or(Singular)?.solve(matrix, self.solution)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A cycle of unknowns with these entries on the diagonal and in both directions around it.
    fn cycle(unknowns: usize, [diagonal, forth, back]: [f64; 3]) -> (SparseLu, Vec<f64>) {
        let pattern = Pattern::new(unknowns, |pair| {
            (0..unknowns).for_each(|row| pair(row, (row + 1) % unknowns));
        });
        let lu = SparseLu::new(&pattern).unwrap();
        let mut values = vec![0.0; lu.entries()];
        for row in 0..unknowns {
            let next = (row + 1) % unknowns;
            for (row, column, entry) in
                [(row, row, diagonal), (row, next, forth), (next, row, back)]
            {
                values[lu.position(row, column).unwrap()] = entry;
            }
        }
        (lu, values)
    }

    /// The largest error of solutions that are known.
    fn error(lu: &mut SparseLu, values: &[f64]) -> f64 {
        let exact = |row: usize| [1.0, if row.is_multiple_of(3) { 2.0 } else { -1.0 }];
        let mut right = vec![[0.0; 2]; lu.pattern.unknowns()];
        for (row, b) in right.iter_mut().enumerate() {
            let columns = lu.pattern.row(row).iter();
            for (&column, value) in columns.zip(&values[lu.pattern.blocks(row)]) {
                let x = exact(column as usize);
                *b = [b[0] + value * x[0], b[1] + value * x[1]];
            }
        }
        lu.solve(1, values, &mut right).unwrap();
        let errors = right.iter().enumerate().flat_map(|(row, x)| {
            let exact = exact(row);
            [x[0] - exact[0], x[1] - exact[1]]
        });
        errors.fold(0.0, |largest, error| largest.max(error.abs()))
    }

    // Condition numbers below 10.
    const TOLERANCE: f64 = 1e3 * f64::EPSILON;

    #[test]
    fn pivots_near_the_diagonal_need_no_others() {
        let (mut lu, values) = cycle(100, [4.0, -1.0, 2.0]);
        assert!(error(&mut lu, &values) <= TOLERANCE);
        assert!(lu.pivoting.is_empty());
    }

    // Nearly a permutation: every pivot that the pattern expects is tiny.
    #[test]
    fn pivots_are_found_wherever_they_are() {
        let (mut lu, values) = cycle(101, [1e-30, 1.0, 0.1]);
        assert!(error(&mut lu, &values) <= TOLERANCE);
        assert!(!lu.pivoting.is_empty());
        let (_, values) = cycle(101, [4.0, -1.0, 2.0]);
        assert!(error(&mut lu, &values) <= TOLERANCE);
    }

    #[test]
    fn a_singular_matrix_is_an_error() {
        let (mut lu, mut values) = cycle(50, [0.0, 0.0, 0.0]);
        assert!(lu.solve(1, &values, &mut vec![[1.0]; 50]).is_err());
        values.fill(f64::NAN);
        assert!(lu.solve(1, &values, &mut vec![[1.0]; 50]).is_err());
    }

    // A response that decays by a digit per unknown, soon below any rounding.
    #[test]
    fn what_is_far_below_rounding_is_solved_too() {
        let (mut lu, values) = cycle(2_000, [1.0, 0.1, 0.1]);
        let mut right = vec![[0.0]; 2_000];
        right[0] = [1.0];
        lu.solve(1, &values, &mut right).unwrap();
        assert!(lu.pivoting.is_empty());
    }
}
