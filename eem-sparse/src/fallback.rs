//! Columns for which the elimination by fronts was not accurate enough.

use crate::columns::all_finite;
use crate::error::{Error, Operand};
use crate::pivoting::Pivoting;
use crate::precision::Precision;
use crate::refinement::{Equations, Failure};

/// Solves with partial pivoting; returns the number of refinements.
#[cold]
pub(crate) fn solve_by_pivoting<P: Precision, B: Fn(usize) -> [f64; L], const L: usize>(
    equations: &Equations<'_, P, B, L>,
    pivoting: &mut Option<Pivoting>,
    (x, residual): (&mut [[f64; L]], &mut Vec<f64>),
) -> Result<usize, Error> {
    let matrix = &equations.matrix;
    let entries = matrix.values.iter().map(|&value| P::widen(value));
    all_finite(Operand::Matrix, entries)?;
    all_finite(Operand::Right, (0..x.len()).flat_map(&equations.b))?;
    let pivoting = match pivoting {
        Some(pivoting) => pivoting,
        None => pivoting.insert(Pivoting::new(matrix.pattern)?),
    };
    for (x, &node) in x.iter_mut().zip(&matrix.fronts.order) {
        *x = (equations.b)(node as usize);
    }
    let refinements = pivoting.factor(matrix, |solve| {
        solve(x);
        if equations.are_solved(x, residual) {
            Some(0)
        } else {
            equations.refine(x, residual, solve)
        }
    });
    refinements.flatten().ok_or_else(|| {
        let Failure {
            row,
            backward_error,
            bound,
        } = equations.worst(x);
        Error::Unsolved {
            row,
            backward_error,
            bound,
        }
    })
}
