//! Materials that change phase, smoothly.

use crate::zoo::number::{exp, ln, tanh};
use crate::zoo::specimen::specimen;

specimen! {
    /// A shape-memory bar, Landau's expansion in the strain after Falk 1980: one well when hot,
    /// two when cold, three between.
    Falk {
        a: 20.0, b: 60000.0, c: 40_000_000.0, transition: 290.0, length: 1.0, capacity: 3.0,
        theta_ref: 300.0,
    }
    (lambda: Stretch = 1.02 in [0.93, 1.07], theta: Temperature = 305.0 in [270.0, 350.0])
    {
        let strain = lambda / length - 1.0;
        0.5 * a * (theta - transition) * strain.powi(2) - 0.25 * b * strain.powi(4)
            + c * strain.powi(6) / 6.0
            + capacity * (theta - theta_ref - theta * ln(theta / theta_ref))
    }
}

specimen! {
    /// Two phases in equilibrium in a bar: elastic energies and a latent heat in
    /// `ψ = −w ln Σ exp(−ψᵢ/w)`, with a fixed width w.
    TwoPhases {
        parent: 800.0, product: 500.0, strain: 0.06, latent: 0.05, transition: 290.0, width: 2.0,
        capacity: 4.0, theta_ref: 300.0,
    }
    (lambda: Stretch = 1.04 in [0.9, 1.15], theta: Temperature = 300.0 in [250.0, 350.0])
    {
        let first = 0.5 * parent * (lambda - 1.0).powi(2);
        let second = 0.5 * product * (lambda - 1.0 - strain).powi(2) + latent * (theta - transition);
        second - width * ln(1.0 + exp((second - first) / width))
            + capacity * (theta - theta_ref - theta * ln(theta / theta_ref))
    }
}

specimen! {
    /// A shape-memory polymer: the modulus falls by a tenth over the glass transition.
    GlassTransition {
        rubbery: 40.0, glassy: 60.0, length: 1.0, transition: 330.0, width: 15.0, capacity: 6.0,
        theta_ref: 300.0,
    }
    (lambda: Stretch = 1.15 in [0.8, 1.3], theta: Temperature = 325.0 in [280.0, 380.0])
    {
        let fraction = 0.5 - 0.5 * tanh((theta - transition) / width);
        0.5 * (rubbery + glassy * fraction) * (lambda - length).powi(2)
            + capacity * (theta - theta_ref - theta * ln(theta / theta_ref))
    }
}
