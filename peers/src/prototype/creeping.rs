//! The thermo-visco-elastic pendulum in the plane.
//!
//! ```text
//! x = ln(λ/λ0),   ϑ = θ − θr,   k = k0 − k1 ϑ,   φ = k x − βt ϑ
//! ψ = (1 + βc)(k x²/2 − βt ϑ x + c (ϑ − θ ln(θ/θr))) + (μ0 − μ1 ϑ) γ² − βc γ φ/λ
//! f = ((1 + βc) φ − βc γ (k − φ)/λ)/λ,     g = βc φ/λ − 2 (μ0 − μ1 ϑ) γ,     η = η0 exp(a (1/θ − 1/θr))
//! s = (1 + βc)(k1 x²/2 + βt x + c ln(θ/θr)) + μ1 γ² − βc γ (k1 x + βt)/λ
//! s_λ = ((1 + βc)(k1 x + βt) − βc γ (k1 − k1 x − βt)/λ)/λ,     s_γ = 2 μ1 γ − βc (k1 x + βt)/λ
//! ```

use super::closing::temperature_factor;
use super::model::{Pendulum, Point};
use crate::single_pendulum as published;

const K0: f64 = published::SPRING.k0;
const K1: f64 = published::SPRING.k1;
const BETA_T: f64 = published::SPRING.thermal_coupling;
const BETA_C: f64 = published::SPRING.viscous_coupling;
const C: f64 = published::SPRING.capacity;
const MU0: f64 = published::SPRING.mu0;
const MU1: f64 = published::SPRING.mu1;
const ETA0: f64 = published::SPRING.eta0;
const A: f64 = published::SPRING.a;
const LENGTH: f64 = published::SPRING.natural_length;
const THETA_REF: f64 = published::SPRING.theta_ref;

/// (1 + βc) c, J/K.
const CAPACITY: f64 = (1.0 + BETA_C) * C;

/// ln θ is found when its last change is below this: the next one would be its square.
const LAST_CHANGE: f64 = 1e-8;
const MOST_ITERATIONS: usize = 20;

/// The case `single`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Single;

impl Pendulum<6, 3> for Single {
    const DIMENSION: usize = 2;
    const COUNT: usize = 1;
    const DASHPOTS: usize = 1;
    const MASSES: [f64; 2] = [1.0; 2];
    const CONDUCTANCE: f64 = published::CONDUCTANCE;

    #[inline(always)]
    fn at_temperature(_spring: usize, lambda: f64, gamma: f64, theta: f64) -> Point {
        point(1.0 / lambda, strain(lambda), gamma, theta)
    }

    #[inline(always)]
    fn at_entropy(_spring: usize, lambda: f64, gamma: f64, entropy: f64, guess: f64) -> Point {
        let (inverse, x) = (1.0 / lambda, strain(lambda));
        let constant = (1.0 + BETA_C) * (K1 / 2.0 * x * x + BETA_T * x) + MU1 * gamma * gamma
            - BETA_C * gamma * (K1 * x + BETA_T) * inverse;
        let (mut theta, mut logarithm) = (guess, (guess / THETA_REF).ln());
        for _ in 0..MOST_ITERATIONS {
            let change = (entropy - constant - CAPACITY * logarithm) / CAPACITY;
            logarithm += change;
            theta *= temperature_factor(change);
            if change.abs() < LAST_CHANGE {
                break;
            }
        }
        let heating = theta - THETA_REF;
        let k = K0 - K1 * heating;
        let elastic = k / 2.0 * x * x - BETA_T * heating * x + C * (heating - theta * logarithm);
        let viscous = (MU0 - MU1 * heating) * gamma * gamma;
        let mixed = BETA_C * gamma * (k * x - BETA_T * heating) * inverse;
        Point {
            energy: (1.0 + BETA_C) * elastic + viscous - mixed + theta * entropy,
            ..point(inverse, x, gamma, theta)
        }
    }

    fn entropy(_spring: usize, lambda: f64, gamma: f64, theta: f64) -> f64 {
        let x = strain(lambda);
        (1.0 + BETA_C) * (K1 / 2.0 * x * x + BETA_T * x + C * (theta / THETA_REF).ln())
            + MU1 * gamma * gamma
            - BETA_C * gamma * (K1 * x + BETA_T) / lambda
    }

    fn start() -> [f64; 6] {
        [3.0, 0.0, 0.0, 1.0, 0.0, 380.0]
    }
}

#[inline(always)]
fn strain(lambda: f64) -> f64 {
    (lambda / LENGTH).ln()
}

/// All but the energy, from 1/λ and x.
#[inline(always)]
fn point(inverse: f64, x: f64, gamma: f64, theta: f64) -> Point {
    let heating = theta - THETA_REF;
    let k = K0 - K1 * heating;
    let phi = k * x - BETA_T * heating;
    let softening = K1 * x + BETA_T;
    Point {
        force: ((1.0 + BETA_C) * phi - BETA_C * gamma * (k - phi) * inverse) * inverse,
        dashpot_force: -2.0 * (MU0 - MU1 * heating) * gamma + BETA_C * phi * inverse,
        viscosity: ETA0 * (A * (1.0 / theta - 1.0 / THETA_REF)).exp(),
        entropy_by_lambda: ((1.0 + BETA_C) * softening
            - BETA_C * gamma * (K1 - K1 * x - BETA_T) * inverse)
            * inverse,
        entropy_by_gamma: 2.0 * MU1 * gamma - BETA_C * softening * inverse,
        capacity: CAPACITY,
        theta,
        energy: 0.0,
    }
}
