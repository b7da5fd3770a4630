//! Formulas with helpers and constants, as the derive inlines them and as closures of Rust.

use std::f64::consts::PI;

use crate::zoo::number::{cosh, exp, ln};
use crate::zoo::specimen::specimen;

specimen! {
    /// Two branches of one form, and a heat capacity with a helper that calls another.
    Branches {
        k: 20.0, k_fast: 5.0, k_slow: 7.0, length: 1.1, capacity: 2.0, theta_ref: 290.0, eta: 4.0,
        activation: 900.0,
    }
    (
        lambda: Stretch = 1.4 in [0.5, 2.0],
        fast: Viscous = 0.3 in [-1.0, 1.0],
        slow: Viscous = -0.1 in [-1.0, 1.0],
        theta: Temperature = 320.0 in [250.0, 400.0],
    )
    {
        let strain = |x| ln(x / length);
        let square = |x| x * x;
        let branch = |stiffness, gamma| {
            let elastic = strain(lambda) - gamma;
            0.5 * stiffness * square(elastic)
        };
        let calorie = |t| {
            let relative = |u| t * ln(u / theta_ref);
            t - theta_ref - relative(t)
        };
        branch(k, 0.0 * lambda) + branch(k_fast, fast) + branch(k_slow, slow) * theta / theta_ref
            + capacity * calorie(theta)
    }
    [fast = { let arrhenius = |a, t| exp(a * (1.0 / t - 1.0 / theta_ref)); eta * arrhenius(activation, theta) }]
    [slow = { let thin = |t| eta * theta_ref / t; thin(theta) + thin(2.0 * theta) }]
}

specimen! {
    /// A pendulum's bond in a periodic field: helpers in helpers, and π.
    Periodic { depth: 3.0, period: 0.7, stiffness: 8.0, length: 1.0 }
    (lambda: Stretch = 1.3 in [0.4, 2.4])
    {
        let even = |x| exp(x) + exp(-x);
        let wave = |x| even(x) / cosh(0.5 * x) - even(0.25 * x) * PI;
        0.5 * stiffness * (lambda - length) * (lambda - length)
            + 0.01 * depth * wave(2.0 * PI * (lambda - length) / period)
    }
}
