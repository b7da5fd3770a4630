//! Whether a solution is one to rounding, and what refinement adds to it.
//!
//! Solutions are in the order of elimination, right-hand sides in that of the unknowns.

use super::factors::Factors;
use super::gathering::Matrix;
use crate::scalar::Real;

/// The backward error that counts as rounding: sums of some thousand terms.
const ROUNDING: f64 = 256.0 * f64::EPSILON;

/// How often a solution is refined before its factors are given up.
const REFINEMENTS: usize = 3;

/// What a solution leaves of the right-hand sides of a run, and their size with that of the terms.
#[expect(clippy::inline_always, reason = "a few numbers in registers")]
#[inline(always)]
fn residual<S: Real, const L: usize>(
    matrix: &Matrix<'_, S, L>,
    run: usize,
    (x, floor): (&[[f64; L]], f64),
    b: [f64; L],
) -> ([f64; L], [f64; L]) {
    let (mut residual, mut size) = (b, b.map(f64::abs));
    for (column, block) in matrix.blocks_of(run) {
        let x = &x[matrix.fronts.places[column] as usize];
        for (row, entries) in block.iter().enumerate() {
            for (value, x) in entries.iter().zip(x) {
                let value = value.to_f64();
                residual[row] -= value * x;
                size[row] += value.abs() * (x.abs() + floor);
            }
        }
    }
    (residual, size)
}

/// Whether what a solution leaves is what rounding leaves.
pub(super) fn is_solved<S: Real, const L: usize>(
    matrix: &Matrix<'_, S, L>,
    x: &[[f64; L]],
    b: impl Fn(usize) -> [f64; L],
) -> bool {
    let largest = x.as_flattened().iter();
    let largest = largest.fold(0.0_f64, |largest, x| largest.max(x.abs()));
    // Below a rounding of a rounding of the largest, no digit of an unknown counts.
    let floor = f64::EPSILON * largest;
    let mut is_solved = largest <= f64::MAX;
    for run in 0..x.len() {
        let (residual, size) = residual(matrix, run, (x, floor), b(run));
        for (residual, size) in residual.iter().zip(size) {
            is_solved &= residual.abs() <= ROUNDING * size;
        }
    }
    is_solved
}

/// Whether refinement makes it one.
#[cold]
pub(super) fn refine<S: Real, const L: usize>(
    matrix: &Matrix<'_, S, L>,
    factors: &mut Factors,
    (x, memory): (&mut [[f64; L]], &mut Vec<f64>),
    b: impl Fn(usize) -> [f64; L],
) -> bool {
    memory.resize(memory.len().max(x.as_flattened().len()), 0.0);
    let rest = &mut memory.as_chunks_mut::<L>().0[..x.len()];
    for _ in 0..REFINEMENTS {
        for (rest, &run) in rest.iter_mut().zip(&matrix.fronts.order) {
            (*rest, _) = residual(matrix, run as usize, (x, 0.0), b(run as usize));
        }
        factors.solve(matrix.fronts, rest);
        for (x, correction) in x.as_flattened_mut().iter_mut().zip(rest.as_flattened()) {
            *x += correction;
        }
        if is_solved(matrix, x, &b) {
            return true;
        }
    }
    false
}
