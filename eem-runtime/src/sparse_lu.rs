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

mod dissection;
mod elimination;
mod factors;
mod fronts;
mod pivoting;

use crate::lu::Singular;
use crate::pattern::Pattern;
use crate::scalar::Real;
use factors::Factors;
use fronts::Fronts;
use pivoting::Pivoting;

/// The backward error that counts as rounding: sums of some thousand terms.
const ROUNDING: f64 = 256.0 * f64::EPSILON;

/// How often a solution is refined before its factors are given up.
const REFINEMENTS: usize = 3;

/// What solves `A X = B` for matrices with one pattern.
#[derive(Debug)]
pub(crate) struct SparseLu {
    pattern: Pattern,
    fronts: Fronts,
    factors: Factors,
    /// For matrices that need it, from the first of them on.
    pivoting: Option<Box<Pivoting>>,
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
            factors: Factors::new(&fronts)?,
            fronts,
            pivoting: None,
            solution: vec![0.0; pattern.unknowns()],
            residual: vec![0.0; pattern.unknowns()],
        })
    }

    /// Number of entries.
    pub(crate) fn entries(&self) -> usize {
        self.pattern.entries()
    }

    /// Where an entry of the pattern is among the entries.
    pub(crate) fn position(&self, row: usize, column: usize) -> Option<usize> {
        self.pattern.position(row, column)
    }

    /// Overwrites the right-hand sides with the solutions for the matrix with these entries.
    pub(crate) fn solve<S: Real, const W: usize>(
        &mut self,
        values: &[S],
        right: &mut [[S; W]],
    ) -> Result<(), Singular> {
        self.factors.factor(&self.fronts, &self.pattern, values);
        for column in 0..W {
            let b = |row: usize| right[row][column].to_f64();
            if !self.solve_by_fronts(values, b) {
                self.solve_by_pivoting(values, b)?;
            }
            for (row, x) in right.iter_mut().zip(&self.solution) {
                row[column] = S::from_f64(*x);
            }
        }
        Ok(())
    }

    /// Whether the factors lead to the solution.
    fn solve_by_fronts<S: Real>(&mut self, values: &[S], b: impl Fn(usize) -> f64) -> bool {
        self.solution.fill(0.0);
        for (residual, &unknown) in self.residual.iter_mut().zip(&self.fronts.order) {
            *residual = b(unknown as usize);
        }
        for _ in 0..=REFINEMENTS {
            self.factors.solve(&self.fronts, &mut self.residual);
            for (correction, &unknown) in self.residual.iter().zip(&self.fronts.order) {
                self.solution[unknown as usize] += correction;
            }
            if self.is_solved(values, &b) {
                return true;
            }
        }
        false
    }

    /// Finds the residual, and whether it is what rounding leaves.
    fn is_solved<S: Real>(&mut self, values: &[S], b: impl Fn(usize) -> f64) -> bool {
        let x = &self.solution;
        let largest = x.iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
        // Below a rounding of a rounding of the largest, no digit of an unknown counts.
        let floor = f64::EPSILON * largest;
        let mut is_solved = largest <= f64::MAX;
        for row in 0..x.len() {
            let b = b(row);
            let (mut residual, mut size) = (b, b.abs());
            let entries = self.pattern.row(row).iter();
            for (&column, value) in entries.zip(&values[self.pattern.places(row)]) {
                let (value, x) = (value.to_f64(), x[column as usize]);
                residual -= value * x;
                size += value.abs() * (x.abs() + floor);
            }
            is_solved &= residual.abs() <= ROUNDING * size;
            self.residual[self.fronts.places[row] as usize] = residual;
        }
        is_solved
    }

    #[cold]
    fn solve_by_pivoting<S: Real>(
        &mut self,
        values: &[S],
        b: impl Fn(usize) -> f64,
    ) -> Result<(), Singular> {
        let mut numbers = values.iter().map(|value| value.to_f64());
        for (row, x) in self.solution.iter_mut().enumerate() {
            *x = b(row);
        }
        let mut right = self.solution.iter().copied();
        if !numbers.all(f64::is_finite) || !right.all(f64::is_finite) {
            return Err(Singular);
        }
        if self.pivoting.is_none() {
            self.pivoting = Pivoting::new(&self.pattern).map(Box::new);
        }
        let pivoting = self.pivoting.as_mut().ok_or(Singular)?;
        pivoting.solve(&self.pattern, values, &mut self.solution)
    }
}
