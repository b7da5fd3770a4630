//! Whether a symmetric matrix is positive definite, from its factors.
//!
//! ```text
//! A > 0   ⇔   the diagonal block A₁₁ of every front, when its turn comes, is positive definite
//! ```
//!
//! as each front leaves the Schur complement of its block to the later ones (Haynsworth 1968). Without exchanged rows,
//! the pivots of a block are the diagonal of U; otherwise the block is multiplied out, and Cholesky's method decides.

/// Whether the diagonal block of a front with these factors is positive definite. `columns` are those of L with the
/// diagonal block, of `tall` rows; `work` is overwritten.
pub(crate) fn block_is_positive_definite(
    columns: &[f64],
    tall: usize,
    pivots: &[u32],
    work: &mut Vec<f64>,
) -> bool {
    let width = pivots.len();
    let entry = |row: usize, column: usize| columns[column * tall + row];
    if (0..).zip(pivots).all(|(row, &pivot)| row == pivot) {
        return (0..width).all(|k| entry(k, k) > 0.0);
    }
    work.clear();
    work.resize(width * width, 0.0);
    for (row, &pivot) in pivots.iter().enumerate() {
        for column in 0..width {
            let mut sum = if row <= column {
                entry(row, column)
            } else {
                0.0
            };
            for k in 0..row.min(column + 1) {
                sum += entry(row, k) * entry(k, column);
            }
            work[pivot as usize * width + column] = sum;
        }
    }
    has_cholesky_factor(work, width)
}

/// Whether Cholesky's method goes through for a symmetric matrix, of which it uses and overwrites the lower half.
fn has_cholesky_factor(matrix: &mut [f64], width: usize) -> bool {
    for row in 0..width {
        let (above, own) = matrix.split_at_mut(row * width);
        for column in 0..=row {
            let (known, rest) = own.split_at_mut(column);
            let other = if column < row {
                &above[column * width..][..column]
            } else {
                &*known
            };
            let sum: f64 = known.iter().zip(other).map(|(a, b)| a * b).sum();
            let left = rest[0] - sum;
            if column < row {
                rest[0] = left / above[column * width + column];
            } else if left > 0.0 {
                rest[0] = left.sqrt();
            } else {
                return false;
            }
        }
    }
    true
}
