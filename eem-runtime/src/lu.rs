//! Dense LU factorisation with partial pivoting, in place.
//!
//! For the handful of unknowns of a small scene or of one element. It works on any [`Real`] and on
//! borrowed memory, so that a step allocates nothing.

use crate::scalar::Real;

/// A matrix that has no usable pivot in some column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Singular;

/// Factors the row-major `n × n` matrix, `n` the length of `pivots`: `P A = L U`.
pub(crate) fn factor<S: Real>(matrix: &mut [S], pivots: &mut [usize]) -> Result<(), Singular> {
    let n = pivots.len();
    for column in 0..n {
        let mut pivot = column;
        for row in column + 1..n {
            if matrix[row * n + column].abs() > matrix[pivot * n + column].abs() {
                pivot = row;
            }
        }
        pivots[column] = pivot;
        let value = matrix[pivot * n + column];
        if !value.is_finite() || value == S::zero() {
            return Err(Singular);
        }
        if pivot != column {
            for k in 0..n {
                matrix.swap(column * n + k, pivot * n + k);
            }
        }
        eliminate(matrix, n, column);
    }
    Ok(())
}

/// Subtracts the pivot row from the rows below it.
fn eliminate<S: Real>(matrix: &mut [S], n: usize, column: usize) {
    let (above, below) = matrix.split_at_mut((column + 1) * n);
    let pivot_row = &above[column * n..];
    for row in below.chunks_exact_mut(n) {
        let factor = row[column] / pivot_row[column];
        row[column] = factor;
        for (entry, &pivot) in row[column + 1..].iter_mut().zip(&pivot_row[column + 1..]) {
            *entry -= factor * pivot;
        }
    }
}

/// Overwrites `b` with the solution of `A x = b`, given the factors of A.
pub(crate) fn solve<S: Real>(factors: &[S], pivots: &[usize], b: &mut [S]) {
    let n = pivots.len();
    for (row, &pivot) in pivots.iter().enumerate() {
        b.swap(row, pivot);
    }
    for row in 1..n {
        let (known, rest) = b.split_at_mut(row);
        rest[0] -= dot(&factors[row * n..row * n + row], known);
    }
    for row in (0..n).rev() {
        let (head, known) = b.split_at_mut(row + 1);
        let sum = dot(&factors[row * n + row + 1..(row + 1) * n], known);
        head[row] = (head[row] - sum) / factors[row * n + row];
    }
}

/// `Σ a_i b_i`.
fn dot<S: Real>(a: &[S], b: &[S]) -> S {
    a.iter().zip(b).fold(S::zero(), |sum, (&a, &b)| sum + a * b)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solves_a_system_that_needs_pivoting() {
        let mut matrix = [0.0, 2.0, 1.0, 1.0, 1.0, 0.0, 3.0, 0.0, 1.0];
        let mut pivots = [0; 3];
        factor(&mut matrix, &mut pivots).unwrap();
        let mut b = [7.0_f64, 3.0, 6.0];
        solve(&matrix, &pivots, &mut b);
        for (found, exact) in b.iter().zip([1.0, 2.0, 3.0]) {
            assert!((found - exact).abs() <= 4.0 * f64::EPSILON * exact);
        }
    }

    #[test]
    fn a_singular_matrix_is_reported() {
        let mut matrix = [1.0, 2.0, 2.0, 4.0];
        assert_eq!(factor(&mut matrix, &mut [0; 2]), Err(Singular));
        let mut matrix = [f64::NAN];
        assert_eq!(factor(&mut matrix, &mut [0; 1]), Err(Singular));
    }
}
