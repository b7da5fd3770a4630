//! Tangents of steps against differences.

use eem::prelude::*;

/// Columns of the tangent of a step at these unknowns are what differences of fourth order of its residual say, to `bound` of the
/// largest entry of a row; an unknown is moved by `width` of its column.
pub fn assert_tangent<const D: usize>(
    run: &mut Simulation<D>,
    at: &[f64],
    columns: impl IntoIterator<Item = usize>,
    (width, bound): (impl Fn(usize) -> f64, f64),
) {
    let exact = run.linearize(at).unwrap().tangent;
    for column in columns {
        let width = width(column);
        let mut residual = |shift: f64| {
            let mut moved = at.to_vec();
            moved[column] += shift * width;
            run.linearize(&moved).unwrap().residual
        };
        let [a, b, c, d] = [-2.0, -1.0, 1.0, 2.0].map(&mut residual);
        for (row, entries) in exact.chunks(at.len()).enumerate() {
            let slope = (a[row] - 8.0 * b[row] + 8.0 * c[row] - d[row]) / (12.0 * width);
            let size = entries
                .iter()
                .fold(0.0_f64, |most, entry| most.max(entry.abs()));
            let error = (slope - entries[column]).abs() / size;
            let scheme = run.scheme();
            assert!(error <= bound, "{scheme}, ({row}, {column}): {error:e}");
        }
    }
}
