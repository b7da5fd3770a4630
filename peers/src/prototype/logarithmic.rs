//! Thermoelastic double pendulums in space, their springs in thermal contact.
//!
//! ```text
//! x = ln(λ/λ0),   ϑ = θ − θr,   C = C0 − C1 θr ln(θ/θr),   a = C1 θr/θ
//! ψ = C x²/2 − β ϑ x + c0 (ϑ − θ ln(θ/θr))
//! f = (C x − β ϑ)/λ,     s = a x²/2 + β x + c0 ln(θ/θr),     s_λ = (a x + β)/λ,     c = c0 − a x²/2
//! ```

use core::marker::PhantomData;

use super::closing::temperature_factor;
use super::model::{Pendulum, Point};
use crate::double_pendulum::{Case, KRUEGER, LOG, ThermoelasticSpring};

/// ln θ is found when its last change is below this: the next one would be its square.
const LAST_CHANGE: f64 = 1e-8;
const MOST_ITERATIONS: usize = 20;

/// Published data.
pub(crate) trait Data {
    const CASE: Case;
}

/// Of the case `krueger`: C1 = 0, no logarithm of θ in a stage.
#[derive(Clone, Copy, Debug)]
pub(crate) struct OfKrueger;

/// Of the case `log`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct OfLog;

impl Data for OfKrueger {
    const CASE: Case = KRUEGER;
}

impl Data for OfLog {
    const CASE: Case = LOG;
}

/// A double pendulum.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Double<T>(PhantomData<T>);

/// The case `krueger`.
pub(crate) type Krueger = Double<OfKrueger>;

/// The case `log`.
pub(crate) type Log = Double<OfLog>;

impl<T: Data> Pendulum<14, 2> for Double<T> {
    const DIMENSION: usize = 3;
    const COUNT: usize = 2;
    const DASHPOTS: usize = 0;
    const MASSES: [f64; 2] = T::CASE.masses;
    const CONDUCTANCE: f64 = T::CASE.conductance;

    #[inline(always)]
    fn at_temperature(spring: usize, lambda: f64, _gamma: f64, theta: f64) -> Point {
        let law = &T::CASE.springs[spring];
        let modulus = if law.softening == 0.0 {
            law.stiffness
        } else {
            law.stiffness - law.softening * law.theta_ref * (theta * (1.0 / law.theta_ref)).ln()
        };
        point(law, 1.0 / lambda, strain(law, lambda), theta, modulus)
    }

    #[inline(always)]
    fn at_entropy(spring: usize, lambda: f64, _gamma: f64, entropy: f64, guess: f64) -> Point {
        let law = &T::CASE.springs[spring];
        let x = strain(law, lambda);
        let half_squared = 0.5 * x * x;
        let rest = entropy - law.coupling * x;
        let (mut theta, mut logarithm) = (guess, (guess * (1.0 / law.theta_ref)).ln());
        for _ in 0..MOST_ITERATIONS {
            let elastic = slope(law, theta) * half_squared;
            let change = (rest - elastic - law.capacity * logarithm) / (law.capacity - elastic);
            logarithm += change;
            theta *= temperature_factor(change);
            if change.abs() < LAST_CHANGE {
                break;
            }
        }
        let modulus = law.stiffness - law.softening * law.theta_ref * logarithm;
        let heating = theta - law.theta_ref;
        let thermal = law.capacity * (heating - theta * logarithm);
        Point {
            energy: modulus * half_squared - law.coupling * heating * x + thermal + theta * entropy,
            ..point(law, 1.0 / lambda, x, theta, modulus)
        }
    }

    fn entropy(spring: usize, lambda: f64, _gamma: f64, theta: f64) -> f64 {
        let law = &T::CASE.springs[spring];
        let x = (lambda / law.natural_length).ln();
        law.softening * law.theta_ref / theta / 2.0 * x * x
            + law.coupling * x
            + law.capacity * (theta / law.theta_ref).ln()
    }

    fn start() -> [f64; 14] {
        let Case {
            positions,
            momenta,
            temperatures,
            ..
        } = T::CASE;
        let mut y = [0.0; 14];
        y[..6].copy_from_slice(positions.as_flattened());
        y[6..12].copy_from_slice(momenta.as_flattened());
        y[12..].copy_from_slice(&temperatures);
        y
    }
}

#[inline(always)]
fn strain(law: &ThermoelasticSpring, lambda: f64) -> f64 {
    (lambda * (1.0 / law.natural_length)).ln()
}

/// a = −∂C/∂θ, J/K.
#[inline(always)]
fn slope(law: &ThermoelasticSpring, theta: f64) -> f64 {
    if law.softening == 0.0 {
        0.0
    } else {
        law.softening * law.theta_ref / theta
    }
}

/// All but the energy, from 1/λ, x and C.
#[inline(always)]
fn point(law: &ThermoelasticSpring, inverse: f64, x: f64, theta: f64, modulus: f64) -> Point {
    let slope = slope(law, theta);
    Point {
        force: (modulus * x - law.coupling * (theta - law.theta_ref)) * inverse,
        dashpot_force: 0.0,
        viscosity: 1.0,
        entropy_by_lambda: (slope * x + law.coupling) * inverse,
        entropy_by_gamma: 0.0,
        capacity: law.capacity - slope * 0.5 * x * x,
        theta,
        energy: 0.0,
    }
}
