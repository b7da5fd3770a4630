//! Columns for which the elimination by fronts was not accurate enough.

use crate::columns::all_finite;
use crate::error::{Error, Operand};
use crate::pivoting::Pivoting;
use crate::refinement::{Equations, Failure};

/// Solves with delayed pivots; returns the number of refinements.
#[cold]
pub(crate) fn solve_by_pivoting<const L: usize>(
    equations: &Equations<'_, L>,
    (x, residual): (&mut [[f64; L]], &mut Vec<f64>),
) -> Result<usize, Error> {
    let matrix = &equations.matrix;
    let entries = matrix.values.iter().copied();
    all_finite(Operand::Matrix, entries)?;
    let right = (0..x.len()).flat_map(|node| equations.b.of::<L>(node));
    all_finite(Operand::Right, right)?;
    equations.b.copy_to(x, &matrix.fronts.order);
    let refinements = Pivoting::new(matrix)?.and_then(|mut pivoting| {
        let mut solve = |x: &mut [[f64; L]]| pivoting.solve(x.as_flattened_mut());
        solve(x);
        if equations.are_solved(x, residual) {
            Some(0)
        } else {
            equations.refine(x, residual, &mut solve)
        }
    });
    refinements.ok_or_else(|| {
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
