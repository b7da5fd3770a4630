//! Elimination for a number of unknowns known at compile time, at most twelve.
//!
//! Row by row: the rows above have been divided by their pivots, so that a row is finished, from loading it to its own
//! division, without being stored in between. The pivot of a row is its diagonal entry as long as that is not small
//! compared with the others; from the first row on where it is, columns are exchanged. One or two unknowns need one
//! division.

use crate::algebra::vector;

/// The most unknowns for which there is an elimination of its own.
pub(crate) const MOST_FIXED: usize = 12;

/// A matrix without a usable pivot in some column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Singular;

/// A row is divided by its diagonal entry unless its other entries, all together, are larger by more than
/// this factor; that bounds the growth of entries nearly as well as the largest pivot does.
const LARGEST_RATIO: f64 = 4.0;

/// The first row of `x` becomes the solution of `A x = b` for one unknown, and A zero.
#[inline]
pub(crate) fn solve_one<const W: usize>(
    matrix: &mut [f64],
    b: &[[f64; W]],
    x: &mut [[f64; W]],
) -> Result<(), Singular> {
    let ([pivot, ..], [right, ..], [x, ..]) = (matrix, b, x) else {
        return Err(Singular);
    };
    if !pivot.is_finite() || *pivot == 0.0 {
        return Err(Singular);
    }
    for (x, value) in x.iter_mut().zip(right) {
        *x = value / *pivot;
    }
    *pivot = 0.0;
    Ok(())
}

/// The first two rows of `x` become the solution of `A x = b` for two unknowns, and A zero: Cramer's rule,
/// with a single division, unless the first pivot or the determinant is too small.
///
/// It reads A row by row, as elements write it: a load across rows would stall until both stores are complete.
#[inline]
pub(crate) fn solve_two<const W: usize>(
    matrix: &mut [f64],
    b: &[[f64; W]],
    x: &mut [[f64; W]],
) -> Result<(), Singular> {
    let ([matrix, ..], [b, ..], [x, ..]) = (
        matrix.as_chunks_mut::<4>().0,
        b.as_chunks::<2>().0,
        x.as_chunks_mut::<2>().0,
    ) else {
        return Err(Singular);
    };
    let (a, u) = (matrix[0], matrix[1]);
    // This branch keeps the compiler from loading u and c together.
    let is_small = LARGEST_RATIO * a.abs() <= u.abs();
    if is_small {
        *x = *b;
        return solve_fixed(2, matrix, x);
    }
    let (c, d) = (matrix[2], matrix[3]);
    let determinant = a * d - c * u;
    let square = determinant * determinant;
    // Products and reciprocal are normal numbers.
    let is_normal = square > f64::MAX.recip() && square <= f64::MAX;
    if !is_normal {
        *x = *b;
        return solve_fixed(2, matrix, x);
    }
    let inverse = determinant.recip();
    for column in 0..W {
        let (upper, lower) = (b[0][column], b[1][column]);
        x[0][column] = (d * upper - u * lower) * inverse;
        x[1][column] = (a * lower - c * upper) * inverse;
    }
    *matrix = [0.0; 4];
    Ok(())
}

/// Overwrites the columns of `b` with the solutions of `A x = b` for at most [`MOST_FIXED`] unknowns, and A with zeros.
pub(crate) fn solve_fixed<const W: usize>(
    unknowns: usize,
    matrix: &mut [f64],
    b: &mut [[f64; W]],
) -> Result<(), Singular> {
    if W == 1 {
        return solve_column(unknowns, matrix, b.as_flattened_mut());
    }
    let given = copied(&matrix[..unknowns * unknowns]);
    for at in 0..W {
        matrix[..unknowns * unknowns].copy_from_slice(&given[..unknowns * unknowns]);
        let mut column: [f64; MOST_FIXED] = vector(|row| b.get(row).map_or(0.0, |b| b[at]));
        solve_column(unknowns, matrix, &mut column)?;
        for (b, x) in b.iter_mut().zip(column) {
            b[at] = x;
        }
    }
    Ok(())
}

