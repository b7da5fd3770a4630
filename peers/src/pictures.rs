//! The library's lines and those of the peers in one picture: error over wall time, and energy defect over error.

use std::error::Error;
use std::path::Path;

use crate::rows::Row;
use crate::summary::lines;
use eem_studies::comparison;
use eem_studies::figures::look::OPEN;
use eem_studies::figures::{Axes, Curve, Figure};

/// Errors above it are not drawn: what is off by its own size ten times is no solution.
const LOST: f64 = 10.0;

/// A quarter of a rounding error stands for no energy defect at all.
const NO_DEFECT: f64 = 0.25 * f64::EPSILON;

/// Draws both pictures.
pub(crate) fn write(
    directory: &Path,
    case: &str,
    end: f64,
    rows: &[Row],
) -> Result<(), Box<dyn Error>> {
    let by_time = Figure {
        title: format!("{case}: largest error at {end} s and wall time"),
        x_label: "wall time of the steps (s)".to_owned(),
        y_label: "largest relative error".to_owned(),
        curves: curves(rows, |row| Some((row.seconds?, error(row)?))),
        axes: Axes::DoublyLogarithmic,
    };
    by_time.write_svg(&directory.join("work_precision_peers.svg"))?;
    let drift = Figure {
        title: format!("{case}: energy defect up to {end} s and largest error"),
        x_label: "largest relative error".to_owned(),
        y_label: "largest relative energy defect".to_owned(),
        curves: curves(rows, |row| {
            Some((error(row)?, row.energy_defect?.max(NO_DEFECT)))
        }),
        ..by_time
    };
    drift.write_svg(&directory.join("energy_drift_peers.svg"))
}

fn error(row: &Row) -> Option<f64> {
    row.largest_error.filter(|&error| error <= LOST)
}

/// A curve for every line.
fn curves(rows: &[Row], point: impl Fn(&Row) -> Option<(f64, f64)>) -> Vec<Curve> {
    let curve = |line: String| {
        let rows = rows.iter().filter(|row| row.line() == line);
        Curve {
            points: rows.filter_map(&point).collect(),
            look: look(&line),
            label: line,
            trusted: true,
            decisive: usize::MAX,
        }
    };
    lines(rows).into_iter().map(curve).collect()
}

/// A peer has a look that no scheme has: a colour per variables, a line if it is explicit, circles if it is not.
fn look(line: &str) -> usize {
    let [black, green] = [0, comparison::look_beside_schemes(0)];
    match line {
        "dop853 entropy" => black,
        "dop853 temperature" => green,
        "bdf entropy" => OPEN + black,
        "bdf temperature" => OPEN + green,
        scheme => comparison::look(scheme.trim_end_matches(", controlled")),
    }
}
