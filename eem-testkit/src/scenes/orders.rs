//! Orders of convergence: how errors depend on the step.

use eem::prelude::*;

use super::{DoublePendulum, reference};

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

/// The largest error of q, p and θ of a double pendulum at a time of the reference, relative to their sizes.
pub fn double_error(case: &DoublePendulum, scheme: Scheme, step: f64, end: f64) -> f64 {
    let exact = exact_row(&format!("double_pendulum_{}", case.name), end);
    let mut pendulum = case.simulation(scheme, step);
    step_to(&mut pendulum.run, end);
    let norm = |x: &[f64]| x.iter().map(|x| x * x).sum::<f64>().sqrt();
    let row = pendulum.row();
    let errors = [0..6, 6..12, 12..14].map(|part| {
        let difference = row[part.clone()].iter().zip(&exact[1..][part.clone()]);
        let difference: Vec<_> = difference.map(|(x, exact)| x - exact).collect();
        norm(&difference) / norm(&exact[1..][part])
    });
    errors.into_iter().fold(0.0, f64::max)
}

/// The solution of `ż = rate(z)` at `end`, s, by the classical Runge–Kutta method.
pub fn runge_kutta<const N: usize>(
    rate: impl Fn(&[f64; N]) -> [f64; N],
    mut z: [f64; N],
    end: f64,
    steps: u32,
) -> [f64; N] {
    let h = end / f64::from(steps);
    for _ in 0..steps {
        let along = |k: &[f64; N], c: f64| core::array::from_fn(|i| z[i] + c * h * k[i]);
        let k1 = rate(&z);
        let k2 = rate(&along(&k1, 0.5));
        let k3 = rate(&along(&k2, 0.5));
        let k4 = rate(&along(&k3, 1.0));
        z = core::array::from_fn(|i| z[i] + h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]));
    }
    z
}
