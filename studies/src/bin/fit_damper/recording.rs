//! A recorded ride: the truth with the noise of both sensors.

use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use std::f64::consts::TAU;

use super::drive::Drive;

/// Standard deviation of the displacement's noise, as a share of the travel's root mean square about its mean.
const TRAVEL_NOISE: f64 = 0.01;

/// Standard deviation of the thermometer's noise, K.
pub(crate) const TEMPERATURE_NOISE: f64 = 0.5;

/// What both sensors have recorded at times of equal distance.
#[derive(Clone, Debug)]
pub(crate) struct Recording {
    /// Travel of the suspension, m.
    pub(crate) travel: Vec<f64>,
    /// Temperature of the damper, K.
    pub(crate) temperature: Vec<f64>,
    /// The travel's noise, m: the maker of the sensor says it.
    pub(crate) travel_noise: f64,
}

/// The noise of the displacement sensor for a ride like this one, m.
pub(crate) fn travel_noise(drive: &Drive) -> f64 {
    let count = super::real(drive.travel.len());
    let mean = drive.travel.iter().sum::<f64>() / count;
    let squares = drive.travel.iter().map(|value| (value - mean).powi(2));
    TRAVEL_NOISE * (squares.sum::<f64>() / count).sqrt()
}

impl Recording {
    /// What sensors show of a drive; the same seed draws the same noise.
    pub(crate) fn of(drive: &Drive, travel_noise: f64, seed: u64) -> Self {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let mut noisy = |values: &[f64], noise: f64| {
            let values = values.iter();
            values
                .map(|value| value + noise * normal(&mut random))
                .collect()
        };
        Self {
            travel: noisy(&drive.travel, travel_noise),
            temperature: noisy(&drive.temperature, TEMPERATURE_NOISE),
            travel_noise,
        }
    }

    /// Model minus recording in standard deviations of the noise, first of all displacements, then of all
    /// temperatures.
    pub(crate) fn residuals(&self, drive: &Drive) -> Vec<f64> {
        let off = |model: &[f64], seen: &[f64]| {
            let pairs = model.iter().zip(seen);
            pairs.map(|(model, seen)| model - seen).collect()
        };
        self.in_deviations(&[
            off(&drive.travel, &self.travel),
            off(&drive.temperature, &self.temperature),
        ])
    }

    /// Differences of displacements and temperatures in standard deviations of the noise.
    pub(crate) fn in_deviations(&self, [travel, temperature]: &[Vec<f64>; 2]) -> Vec<f64> {
        let travel = travel.iter().map(|off| off / self.travel_noise);
        let temperature = temperature.iter().map(|off| off / TEMPERATURE_NOISE);
        travel.chain(temperature).collect()
    }

    /// How many numbers were recorded.
    pub(crate) fn len(&self) -> usize {
        self.travel.len() + self.temperature.len()
    }
}

/// A number of the standard normal distribution, by Box & Muller (1958).
fn normal(random: &mut ChaCha8Rng) -> f64 {
    let (a, b): (f64, f64) = (random.random(), random.random());
    (-2.0 * (1.0 - a).ln()).sqrt() * (TAU * b).cos()
}