/// A matrix of at most [`MOST_FIXED`] unknowns, in front of zeros.
pub(crate) fn copied(matrix: &[f64]) -> [f64; MOST_FIXED * MOST_FIXED] {
    let mut copy = [0.0; MOST_FIXED * MOST_FIXED];
    copy[..matrix.len()].copy_from_slice(matrix);
    copy
}

/// The elimination that is compiled for this number of unknowns.
fn solve_column(unknowns: usize, matrix: &mut [f64], b: &mut [f64]) -> Result<(), Singular> {
    match unknowns {
        0 => Ok(()),
        1 => solve_compiled::<1>(matrix, b),
        2 => solve_compiled::<2>(matrix, b),
        3 => solve_compiled::<3>(matrix, b),
        4 => solve_compiled::<4>(matrix, b),
        5 => solve_compiled::<5>(matrix, b),
        6 => solve_compiled::<6>(matrix, b),
        7 => solve_compiled::<7>(matrix, b),
        8 => solve_compiled::<8>(matrix, b),
        9 => solve_compiled::<9>(matrix, b),
        10 => solve_compiled::<10>(matrix, b),
        11 => solve_compiled::<11>(matrix, b),
        MOST_FIXED => solve_compiled::<MOST_FIXED>(matrix, b),
        _ => unreachable!("{unknowns} unknowns have no compiled elimination"),
    }
}

fn solve_compiled<const N: usize>(matrix: &mut [f64], b: &mut [f64]) -> Result<(), Singular> {
    let [a, ..] = matrix.as_chunks_mut::<N>().0.as_chunks_mut::<N>().0 else {
        return Err(Singular);
    };
    let [right, ..] = b.as_chunks_mut::<N>().0 else {
        return Err(Singular);
    };
    // `exchange_from` finishes the solution itself: a return to `eliminate` would load rows again.
    match eliminate(a, right) {
        Ok(()) => substitute(a, right),
        Err(row) => {
            exchange_from(row, N, a.as_flattened_mut(), right)?;
            *a = [[0.0; N]; N];
        }
    }
    Ok(())
}

/// Replaces A by its upper factor, whose diagonal is one. The error is the first row without a good pivot.
#[inline]
fn eliminate<const N: usize>(a: &mut [[f64; N]; N], b: &mut [f64; N]) -> Result<(), usize> {
    // Unrolled by hand, as the compiler does not unroll loops in loops: rows stay in registers. Not with `?`, which takes four
    // times the code.
    let mut done = 0;
    let mut goes_on = |row: usize| {
        done = row;
        eliminate_row(row, a, b)
    };
    let all_done = goes_on(0)
        && goes_on(1)
        && goes_on(2)
        && goes_on(3)
        && goes_on(4)
        && goes_on(5)
        && goes_on(6)
        && goes_on(7)
        && goes_on(8)
        && goes_on(9)
        && goes_on(10)
        && goes_on(11);
    if all_done { Ok(()) } else { Err(done) }
}

/// Eliminates the entries of a row before the diagonal, and divides the row by its diagonal entry. If that is no good
/// pivot, the row does not change, and the result is false.
#[inline(always)]
#[expect(clippy::inline_always, reason = "only then is the row a constant")]
fn eliminate_row<const N: usize>(at: usize, a: &mut [[f64; N]; N], b: &mut [f64; N]) -> bool {
    if at >= N {
        return true;
    }
    let (mut row, mut right) = (a[at], b[at]);
    for k in 0..at {
        let factor = row[k];
        let first = first_of_pair(k + 1, N);
        subtract(&mut row[first..], factor, &a[k][first..]);
        right -= factor * b[k];
    }
    if !dominates(&row, at) {
        return false;
    }
    let inverse = row[at].recip();
    let first = first_of_pair(at + 1, N);
    for (entry, &value) in a[at][first..].iter_mut().zip(&row[first..]) {
        *entry = value * inverse;
    }
    b[at] = right * inverse;
    true
}

/// Finds the solution from the upper factor, whose diagonal is one, and leaves zeros in its place.
#[inline]
fn substitute<const N: usize>(a: &mut [[f64; N]; N], b: &mut [f64; N]) {
    for (row, entries) in a.iter_mut().enumerate().rev() {
        substitute_row(row, entries, b);
        *entries = [0.0; N];
    }
}

