//! Error over wall time, with the settings that no other beats, over the step, and over the tolerance.

use std::error::Error;
use std::path::Path;

use eem::{Scheme, StudyReport, StudyRow};

use eem_studies::comparison;
use eem_studies::figures::look::{BAND, OPEN};
use eem_studies::figures::{Axes, Curve, Figure};

/// Errors above it are drawn as failures: what is off by its own size ten times is no solution.
const LOST: f64 = 10.0;

/// Failures of one scheme are drawn by this factor above those of the one before, so that they do not hide each
/// other.
const ROW: f64 = 1.8;

/// Draws the pictures: error over wall time, over the step, over the tolerance.
pub(crate) fn write(
    directory: &Path,
    case: &str,
    report: &StudyReport,
) -> Result<(), Box<dyn Error>> {
    let end = report.end;
    // Of a scheme that chooses its steps, these; of all others those of one size.
    let controlled = report.rows.iter().filter(|row| is_controlled(row));
    let controlled: Vec<Scheme> = controlled.map(|row| row.setting.scheme).collect();
    let is_shown = |row: &StudyRow| is_controlled(row) || !controlled.contains(&row.setting.scheme);
    let by_time = Figure {
        title: format!("{case}: largest error at {end} s and wall time"),
        x_label: "wall time of the steps (s)".to_owned(),
        y_label: "largest relative error".to_owned(),
        curves: curves(report, |row| is_shown(row).then_some(row.seconds), true),
        axes: Axes::DoublyLogarithmic,
    };
    by_time.write_svg(&directory.join("work_precision.svg"))?;
    let by_step = Figure {
        title: format!("{case}: largest error at {end} s and step"),
        x_label: "step h (s)".to_owned(),
        curves: curves(report, |row| row.setting.step(), false),
        ..by_time.clone()
    };
    by_step.write_svg(&directory.join("step_error.svg"))?;
    if controlled.is_empty() {
        return Ok(());
    }
    let by_tolerance = Figure {
        title: format!("{case}: largest error at {end} s and tolerance"),
        x_label: "relative tolerance".to_owned(),
        curves: curves(report, |row| row.setting.tolerance(), false),
        ..by_time
    };
    by_tolerance.write_svg(&directory.join("tolerance_error.svg"))
}

fn is_controlled(row: &StudyRow) -> bool {
    row.setting.tolerance().is_some()
}

/// The largest error of a row, if it is stated and the run went somewhere near the solution.
fn error(row: &StudyRow) -> Option<f64> {
    let stated = row.largest_error().stated();
    stated.filter(|&error| error <= LOST)
}

/// Whether a run has no solution at the end.
fn is_lost(row: &StudyRow) -> bool {
    let error = row.largest_error().stated();
    row.failure.is_some() || error.is_some_and(|error| error.is_nan() || error > LOST)
}

/// The front if it is wanted, a curve for every scheme, and what failed.
fn curves(
    report: &StudyReport,
    x: impl Fn(&StudyRow) -> Option<f64> + Copy,
    with_front: bool,
) -> Vec<Curve> {
    let point = |row: &StudyRow| Some((x(row)?, error(row)?));
    let mut curves = Vec::new();
    if with_front {
        let front = report.front().into_iter().filter_map(point).collect();
        curves.push(curve("Pareto front".to_owned(), front, BAND));
    }
    let mut lines: Vec<String> = report.rows.iter().map(|row| row.setting.line()).collect();
    lines.dedup();
    for line in &lines {
        let rows = report.rows.iter().filter(|row| row.setting.line() == *line);
        let points: Vec<_> = rows.filter_map(point).collect();
        if !points.is_empty() {
            curves.push(curve(line.clone(), points, look(line)));
        }
    }
    curves.extend(failures(report, &lines, x));
    curves
}

/// Open circles above all curves, at the x of what failed, and what the legend says of them.
fn failures(
    report: &StudyReport,
    lines: &[String],
    x: impl Fn(&StudyRow) -> Option<f64> + Copy,
) -> Vec<Curve> {
    let largest = report.rows.iter().filter_map(error).fold(0.0, f64::max);
    let mut height = ROW * largest.max(1.0);
    let mut curves = Vec::new();
    for line in lines {
        let rows = report.rows.iter().filter(|row| row.setting.line() == *line);
        let lost = rows.filter(|row| is_lost(row));
        let points: Vec<_> = lost.filter_map(|row| Some((x(row)?, height))).collect();
        if !points.is_empty() {
            curves.push(curve(String::new(), points, OPEN + look(line)));
            height *= ROW;
        }
    }
    if !curves.is_empty() {
        let label = format!("failed, or off by > {LOST}");
        curves.push(curve(label, Vec::new(), OPEN));
    }
    curves
}

/// That of the scheme, whether it chooses its steps or not.
fn look(line: &str) -> usize {
    let name = line.split_once(',').map_or(line, |(name, _)| name);
    comparison::look(name)
}

fn curve(label: String, points: Vec<(f64, f64)>, look: usize) -> Curve {
    Curve {
        label,
        points,
        look,
        trusted: true,
        decisive: usize::MAX,
    }
}
