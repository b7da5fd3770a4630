//! The size of steps for a tolerance.
//!
//! Hairer's estimate of the error in units of the tolerance, and the factor by which the step changes:
//!
//! ```text
//! err = e₅²/√(e₅² + 0.01 e₃²),     factor = 0.8 err^(−0.095) err_before^0.04
//! ```

use super::model::Pendulum;
use super::run::Run;

/// Aimed at, in units of the tolerance, but for the power.
const SAFETY: f64 = 0.8;
/// Power of the error of the step before.
const MEMORY: f64 = 0.04;
const ORDER: f64 = 8.0;
/// The error of the step before counts as no less.
const LEAST_ERROR: f64 = 1e-4;
/// A run with more steps, or smaller ones, is given up.
const MOST_STEPS: u32 = 10_000_000;
const LEAST_STEP: f64 = 1e-14;

/// The error of the change to y by a step of size h, in units of the tolerance.
#[inline(always)]
pub(super) fn error<C: Pendulum<N, X>, const N: usize, const X: usize>(
    run: &mut Run<C, N, X>,
    h: f64,
    y: &[f64; N],
    tolerance: f64,
) -> f64 {
    let errors = run.stages.errors(h);
    run.largest_momentum = norm(&y[C::P..C::GAMMA]).max(run.largest_momentum);
    let by_position = 1.0 / (tolerance * norm(&y[..C::P]));
    let by_momentum = 1.0 / (tolerance * run.largest_momentum);
    let mut squares = [0.0; 2];
    for (square, errors) in squares.iter_mut().zip(&errors) {
        for (i, error) in errors.iter().enumerate() {
            let unit = if i < C::P {
                by_position
            } else if i < C::GAMMA {
                by_momentum
            } else if i < C::THETA {
                by_position
            } else {
                1.0 / (tolerance * run.y[i])
            };
            let error = error * unit;
            *square += error * error;
        }
    }
    let [fifth, third] = squares;
    // The last term: 0/0 of a state at rest is no error.
    fifth / (fifth + 0.01 * third + 1e-300).sqrt()
}

impl<C: Pendulum<N, X>, const N: usize, const X: usize> Run<C, N, X> {
    /// Steps of controlled size up to `end`, s; false if they get too small or too many.
    pub(crate) fn run_until(&mut self, end: f64, tolerance: f64) -> bool {
        let mut step = self.first_step(tolerance);
        let (mut last_error, mut was_rejected) = (LEAST_ERROR, false);
        for _ in 0..MOST_STEPS {
            let rest = end - self.time;
            if rest <= 0.0 {
                return true;
            }
            if step < LEAST_STEP {
                return false;
            }
            let size = shortened(step, rest);
            match self.step(size, Some(tolerance)) {
                Ok(error) => {
                    let exponent = 0.75 * MEMORY - 1.0 / ORDER;
                    let factor = SAFETY * (error + 1e-30).powf(exponent) * last_error.powf(MEMORY);
                    let most = if was_rejected { 1.0 } else { 6.0 };
                    step = size * factor.clamp(0.333, 6.0).min(most);
                    (last_error, was_rejected) = (error.max(LEAST_ERROR), false);
                    if size.to_bits() == rest.to_bits() {
                        self.time = end;
                    }
                }
                Err(error) => {
                    let factor = if error.is_finite() {
                        (SAFETY * error.powf(-1.0 / ORDER)).clamp(0.2, 1.0)
                    } else {
                        0.25
                    };
                    step = size * factor;
                    was_rejected = true;
                }
            }
        }
        false
    }

    /// From the times that positions take to change, s.
    fn first_step(&self, tolerance: f64) -> f64 {
        let rates = &self.stages.y[0];
        let position = norm(&self.y[..C::P]);
        let mut acceleration = 0.0;
        for (i, force) in rates[C::P..C::GAMMA].iter().enumerate() {
            acceleration += (force / C::MASSES[i / C::DIMENSION]).powi(2);
        }
        let by_acceleration = (position / acceleration.sqrt()).sqrt();
        let by_velocity = position / norm(&rates[..C::P]);
        1.5 * by_acceleration.min(by_velocity) * tolerance.powf(1.0 / (ORDER + 1.0))
    }
}

/// A step that does not leave a tiny rest.
fn shortened(step: f64, rest: f64) -> f64 {
    if step * 1.000_001 >= rest {
        rest
    } else if step * 2.0 > rest {
        0.5 * rest
    } else {
        step
    }
}

#[inline(always)]
fn norm(values: &[f64]) -> f64 {
    let mut squared = 0.0;
    for value in values {
        squared += value * value;
    }
    squared.sqrt()
}
