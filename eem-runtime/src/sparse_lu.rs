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
mod refinement;

use core::array;

use crate::lu::Singular;
use crate::pattern::{LONGEST_RUN, Pattern};
use crate::scalar::Real;
use factors::Factors;
use fronts::Fronts;
use gathering::Matrix;
use pivoting::Pivoting;
use refinement::{is_solved, refine};

/// What solves `A X = B` for matrices with one pattern, and for those with one unknown in the place of
/// each of its runs.
#[derive(Debug)]
pub(crate) struct SparseLu {
    pattern: Pattern,
    fronts: Fronts,
    factors: Factors,
    /// For matrices that need it, from the first of them on; one for each length of runs.
    pivoting: Vec<Pivoting>,
    /// A column of X in the order of elimination.
    solution: Vec<f64>,
    /// What it leaves, from the first solution on that is refined.
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
            residual: Vec::new(),
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
        for column in 0..W {
            let b = |run: usize| array::from_fn(|at| right[run * L + at][column].to_f64());
            let x = self.solution[..unknowns].as_chunks_mut().0;
            for (x, &run) in x.iter_mut().zip(&matrix.fronts.order) {
                *x = b(run as usize);
            }
            self.factors.solve(matrix.fronts, x);
            if !is_solved(&matrix, x, b)
                && !refine(&matrix, &mut self.factors, (x, &mut self.residual), b)
            {
                solve_by_pivoting(&matrix, &mut self.pivoting, x, b)?;
            }
            for (x, &run) in x.iter().zip(&matrix.fronts.order) {
                let rows = &mut right[run as usize * L..][..L];
                for (row, &x) in rows.iter_mut().zip(x) {
                    row[column] = S::from_f64(x);
                }
            }
        }
        Ok(())
    }
}

/// Solves with pivots from whole columns.
#[cold]
fn solve_by_pivoting<S: Real, const L: usize>(
    matrix: &Matrix<'_, S, L>,
    known: &mut Vec<Pivoting>,
    x: &mut [[f64; L]],
    b: impl Fn(usize) -> [f64; L],
) -> Result<(), Singular> {
    let mut natural: Vec<[f64; L]> = (0..x.len()).map(b).collect();
    let mut numbers = matrix.values.iter().map(|value| value.to_f64());
    let mut right = natural.as_flattened().iter().copied();
    if !numbers.all(f64::is_finite) || !right.all(f64::is_finite) {
        return Err(Singular);
    }
    if known.iter().all(|pivoting| pivoting.length != L) {
        known.extend(Pivoting::new(matrix.pattern, L));
    }
    let mut known = known.iter_mut();
    let pivoting = known.find(|pivoting| pivoting.length == L);
    let pivoting = pivoting.ok_or(Singular)?;
    pivoting.solve(matrix, natural.as_flattened_mut())?;
    for (x, &run) in x.iter_mut().zip(&matrix.fronts.order) {
        *x = natural[run as usize];
    }
    Ok(())
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

    // Blocks of a path of runs: `diagonal` in the own run, `last` at its other unknown, 1 between runs.
    fn path<const L: usize>([diagonal, last]: [f64; 2]) -> (SparseLu, Vec<f64>) {
        let pattern = Pattern::new(40, |pair| (1..40).for_each(|run| pair(run - 1, run)));
        let lu = SparseLu::new(&pattern.in_runs(L)).unwrap();
        let mut values = vec![0.0; lu.entries()];
        for row in 0..40 * L {
            let (run, at) = (row / L, row % L);
            values[lu.position(row, row).unwrap()] = diagonal;
            values[lu.position(row, run * L + (at + 1) % L).unwrap()] = last;
            if run > 0 {
                values[lu.position(row, row - L).unwrap()] = 1.0;
                values[lu.position(row - L, row).unwrap()] = -1.0;
            }
        }
        (lu, values)
    }

    /// Solves for runs of `L` unknowns with solutions that are known.
    fn runs_are_solved<const L: usize>(entries: [f64; 2], is_pivoting: bool) {
        let (mut lu, values) = path::<L>(entries);
        let exact = |row: usize| if row.is_multiple_of(5) { 3.0 } else { -1.0 };
        let unknowns = lu.pattern.unknowns();
        let entry = |row, column| lu.position(row, column).map_or(0.0, |at| values[at]);
        let terms = |row| (0..unknowns).map(move |column| (row, column));
        let b = |row| terms(row).map(|(row, column)| entry(row, column) * exact(column));
        let mut right: Vec<[f64; 1]> = (0..unknowns).map(|row| [b(row).sum()]).collect();
        lu.solve(L, &values, &mut right).unwrap();
        assert_eq!(!lu.pivoting.is_empty(), is_pivoting);
        for (row, [x]) in right.iter().enumerate() {
            assert!((x - exact(row)).abs() <= TOLERANCE, "{L}: {x} in {row}");
        }
    }

    #[test]
    fn runs_are_eliminated_together() {
        runs_are_solved::<1>([4.0, 4.0], false);
        runs_are_solved::<2>([5.0, 2.0], false);
        runs_are_solved::<3>([0.5, 5.0], false);
        // The pivots of every block are tiny, those between blocks are not.
        runs_are_solved::<2>([1e-30, 1e-25], true);
    }

    #[test]
    fn a_smaller_matrix_has_the_same_fronts() {
        let (mut lu, values) = path::<3>([5.0, 1.0]);
        let single: Vec<f64> = values.chunks_exact(9).map(|block| block[0]).collect();
        let mut right = vec![[5.0, 10.0]; 40];
        // 5 x + x⁻ − x⁺ = 5 for x = 1, but for the ends, which have one neighbour.
        (right[0], right[39]) = ([4.0, 8.0], [6.0, 12.0]);
        lu.solve(1, &single, &mut right).unwrap();
        for [x, y] in right {
            assert!((x - 1.0).abs() <= TOLERANCE && (y - 2.0).abs() <= TOLERANCE);
        }
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
