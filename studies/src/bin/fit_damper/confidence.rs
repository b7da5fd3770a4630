//! How well the unknowns are known: fits of fresh noise, and the covariance of the linearised model.

use std::error::Error;

use eem::nalgebra::Matrix3;

use super::drive::{Laws, Logs};
use super::fit::{Data, Fit};
use super::real;
use super::recording::Recording;
use eem_studies::progress::Progress;

/// Seed of the first fresh noise; the others follow.
const SEED: u64 = 1000;

/// Fits of recordings that the found damper could have left (the parametric bootstrap).
#[derive(Debug)]
pub(crate) struct Bootstrap {
    pub(crate) estimates: Vec<Logs>,
    /// How many fits have not converged.
    pub(crate) failed: usize,
    pub(crate) points: usize,
    pub(crate) laws: Laws,
}

impl Bootstrap {
    /// So many fits, from the found one on.
    pub(crate) fn run(data: Data<'_>, fit: &Fit, members: usize) -> Result<Self, Box<dyn Error>> {
        let mut progress = Progress::new("fits of fresh noise", members);
        let mut bootstrap = Self {
            estimates: Vec::new(),
            failed: 0,
            points: 0,
            laws: Laws::NONE,
        };
        for (member, seed) in (0..members).zip(SEED..) {
            let noise = data.recording.travel_noise;
            let recording = Recording::of(&fit.point.drive, noise, seed);
            let fresh = Data {
                recording: &recording,
                ..data
            };
            let again = Fit::again(fresh, &fit.point)?;
            bootstrap.failed += usize::from(!again.converged);
            bootstrap.points += again.points;
            bootstrap.laws = bootstrap.laws.and(again.laws);
            bootstrap.estimates.push(again.point.logs);
            progress.advance(member + 1);
        }
        Ok(bootstrap)
    }

    /// The estimates' standard deviations, without bias in their squares.
    pub(crate) fn deviations(&self) -> Logs {
        let count = real(self.estimates.len());
        [0, 1, 2].map(|unknown| {
            let values = self.estimates.iter().map(|logs| logs[unknown]);
            let mean = values.clone().sum::<f64>() / count;
            let squares = values.map(|value| (value - mean).powi(2));
            (squares.sum::<f64>() / (count - 1.0)).sqrt()
        })
    }
}

/// Standard deviations of a covariance.
pub(crate) fn deviations(covariance: &Matrix3<f64>) -> Logs {
    [0, 1, 2].map(|unknown| covariance[(unknown, unknown)].sqrt())
}

/// Between which factors of the true one a standard deviation of so many samples lies with a confidence of four
/// standard deviations.
///
/// With ν = M − 1, ν s²/σ² is distributed as χ², and `(s²/σ²)^⅓` almost normally with the mean 1 − 2/(9ν) and the
/// variance 2/(9ν): Wilson & Hilferty, PNAS 17 (1931) 684–688.
pub(crate) fn spread(samples: usize) -> [f64; 2] {
    let variance = 2.0 / (9.0 * (real(samples) - 1.0));
    let at = |deviations: f64| {
        let root = 1.0 - variance + deviations * variance.sqrt();
        root.max(0.0).powf(1.5)
    };
    [at(-4.0), at(4.0)]
}

/// The outline of the region that has 95 % of the estimates of two unknowns, as logarithms off those found.
///
/// ```text
/// ln p − ln p̂ = r (cos φ a + sin φ b),   r² = −2 ln 0.05,   (a b)(a b)ᵀ = C
/// ```
pub(crate) fn ellipse(covariance: &Matrix3<f64>, [x, y]: [usize; 2]) -> Vec<(f64, f64)> {
    const PARTS: u32 = 120;
    let radius = (-2.0 * 0.05_f64.ln()).sqrt();
    let first = covariance[(x, x)].sqrt();
    let along = covariance[(x, y)] / first;
    let across = (covariance[(y, y)] - along.powi(2)).max(0.0).sqrt();
    let point = |part: u32| {
        let (sine, cosine) = (std::f64::consts::TAU * f64::from(part) / f64::from(PARTS)).sin_cos();
        let (u, v) = (first * cosine, along * cosine + across * sine);
        (radius * u, radius * v)
    };
    (0..=PARTS).map(point).collect()
}
