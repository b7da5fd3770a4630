//! Elimination of dense matrices by halves: most of the work is products of halves, computed by `matrixmultiply`.
//!
//! Matrices are views of columns in memory, each column contiguous.

use ndarray::linalg::general_mat_mul;
use ndarray::{ArrayView2, ArrayViewMut1, ArrayViewMut2, Axis, ShapeBuilder};

use crate::threads;

/// At most this many columns are eliminated by loops.
const BLOCK: usize = 8;

/// Work is split in two tasks if each has more multiplications than this, about a millisecond.
const PIECE: usize = 1 << 22;

/// Products are split at multiples of this many columns, a multiple of the block size of `matrixmultiply`: so
/// the bits are those of the whole product.
const ALIGNED: usize = 64;

/// A matrix of so many rows, column by column.
pub(crate) fn columns(entries: &[f64], rows: usize) -> ArrayView2<'_, f64> {
    let shape = (rows, entries.len() / rows).f();
    ArrayView2::from_shape(shape, entries).expect("columns are whole")
}

/// A matrix of so many rows, column by column.
pub(crate) fn columns_mut(entries: &mut [f64], rows: usize) -> ArrayViewMut2<'_, f64> {
    let shape = (rows, entries.len() / rows).f();
    ArrayViewMut2::from_shape(shape, entries).expect("columns are whole")
}

/// The entries of a column.
fn contiguous(column: ArrayViewMut1<'_, f64>) -> &mut [f64] {
    column.into_slice().expect("columns are contiguous")
}

/// Swaps each row with the given one, in sequence.
pub(crate) fn swap_rows(matrix: &mut ArrayViewMut2<'_, f64>, swaps: &[usize]) {
    for column in matrix.axis_iter_mut(Axis(1)) {
        let column = contiguous(column);
        for (k, &row) in swaps.iter().enumerate() {
            column.swap(k, row);
        }
    }
}

/// Replaces a matrix by its factors L and U, one half of the columns after the other (Toledo 1997). Only the
/// first `width` rows can be pivots; notes the row that each of them is swapped with.
pub(crate) fn factor(mut matrix: ArrayViewMut2<'_, f64>, width: usize, swaps: &mut [usize]) {
    if swaps.len() <= BLOCK {
        return factor_by_loops(matrix, width, swaps);
    }
    let half = (swaps.len() / 2).next_multiple_of(BLOCK);
    let (first, second) = swaps.split_at_mut(half);
    let (mut left, mut right) = matrix.view_mut().split_at(Axis(1), half);
    factor(left.view_mut(), width, first);
    swap_rows(&mut right, first);
    let (triangle, below) = left.view().split_at(Axis(0), half);
    let (mut upper, mut rest) = right.split_at(Axis(0), half);
    solve(&triangle, upper.view_mut());
    subtract_product(rest.view_mut(), &below, &upper.view());
    factor(rest, width - half, second);
    swap_rows(&mut left.split_at(Axis(0), half).1, second);
    for row in second {
        *row += half;
    }
}

/// The same for at most `BLOCK` columns, one after the other.
fn factor_by_loops(mut matrix: ArrayViewMut2<'_, f64>, width: usize, swaps: &mut [usize]) {
    for (k, swap) in swaps.iter_mut().enumerate() {
        let column = matrix.column(k);
        *swap = k;
        for row in k + 1..width {
            if column[row].abs() > column[*swap].abs() {
                *swap = row;
            }
        }
        for column in matrix.axis_iter_mut(Axis(1)) {
            contiguous(column).swap(k, *swap);
        }
        let (mut left, mut later) = matrix.view_mut().split_at(Axis(1), k + 1);
        let pivot = &mut contiguous(left.column_mut(k))[k..];
        let reciprocal = pivot[0].recip();
        pivot[1..].iter_mut().for_each(|l| *l *= reciprocal);
        for column in later.axis_iter_mut(Axis(1)) {
            subtract(&mut contiguous(column)[k..], pivot);
        }
    }
}

/// Overwrites columns with their solutions for a unit lower triangular matrix.
pub(crate) fn solve(triangle: &ArrayView2<'_, f64>, columns: ArrayViewMut2<'_, f64>) {
    let Some(half) = half(columns.ncols(), columns.nrows() * columns.nrows()) else {
        return solve_part(triangle, columns);
    };
    let (left, right) = columns.split_at(Axis(1), half);
    threads::join(|| solve(triangle, left), || solve(triangle, right));
}

