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

/// Overwrites the columns of `b` with the solutions of `A x = b`, given the factors of A.
pub(crate) fn solve<S: Real, const W: usize>(factors: &[S], pivots: &[usize], b: &mut [[S; W]]) {
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

/// Overwrites the columns of `b` with the solutions of `A x = b` for `N` unknowns, which the
/// compiler knows. A is lost.
pub(crate) fn solve_fixed<S: Real, const N: usize, const W: usize>(
    matrix: &mut [S],
    b: &mut [[S; W]],
) -> Result<(), Singular> {
    let [a, ..] = matrix.as_chunks_mut::<N>().0.as_chunks_mut::<N>().0 else {
        return Err(Singular);
    };
    let [b, ..] = b.as_chunks_mut::<N>().0 else {
        return Err(Singular);
    };
    let mut inverse = [S::zero(); N];
    let mut pivot = a
        .first()
        .and_then(|row| row.first())
        .map_or(S::zero(), |&first| first);
    for column in 0..N {
        if !dominates(a, column) {
            let row = pivot_row(a, column)?;
            a.swap(row, column);
            b.swap(row, column);
            pivot = a[column][column];
        }
        let (above, below) = a.split_at_mut(column + 1);
        let (above_b, below_b) = b.split_at_mut(column + 1);
        let (pivot_row, pivot_b) = (&above[column], &above_b[column]);
        inverse[column] = pivot.recip();
        // The next pivot first: its division is what everything waits for.
        if let ([row, ..], Some(&right)) = (&*below, pivot_row.get(column + 1)) {
            pivot = row[column + 1] - row[column] * inverse[column] * right;
        }
        for (row, b) in below.iter_mut().zip(below_b) {
            let factor = row[column] * inverse[column];
            // Whole rows, which is faster: the entries before the column are not read again.
            subtract(row, factor, pivot_row);
            subtract(b, factor, pivot_b);
        }
    }
    for row in (0..N).rev() {
        let (head, known) = b.split_at_mut(row + 1);
        // The latest is the last to be waited for.
        for (known, &factor) in known.iter().zip(&a[row][row + 1..]).rev() {
            subtract(&mut head[row], factor, known);
        }
        for entry in &mut head[row] {
            *entry *= inverse[row];
        }
    }
    Ok(())
}

/// Whether the diagonal entry of a column will do as its pivot: it is at least a quarter of what is
/// below it, which bounds the growth of entries nearly as well as the largest one does.
#[inline]
fn dominates<S: Real, const N: usize>(a: &[[S; N]; N], column: usize) -> bool {
    let below = a[column + 1..].iter();
    let largest = below.fold(S::zero(), |largest, row| larger(row[column].abs(), largest));
    let own = a[column][column].abs();
    own > S::zero() && own <= S::MAX && own >= S::from_f64(0.25) * largest
}

/// The row of the largest entry of a column, on the diagonal or below.
#[cold]
#[inline(never)]
fn pivot_row<S: Real, const N: usize>(a: &[[S; N]; N], column: usize) -> Result<usize, Singular> {
    let (mut pivot, mut size) = (column, a[column][column].abs());
    for (row, entries) in a.iter().enumerate().skip(column + 1) {
        if entries[column].abs() > size {
            (pivot, size) = (row, entries[column].abs());
        }
    }
    if size.is_finite() && size > S::zero() {
        Ok(pivot)
    } else {
        Err(Singular)
    }
}

/// The larger of two, the second if the first is NaN.
#[inline]
fn larger<S: Real>(a: S, b: S) -> S {
    if a > b { a } else { b }
}

/// `x −= factor y`.
#[inline]
fn subtract<S: Real, const W: usize>(x: &mut [S; W], factor: S, y: &[S; W]) {
    for (x, &y) in x.iter_mut().zip(y) {
        *x -= factor * y;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solves_a_system_that_needs_pivoting() {
        let mut matrix = [0.0, 2.0, 1.0, 1.0, 1.0, 0.0, 3.0, 0.0, 1.0];
        let mut pivots = [0; 3];
        let (fixed, right) = (matrix, [[7.0_f64], [3.0], [6.0]]);
        factor(&mut matrix, &mut pivots).unwrap();
        let mut b = right;
        solve(&matrix, &pivots, &mut b);
        let (mut matrix, mut c) = (fixed, right);
        solve_fixed::<f64, 3, 1>(&mut matrix, &mut c).unwrap();
        for ((found, fixed), exact) in b.iter().zip(c).zip([1.0, 2.0, 3.0]) {
            assert!((found[0] - exact).abs() <= 4.0 * f64::EPSILON * exact);
            assert!((fixed[0] - exact).abs() <= 4.0 * f64::EPSILON * exact);
        }
    }

    #[test]
    fn a_singular_matrix_is_reported() {
        let mut matrix = [1.0, 2.0, 2.0, 4.0];
        assert_eq!(factor(&mut matrix, &mut [0; 2]), Err(Singular));
        let mut matrix = [1.0, 2.0, 2.0, 4.0];
        let solved = solve_fixed::<f64, 2, 1>(&mut matrix, &mut [[1.0]; 2]);
        assert_eq!(solved, Err(Singular));
        let mut matrix = [f64::NAN];
        assert_eq!(factor(&mut matrix, &mut [0; 1]), Err(Singular));
    }
}
