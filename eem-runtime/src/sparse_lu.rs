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

use core::array;

use crate::lu::Singular;
use crate::pattern::{LONGEST_RUN, Pattern};
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

    /// Overwrites the right-hand sides with the solutions for the matrix with these entries, block by
    /// block, whose runs are as long as those of the pattern, or one unknown.
    pub(crate) fn solve<S: Real, const W: usize>(
        &mut self,
        length: usize,
        values: &[S],
        right: &mut [[S; W]],
    ) -> Result<(), Singular> {
        match length {
            1 => self.solve_in_runs::<S, W, 1>(values, right),
            2 => self.solve_in_runs::<S, W, 2>(values, right),
            LONGEST_RUN => self.solve_in_runs::<S, W, LONGEST_RUN>(values, right),
            _ => unreachable!("no pattern has longer runs"),
        }
    }

    fn solve_in_runs<S: Real, const W: usize, const L: usize>(
        &mut self,
        values: &[S],
        right: &mut [[S; W]],
    ) -> Result<(), Singular> {
        let unknowns = right.len();
        let matrix = Matrix::<S, L> {
            fronts: &self.fronts,
            pattern: &self.pattern,
            values,
        };
        self.factors.factor(matrix);
        let mut vectors = Vectors {
            solution: self.solution[..unknowns].as_chunks_mut().0,
            residual: self.residual[..unknowns].as_chunks_mut().0,
        };
        for column in 0..W {
            let b = |row: usize| right[row][column].to_f64();
            if !vectors.solve_by_fronts(&matrix, &mut self.factors, b) {
                vectors.solve_by_pivoting(&matrix, &mut self.pivoting, b)?;
            }
            for (row, x) in right.iter_mut().zip(vectors.solution.as_flattened()) {
                row[column] = S::from_f64(*x);
            }
        }
        Ok(())
    }
}

/// A column of X and of the residual, at work.
struct Vectors<'a, const L: usize> {
    solution: &'a mut [[f64; L]],
    /// In the order of elimination.
    residual: &'a mut [[f64; L]],
}

impl<const L: usize> Vectors<'_, L> {
    /// Whether the factors lead to the solution.
    fn solve_by_fronts<S: Real>(
        &mut self,
        matrix: &Matrix<'_, S, L>,
        factors: &mut Factors,
        b: impl Fn(usize) -> f64,
    ) -> bool {
        let order = &matrix.fronts.order;
        self.solution.fill([0.0; L]);
        for (residual, &run) in self.residual.iter_mut().zip(order) {
            *residual = array::from_fn(|at| b(run as usize * L + at));
        }
        for _ in 0..=REFINEMENTS {
            factors.solve(matrix.fronts, self.residual);
            for (corrections, &run) in self.residual.iter().zip(order) {
                for (x, correction) in self.solution[run as usize].iter_mut().zip(corrections) {
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
    fn is_solved<S: Real>(&mut self, matrix: &Matrix<'_, S, L>, b: impl Fn(usize) -> f64) -> bool {
        let x = self.solution.as_flattened();
        let largest = x.iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
        // Below a rounding of a rounding of the largest, no digit of an unknown counts.
        let floor = f64::EPSILON * largest;
        let mut is_solved = largest <= f64::MAX;
        for (run, &place) in matrix.fronts.places.iter().enumerate() {
            let mut residual: [f64; L] = array::from_fn(|at| b(run * L + at));
            let mut size = residual.map(f64::abs);
            for (column, block) in matrix.blocks_of(run) {
                let x = &self.solution[column];
                for (row, entries) in block.iter().enumerate() {
                    for (value, x) in entries.iter().zip(x) {
                        let value = value.to_f64();
                        residual[row] -= value * x;
                        size[row] += value.abs() * (x.abs() + floor);
                    }
                }
            }
            for (residual, size) in residual.iter().zip(size) {
                is_solved &= residual.abs() <= ROUNDING * size;
            }
            self.residual[place as usize] = residual;
        }
        is_solved
    }

    #[cold]
    fn solve_by_pivoting<S: Real>(
        &mut self,
        matrix: &Matrix<'_, S, L>,
        known: &mut Vec<Pivoting>,
        b: impl Fn(usize) -> f64,
    ) -> Result<(), Singular> {
        let solution = self.solution.as_flattened_mut();
        for (row, x) in solution.iter_mut().enumerate() {
            *x = b(row);
        }
        let mut numbers = matrix.values.iter().map(|value| value.to_f64());
        let mut right = solution.iter().copied();
        if !numbers.all(f64::is_finite) || !right.all(f64::is_finite) {
            return Err(Singular);
        }
        if known.iter().all(|pivoting| pivoting.length != L) {
            known.extend(Pivoting::new(matrix.pattern, L));
        }
        let mut known = known.iter_mut();
        let pivoting = known.find(|pivoting| pivoting.length == L);
        pivoting.ok_or(Singular)?.solve(matrix, solution)
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
