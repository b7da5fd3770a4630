//! Orders of convergence: how errors depend on the step.

use eem::prelude::*;

use super::reference;

/// The row of an exact trajectory at a time, s.
pub fn exact_row(case: &str, end: f64) -> Vec<f64> {
    let mut rows = reference(&format!("{case}_exact.csv")).into_iter();
    rows.find(|row| row[0] >= end).unwrap()
}

/// Equal steps up to a time that they hit, s.
pub fn step_to<const D: usize>(run: &mut Simulation<D>, end: f64) {
    while run.time() < end - 0.5 * run.step_size() {
        run.step().unwrap();
    }
}

/// The slope of the logarithms of errors over those of steps, each half the one before.
pub fn slope(errors: &[f64]) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "a handful of points")]
    let middle = (errors.len() - 1) as f64 / 2.0;
    let (mut above, mut below, mut x) = (0.0, 0.0, middle);
    for error in errors {
        above += x * error.log2();
        below += x * x;
        x -= 1.0;
    }
    above / below
}