/// Finds the unknown of a row from those behind it; the result computed last is used last.
#[inline]
fn substitute_row(row: usize, entries: &[f64], b: &mut [f64]) {
    let (head, known) = b.split_at_mut(row + 1);
    for (known, &factor) in known.iter().zip(&entries[row + 1..]).rev() {
        head[row] -= factor * known;
    }
}

/// Eliminates from row `first` on and solves, with the largest entry of each row as its pivot, if necessary by an
/// exchange of two columns.
#[cold]
#[inline(never)]
fn exchange_from(first: usize, n: usize, a: &mut [f64], b: &mut [f64]) -> Result<(), Singular> {
    let mut order: [usize; MOST_FIXED] = vector(|at| at);
    for at in first..n {
        eliminate_before(at, n, a, b);
        let pivot = largest_behind(&a[at * n..][..n], at)?;
        for row in a.chunks_exact_mut(n) {
            row.swap(at, pivot);
        }
        order.swap(at, pivot);
        divide(at, n, a, b);
    }
    for (row, entries) in a.chunks_exact(n).enumerate().rev() {
        substitute_row(row, entries, b);
    }
    let mut found = [0.0; MOST_FIXED];
    found[..n].copy_from_slice(b);
    for (&unknown, value) in order[..n].iter().zip(found) {
        b[unknown] = value;
    }
    Ok(())
}

/// Eliminates the entries of a row before the diagonal.
fn eliminate_before(at: usize, n: usize, a: &mut [f64], b: &mut [f64]) {
    let (above, below) = a.split_at_mut(at * n);
    let (known, right) = b.split_at_mut(at);
    for (k, (entries, known)) in above.chunks_exact(n).zip(known).enumerate() {
        let factor = below[k];
        // So that a row is eliminated once, however often it is looked at.
        below[k] = 0.0;
        subtract(&mut below[k + 1..n], factor, &entries[k + 1..]);
        right[0] -= factor * *known;
    }
}

/// Divides a row by its diagonal entry.
fn divide(at: usize, n: usize, a: &mut [f64], b: &mut [f64]) {
    let row = &mut a[at * n..][..n];
    let inverse = row[at].recip();
    for entry in row.iter_mut().chain([&mut b[at]]) {
        *entry *= inverse;
    }
}

/// The column of the largest entry of a row, on the diagonal or behind it.
fn largest_behind(row: &[f64], diagonal: usize) -> Result<usize, Singular> {
    let (mut pivot, mut size) = (diagonal, row[diagonal].abs());
    for (column, entry) in row.iter().enumerate().skip(diagonal + 1) {
        if size < entry.abs() {
            (pivot, size) = (column, entry.abs());
        }
    }
    if size.is_finite() && size > 0.0 {
        Ok(pivot)
    } else {
        Err(Singular)
    }
}

/// The first column of the pair that contains a column. Entries are subtracted in pairs, of which the last one ends with the row.
const fn first_of_pair(column: usize, columns: usize) -> usize {
    column - (columns - column) % 2
}

/// Whether the diagonal entry of a row is a good pivot.
#[inline]
fn dominates(row: &[f64], diagonal: usize) -> bool {
    let mut squares = [0.0; 2];
    for (column, &entry) in row.iter().enumerate().skip(diagonal + 1) {
        squares[column % 2] += entry * entry;
    }
    let own = row[diagonal] * row[diagonal];
    let least = 1.0 / (LARGEST_RATIO * LARGEST_RATIO) * (squares[0] + squares[1]);
    least < own && own <= f64::MAX
}

