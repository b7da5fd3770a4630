//! Dense elimination with row pivots.

/// x with A x = b. Not finite if A is singular.
pub(super) fn solve(mut a: [[f64; 8]; 8], mut b: [f64; 8]) -> [f64; 8] {
    for k in 0..8 {
        let mut pivot = k;
        for i in k + 1..8 {
            if a[i][k].abs() > a[pivot][k].abs() {
                pivot = i;
            }
        }
        a.swap(k, pivot);
        b.swap(k, pivot);
        let (row, inverse) = (a[k], 1.0 / a[k][k]);
        for i in k + 1..8 {
            let factor = a[i][k] * inverse;
            for j in k + 1..8 {
                a[i][j] -= factor * row[j];
            }
            b[i] -= factor * b[k];
        }
    }
    for i in (0..8).rev() {
        for j in i + 1..8 {
            b[i] -= a[i][j] * b[j];
        }
        b[i] /= a[i][i];
    }
    b
}
