//! Eigenvalues of small symmetric matrices, by Jacobi's method of rotations.

/// Sweeps over all pairs of axes; convergence is quadratic, so that a handful suffice.
const MOST_SWEEPS: usize = 40;

/// Leaves the eigenvalues of a symmetric row-major `n × n` matrix on its diagonal, and multiplies `axes`, as many rows of
/// `n` numbers, by the rotations: rows of the unit matrix become eigenvectors.
#[inline(always)]
#[expect(
    clippy::inline_always,
    reason = "`n` is a constant of the explicit scheme, which calls this in every step"
)]
pub(crate) fn diagonalize(n: usize, matrix: &mut [f64], axes: &mut [f64]) {
    for _ in 0..MOST_SWEEPS {
        let mut has_rotated = false;
        for i in 0..n {
            for j in i + 1..n {
                has_rotated |= rotate(n, matrix, axes, [i, j]);
            }
        }
        if !has_rotated {
            break;
        }
    }
}

/// Makes the entry of two axes zero by a rotation in their plane; false where it is rounding already.
#[inline(always)]
#[expect(clippy::inline_always, reason = "as above")]
fn rotate(n: usize, matrix: &mut [f64], axes: &mut [f64], [i, j]: [usize; 2]) -> bool {
    let entry = matrix[i * n + j];
    let [a, b] = [matrix[i * n + i], matrix[j * n + j]];
    if entry.abs() <= f64::EPSILON * f64::EPSILON * (a.abs() + b.abs()) {
        return false;
    }
    let ratio = (b - a) / (2.0 * entry);
    let tangent = ratio.signum() / (ratio.abs() + (ratio * ratio + 1.0).sqrt());
    let cosine = (tangent * tangent + 1.0).sqrt().recip();
    let sine = tangent * cosine;
    let turn = |all: &mut [f64], [i, j]: [usize; 2]| {
        let [x, y] = [all[i], all[j]];
        (all[i], all[j]) = (cosine * x - sine * y, sine * x + cosine * y);
    };
    for row in 0..n {
        turn(matrix, [row * n + i, row * n + j]);
    }
    for column in 0..n {
        let places = [i * n + column, j * n + column];
        turn(matrix, places);
        turn(axes, places);
    }
    (matrix[i * n + j], matrix[j * n + i]) = (0.0, 0.0);
    true
}

/// The unit matrix, row by row.
fn unit(n: usize) -> Vec<f64> {
    let mut unit = vec![0.0; n * n];
    for axis in 0..n {
        unit[axis * n + axis] = 1.0;
    }
    unit
}

/// The shortest x for which `|A x − b|` is least, with a symmetric row-major A that has no negative eigenvalues, of which
/// those up to `least` count as zero.
pub(crate) fn shortest_solution(a: &[f64], b: &[f64], least: f64) -> Vec<f64> {
    let n = b.len();
    let (mut matrix, mut axes) = (a.to_vec(), unit(n));
    diagonalize(n, &mut matrix, &mut axes);
    let mut solution = vec![0.0; n];
    for (at, axis) in axes.chunks_exact(n.max(1)).enumerate() {
        let eigenvalue = matrix[at * n + at];
        if eigenvalue > least {
            let part = axis.iter().zip(b).map(|(a, b)| a * b).sum::<f64>() / eigenvalue;
            for (x, a) in solution.iter_mut().zip(axis) {
                *x += part * a;
            }
        }
    }
    solution
}

#[cfg(test)]
mod tests {
    use super::*;

    fn is_near(found: &[f64], exact: &[f64]) -> bool {
        let mut pairs = found.iter().zip(exact);
        pairs.all(|(found, exact)| (found - exact).abs() < 1e-14)
    }

    #[test]
    fn a_regular_system_is_solved() {
        let a = [4.0, 1.0, 0.5, 1.0, 3.0, -0.25, 0.5, -0.25, 2.0];
        let x = shortest_solution(&a, &[7.5, 6.25, 6.0], 0.0);
        assert!(is_near(&x, &[1.0, 2.0, 3.0]), "{x:?}");
        assert!(shortest_solution(&[], &[], 0.0).is_empty());
    }

    // The projection of the unknowns on (1, 1).
    #[test]
    fn what_a_singular_system_leaves_open_is_zero() {
        let x = shortest_solution(&[1.0; 4], &[2.0, 4.0], 1e-8);
        assert!(is_near(&x, &[1.5; 2]), "{x:?}");
        assert!(is_near(
            &shortest_solution(&[0.0; 4], &[1.0; 2], 1e-8),
            &[0.0; 2]
        ));
    }
}