/// `x −= factor y`.
#[inline]
pub(super) fn subtract(x: &mut [f64], factor: f64, y: &[f64]) {
    for (x, &y) in x.iter_mut().zip(y) {
        *x -= factor * y;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `A x` with `x = (1, 2, …)`.
    fn image<const N: usize>(a: &[[f64; N]; N]) -> [[f64; 1]; N] {
        let x = |column: u8| f64::from(column + 1);
        a.map(|row| [row.iter().zip(0..).map(|(&entry, at)| entry * x(at)).sum()])
    }

    fn check<const N: usize>(mut a: [[f64; N]; N]) {
        let mut b = image(&a);
        let (mut copy, mut two) = (a, b.map(|[b]| [b; 2]));
        solve_fixed(N, a.as_flattened_mut(), &mut b).unwrap();
        for (found, exact) in b.iter().zip(1_u8..) {
            let exact = f64::from(exact);
            assert!((found[0] - exact).abs() <= 16.0 * f64::EPSILON * exact);
        }
        // Several columns have the bits of one.
        solve_fixed(N, copy.as_flattened_mut(), &mut two).unwrap();
        for (two, one) in two.iter().zip(&b) {
            assert_eq!(two.map(f64::to_bits), [one[0].to_bits(); 2]);
        }
    }

    #[test]
    fn solves_a_system_that_needs_pivoting() {
        check([[0.0, 2.0, 1.0], [1.0, 1.0, 0.0], [3.0, 0.0, 1.0]]);
        check([[0.0, 1.0], [1.0, 0.0]]);
        check([[1e-3, 1.0], [1.0, 1.0]]);
        check([[1e-200, 3e-200], [3e-200, 1e-200]]);
    }

    /// Cyclic neighbours, which only an exchange in every row but the last brings to the diagonal.
    #[test]
    fn every_number_of_unknowns_is_solved() {
        fn both<const N: usize>() {
            check::<N>(core::array::from_fn(|i| {
                vector(|j| if i == j { 4.0 } else { 0.25 })
            }));
            check::<N>(core::array::from_fn(|i| {
                vector(|j| if (i + 1) % N == j { 4.0 } else { 0.25 })
            }));
        }
        both::<1>();
        both::<2>();
        both::<3>();
        both::<5>();
        both::<8>();
        both::<12>();
    }

    #[test]
    fn a_singular_matrix_is_reported() {
        for matrix in [
            [1.0, 2.0, 2.0, 4.0],
            [0.0; 4],
            [f64::NAN, 1.0, 1.0, 1.0],
            [1.0, f64::NAN, 0.0, 1.0],
            [1.0, 0.0, 0.0, f64::INFINITY],
            [f64::INFINITY, 1.0, 1.0, 1.0],
        ] {
            let solved = solve_fixed(2, &mut matrix.clone(), &mut [[1.0]; 2]);
            assert_eq!(solved, Err(Singular));
            let solved = solve_two(&mut matrix.clone(), &[[1.0]; 2], &mut [[0.0]; 2]);
            assert_eq!(solved, Err(Singular));
        }
    }

    #[test]
    fn one_unknown_is_a_quotient() {
        let (mut a, mut x) = ([4.0], [[0.0, 0.0]]);
        solve_one(&mut a, &[[2.0, 6.0]], &mut x).unwrap();
        assert_eq!((a, x), ([0.0], [[0.5, 1.5]]));
    }

    #[test]
    fn one_unknown_needs_a_number_that_is_not_zero() {
        for pivot in [0.0, f64::NAN, f64::INFINITY] {
            let solved = solve_one(&mut [pivot], &[[1.0]], &mut [[0.0]]);
            assert_eq!(solved, Err(Singular));
        }
    }

    /// With and without a good first pivot, and beyond the range of a determinant.
    #[test]
    fn two_unknowns_are_solved_with_cramer_and_without() {
        for a in [
            [4.0, 0.25, 0.25, 4.0],
            [0.0, 1.0, 1.0, 0.0],
            [1e-3, 1.0, 1.0, 1.0],
            [1e-200, 3e-200, 3e-200, 1e-200],
            [3e-200, 1e-200, 1e-200, 3e-200],
        ] {
            let exact = [1.0_f64, 2.0];
            let [upper, lower] = [0, 2].map(|row| a[row] * exact[0] + a[row + 1] * exact[1]);
            let (mut matrix, mut x) = (a, [[0.0]; 2]);
            solve_two(&mut matrix, &[[upper], [lower]], &mut x).unwrap();
            assert!(matrix.iter().all(|entry| entry.to_bits() == 0));
            for ([found], exact) in x.into_iter().zip(exact) {
                assert!((found - exact).abs() <= 16.0 * f64::EPSILON * exact);
            }
        }
    }
}
