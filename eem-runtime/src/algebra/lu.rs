//! Dense LU factorisation with partial pivoting, in place.
//!
//! For the few unknowns of a small scene or of one element. It works on borrowed memory, so that a step
//! allocates nothing. Numbers of unknowns known at compile time use [`solve_fixed`], [`solve_one`] and [`solve_two`].

mod fixed;

use fixed::subtract;
pub(crate) use fixed::{MOST_FIXED, Singular, copied, solve_fixed, solve_one, solve_two};

/// Factors the row-major `n × n` matrix, `n` the length of `pivots`: `P A = L U`.
pub(crate) fn factor(matrix: &mut [f64], pivots: &mut [usize]) -> Result<(), Singular> {
    let n = pivots.len();
    for column in 0..n {
        let mut pivot = column;
        for row in column + 1..n {
            let size = |row: usize| matrix[row * n + column].abs();
            if size(pivot) < size(row) {
                pivot = row;
            }
        }
        pivots[column] = pivot;
        let value = matrix[pivot * n + column];
        if !value.is_finite() || value == 0.0 {
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
fn eliminate(matrix: &mut [f64], n: usize, column: usize) {
    let (above, below) = matrix.split_at_mut((column + 1) * n);
    let pivot_row = &above[column * n..];
    for row in below.chunks_exact_mut(n) {
        let factor = row[column] / pivot_row[column];
        row[column] = factor;
        subtract(&mut row[column + 1..], factor, &pivot_row[column + 1..]);
    }
}

/// Whether a symmetric row-major `n × n` matrix is positive definite: whether Cholesky's method goes through, which uses
/// and overwrites the lower half.
pub(crate) fn is_positive_definite(matrix: &mut [f64], n: usize) -> bool {
    for row in 0..n {
        for column in 0..=row {
            let mut left = matrix[row * n + column];
            for k in 0..column {
                left -= matrix[row * n + k] * matrix[column * n + k];
            }
            if column < row {
                matrix[row * n + column] = left / matrix[column * n + column];
            } else if left > 0.0 {
                matrix[row * n + column] = left.sqrt();
            } else {
                return false;
            }
        }
    }
    true
}

/// Overwrites the columns of `b` with the solutions of `A x = b`, given the factors of A.
pub(crate) fn solve<const W: usize>(factors: &[f64], pivots: &[usize], b: &mut [[f64; W]]) {
    let n = pivots.len();
    for (row, &pivot) in pivots.iter().enumerate() {
        b.swap(row, pivot);
    }
    for row in 1..n {
        let (known, rest) = b.split_at_mut(row);
        for (&factor, known) in factors[row * n..row * n + row].iter().zip(known) {
            subtract(&mut rest[0], factor, known);
        }
    }
    for row in (0..n).rev() {
        let (head, known) = b.split_at_mut(row + 1);
        for (&factor, known) in factors[row * n + row + 1..(row + 1) * n].iter().zip(known) {
            subtract(&mut head[row], factor, known);
        }
        for entry in &mut head[row] {
            *entry /= factors[row * n + row];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solves_a_system_that_needs_pivoting() {
        let mut matrix = [0.0, 2.0, 1.0, 1.0, 1.0, 0.0, 3.0, 0.0, 1.0];
        let mut pivots = [0; 3];
        factor(&mut matrix, &mut pivots).unwrap();
        let mut b = [[7.0_f64], [3.0], [6.0]];
        solve(&matrix, &pivots, &mut b);
        for (found, exact) in b.iter().zip([1.0, 2.0, 3.0]) {
            assert!((found[0] - exact).abs() <= 4.0 * f64::EPSILON * exact);
        }
    }

    #[test]
    fn signs_of_eigenvalues_are_told() {
        // Eigenvalues 1, 3 and −1, 3.
        assert!(is_positive_definite(&mut [2.0, 1.0, 1.0, 2.0], 2));
        assert!(!is_positive_definite(&mut [1.0, 2.0, 2.0, 1.0], 2));
        assert!(!is_positive_definite(&mut [f64::NAN], 1));
    }

    #[test]
    fn a_singular_matrix_is_reported() {
        let mut matrix = [1.0, 2.0, 2.0, 4.0];
        assert_eq!(factor(&mut matrix, &mut [0; 2]), Err(Singular));
        let mut matrix = [f64::NAN];
        assert_eq!(factor(&mut matrix, &mut [0; 1]), Err(Singular));
    }
}
