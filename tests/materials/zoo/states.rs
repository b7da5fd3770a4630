//! States and steps at which specimens are examined.

use eem::invert;
use eem_testkit::length::at_length;

use crate::zoo::specimen::Specimen;

/// Parts of the way from the state to the ends of the home.
const PARTS: [f64; 4] = [0.0, 0.1, 0.35, 0.8];
/// Sizes of steps: parts of the same way, from nothing over far below rounding to half of it.
const INCREMENTS: [f64; 7] = [0.0, 1e-15, 1e-12, 1e-8, 1e-4, 1e-2, 0.5];

/// The state of the specimen moved by `part` of the way to the ends of its home, the variables in
/// turn upwards and downwards.
fn moved(specimen: &dyn Specimen, part: f64, first_up: bool) -> Vec<f64> {
    let pairs = specimen.state().iter().zip(specimen.home());
    let toward = |(i, (x, [low, high])): (usize, (&f64, &[f64; 2]))| {
        let end = if (i % 2 == 0) == first_up { high } else { low };
        x + part * (end - x)
    };
    pairs.enumerate().map(toward).collect()
}

/// States around that of the specimen.
pub(crate) fn around(specimen: &dyn Specimen) -> Vec<Vec<f64>> {
    let both = |part| [true, false].map(|up| moved(specimen, part, up));
    PARTS.into_iter().flat_map(both).collect()
}

/// Pairs of an old and a new state.
pub(crate) fn steps(specimen: &dyn Specimen) -> Vec<[Vec<f64>; 2]> {
    let increments = INCREMENTS.iter().step_by(at_length(1, 3));
    increments
        .map(|&increment| step(specimen, increment))
        .collect()
}

/// A step of one size.
pub(crate) fn step(specimen: &dyn Specimen, increment: f64) -> [Vec<f64>; 2] {
    [0.0, increment].map(|part| moved(specimen, part, true))
}

/// A temperature and what rounding may have done to it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Corner {
    pub(crate) theta: f64,
    pub(crate) error: f64,
}

/// The mixed states of a step, temperature last and not yet known, each with the pure state that
/// it takes its entropy from: of the ascending chain, then of the descending one.
pub(crate) fn mixed(x0: &[f64], x1: &[f64]) -> Vec<(Vec<f64>, Vec<f64>)> {
    let n = x0.len() - 1;
    let chain = |from: &[f64], to: &[f64]| -> Vec<_> {
        let corner = |k: usize| ([&to[..k], &from[k..]].concat(), from.to_vec());
        (1..=n).map(corner).collect()
    };
    [chain(x0, x1), chain(x1, x0)].concat()
}

/// The corner temperatures of the entropy form.
pub(crate) fn corners(specimen: &dyn Specimen, x0: &[f64], x1: &[f64]) -> Vec<Corner> {
    if !specimen.thermal() {
        return Vec::new();
    }
    let find = |(mut x, pure): (Vec<f64>, Vec<f64>)| {
        let last = x.len() - 1;
        let entropy = specimen.caloric(&pure).entropy;
        let evaluate = |theta: f64| {
            x[last] = theta;
            specimen.caloric(&x)
        };
        let found = invert(evaluate, entropy, pure[last]);
        let theta = found.expect("the corner exists").temperature;
        x[last] = theta;
        let at = specimen.caloric(&x);
        // The inversion meets the entropy to a few ε of its terms, and both entropies are rounded.
        let entropy_error = 8.0 * f64::EPSILON * (at.magnitude + specimen.caloric(&pure).magnitude);
        let error = theta * (entropy_error / at.heat_capacity + 2.0 * f64::EPSILON);
        Corner { theta, error }
    };
    mixed(x0, x1).into_iter().map(find).collect()
}
