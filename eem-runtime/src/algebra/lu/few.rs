//! One and two unknowns, solved by a division.

use super::fixed::{LARGEST_RATIO, solve_fixed};
use crate::algebra::lu::singular::Singular;
use eem_material::number::scalar::{Mask, Real};

/// The first row of `x` becomes the solution of `A x = b` for one unknown, and A zero.
#[inline]
pub(crate) fn solve_one<S: Real, const W: usize>(
    matrix: &mut [S],
    b: &[[S; W]],
    x: &mut [[S; W]],
) -> Result<(), Singular> {
    let ([pivot, ..], [right, ..], [x, ..]) = (matrix, b, x) else {
        return Err(Singular);
    };
    if !pivot.is_finite() || pivot.equal(S::zero()).any() {
        return Err(Singular);
    }
    *x = right.map(|value| value / *pivot);
    *pivot = S::zero();
    Ok(())
}

/// The first two rows of `x` become the solution of `A x = b` for two unknowns, and A zero: Cramer's rule,
/// with one division to wait for, unless the first pivot or the determinant will not do.
///
/// It reads one row of A after the other, as elements have written them: a pair that is read across rows
/// before both have reached the memory has to wait for them.
#[inline]
pub(crate) fn solve_two<S: Real, const W: usize>(
    matrix: &mut [S],
    b: &[[S; W]],
    x: &mut [[S; W]],
) -> Result<(), Singular> {
    let ([matrix, ..], [b, ..], [x, ..]) = (
        matrix.as_chunks_mut::<4>().0,
        b.as_chunks::<2>().0,
        x.as_chunks_mut::<2>().0,
    ) else {
        return Err(Singular);
    };
    let (a, u) = (matrix[0], matrix[1]);
    // A decision in between keeps the compiler from reading u and c together.
    let is_small = (S::from_f64(LARGEST_RATIO) * a.abs()).at_most(u.abs());
    if is_small.decide()? {
        *x = *b;
        return solve_fixed::<S, 2, W>(matrix, x);
    }
    let (c, d) = (matrix[2], matrix[3]);
    let determinant = a * d - c * u;
    let square = determinant * determinant;
    // Neither the products nor the reciprocal have left the range of full precision.
    let is_normal = S::MAX.recip().less(square) & square.at_most(S::MAX);
    if !is_normal.decide()? {
        *x = *b;
        return solve_fixed::<S, 2, W>(matrix, x);
    }
    let inverse = determinant.recip();
    for column in 0..W {
        let (upper, lower) = (b[0][column], b[1][column]);
        x[0][column] = (d * upper - u * lower) * inverse;
        x[1][column] = (a * lower - c * upper) * inverse;
    }
    *matrix = [S::zero(); 4];
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

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

    /// With a good first pivot, with none, and beyond the range of a determinant.
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

    #[test]
    fn a_singular_matrix_is_reported() {
        for mut matrix in [
            [1.0, 2.0, 2.0, 4.0],
            [0.0; 4],
            [f64::NAN, 1.0, 1.0, 1.0],
            [1.0, f64::NAN, 0.0, 1.0],
            [1.0, 0.0, 0.0, f64::INFINITY],
            [f64::INFINITY, 1.0, 1.0, 1.0],
        ] {
            let solved = solve_two::<f64, 1>(&mut matrix, &[[1.0]; 2], &mut [[0.0]; 2]);
            assert_eq!(solved, Err(Singular));
        }
    }
}
