//! Wall times at equal errors.
//!
//! A solver hits an error by luck: single points scatter by a factor of a few. The time for an error is therefore
//! that of a straight line through the points around it, in logarithms.

use std::fmt::Write;

use crate::rows::Row;

/// The errors of the table.
const ERRORS: [f64; 3] = [1e-3, 1e-6, 1e-9];

/// Points within so many decades of an error count, and the nearest on either side.
const DECADES: f64 = 1.6;

/// The table of all lines, µs.
pub(crate) fn table(rows: &[Row]) -> String {
    let mut text = "µs for a largest error of 1e-3, 1e-6, 1e-9:\n".to_owned();
    for line in lines(rows) {
        let points = points(rows, &line);
        let cells = ERRORS.map(|error| {
            let time = time_for(&points, error);
            time.map_or_else(|| "–".to_owned(), |time| format!("{:.0}", 1e6 * time))
        });
        let [first, second, third] = cells;
        let _infallible = writeln!(text, "{line:<28} {first:>9} {second:>9} {third:>9}");
    }
    text
}

/// The names of all lines, in the order of the rows.
pub(crate) fn lines(rows: &[Row]) -> Vec<String> {
    let mut lines: Vec<String> = rows.iter().map(Row::line).collect();
    lines.dedup();
    lines
}

/// Errors and times of a line.
fn points(rows: &[Row], line: &str) -> Vec<(f64, f64)> {
    let rows = rows.iter().filter(|row| row.line() == line);
    rows.filter_map(|row| Some((row.largest_error?, row.seconds?)))
        .collect()
}

/// The time for an error, by the line of least squares through the points around it; none unless there are points
/// on both sides.
pub(crate) fn time_for(points: &[(f64, f64)], error: f64) -> Option<f64> {
    let distances = points
        .iter()
        .map(|&(at, time)| ((at / error).log10(), time.log10()));
    let distances: Vec<(f64, f64)> = distances.collect();
    let nearest = |sign: f64| {
        let sided = distances.iter().map(|(distance, _)| sign * distance);
        sided.filter(|&distance| distance >= 0.0).reduce(f64::min)
    };
    let (above, below) = (nearest(1.0)?, nearest(-1.0)?);
    let counts =
        |(distance, _): &&(f64, f64)| (-below.max(DECADES)..=above.max(DECADES)).contains(distance);
    let near: Vec<&(f64, f64)> = distances.iter().filter(counts).collect();
    if near.len() < 2 {
        return None;
    }
    let mut sums = [0.0; 5];
    for &&(x, y) in &near {
        for (sum, term) in sums.iter_mut().zip([1.0, x, y, x * x, x * y]) {
            *sum += term;
        }
    }
    let [n, x, y, xx, xy] = sums;
    let slope = (n * xy - x * y) / (n * xx - x * x);
    Some(10.0_f64.powf((y - slope * x) / n))
}