/// The same in one task.
fn solve_part(triangle: &ArrayView2<'_, f64>, columns: ArrayViewMut2<'_, f64>) {
    let count = triangle.ncols();
    if count <= BLOCK {
        return solve_by_loops(triangle, columns);
    }
    let half = (count / 2).next_multiple_of(BLOCK);
    let (left, right) = triangle.split_at(Axis(1), half);
    let (first, below) = left.split_at(Axis(0), half);
    let (mut upper, mut rest) = columns.split_at(Axis(0), half);
    solve_part(&first, upper.view_mut());
    general_mat_mul(-1.0, &below, &upper, 1.0, &mut rest);
    solve_part(&right.split_at(Axis(0), half).1, rest);
}

/// The same for at most `BLOCK` columns of the triangle.
fn solve_by_loops(triangle: &ArrayView2<'_, f64>, mut columns: ArrayViewMut2<'_, f64>) {
    let count = triangle.ncols();
    let mut lower = [[0.0; BLOCK]; BLOCK];
    for (k, column) in triangle.axis_iter(Axis(1)).enumerate() {
        let column = column.to_slice().expect("columns are contiguous");
        lower[k][k + 1..count].copy_from_slice(&column[k + 1..count]);
    }
    for column in columns.axis_iter_mut(Axis(1)) {
        let column = contiguous(column);
        let mut x = [0.0; BLOCK];
        x[..count].copy_from_slice(column);
        for (k, lower) in lower.iter().enumerate() {
            let u = x[k];
            for (x, l) in x.iter_mut().zip(lower) {
                *x -= l * u;
            }
        }
        column.copy_from_slice(&x[..count]);
    }
}

/// `S −= L U`.
pub(crate) fn subtract_product(
    mut schur: ArrayViewMut2<'_, f64>,
    lower: &ArrayView2<'_, f64>,
    upper: &ArrayView2<'_, f64>,
) {
    let Some(half) = half(schur.ncols(), lower.nrows() * lower.ncols()) else {
        return general_mat_mul(-1.0, lower, upper, 1.0, &mut schur);
    };
    let (left, right) = schur.split_at(Axis(1), half);
    let (first, second) = upper.split_at(Axis(1), half);
    threads::join(
        || subtract_product(left, lower, &first),
        || subtract_product(right, lower, &second),
    );
}

/// Where to split columns with `each` multiplications per column; `None` if that does not pay.
fn half(columns: usize, each: usize) -> Option<usize> {
    let half = (columns / 2).next_multiple_of(ALIGNED);
    (threads::DIVIDE && half < columns && half * each > PIECE).then_some(half)
}

/// `column[i] −= lower[i] · column[0]` for all i > 0.
pub(crate) fn subtract(column: &mut [f64], lower: &[f64]) {
    let Some((&mut first, rest)) = column.split_first_mut() else {
        return;
    };
    for (entry, &l) in rest.iter_mut().zip(&lower[1..]) {
        *entry -= l * first;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Columns of numbers of different size and sign, small below the diagonal.
    fn numbers(rows: usize, columns: usize) -> Vec<f64> {
        let entry = |at: usize| {
            let (row, column) = (at % rows, at / rows);
            let digit = u8::try_from((7 * row + 13 * column + row * column) % 23).unwrap();
            let size = if row < column { 0.1 } else { 1e-3 };
            size * (f64::from(digit) - 10.9)
        };
        (0..rows * columns).map(entry).collect()
    }

    fn bits(entries: &[f64]) -> Vec<u64> {
        entries.iter().map(|entry| entry.to_bits()).collect()
    }

    // With the feature `parallel` each task has 64 or 128 columns, the last one less.
    #[test]
    fn divided_work_has_the_bits_of_the_whole() {
        let (tall, width, right) = (310, 250, 300);
        assert_eq!(half(right, tall * width), threads::DIVIDE.then_some(192));
        let (lower, upper) = (numbers(tall, width), numbers(width, right));
        let (lower, factor) = (columns(&lower, tall), columns(&upper, width));
        let [mut whole, mut divided] = [(); 2].map(|()| numbers(tall, right));
        general_mat_mul(
            -1.0,
            &lower,
            &factor,
            1.0,
            &mut columns_mut(&mut whole, tall),
        );
        subtract_product(columns_mut(&mut divided, tall), &lower, &factor);
        assert!(bits(&whole) == bits(&divided));

        let triangle = lower.split_at(Axis(0), width).0;
        let [mut whole, mut divided] = [(); 2].map(|()| upper.clone());
        solve_part(&triangle, columns_mut(&mut whole, width));
        solve(&triangle, columns_mut(&mut divided, width));
        assert!(whole.iter().all(|entry| entry.is_finite()));
        assert!(bits(&whole) == bits(&divided));
    }
}
