//! What no scene, no checkpoint and no load may be is refused with its name and value; what is only
//! unusual works.

#[cfg(feature = "serde")]
mod checkpoints;
mod conduction;
mod jumps;
mod lengths;
mod messages;
mod numbers;
mod panics;
mod products;
use eem::prelude::*;

/// A thermoelastic spring with a dashpot, in any scalar.
#[derive(Clone, Debug, FreeEnergy)]
#[free_energy(|lambda: Stretch, gamma: Viscous, theta: Temperature| {
    0.5 * stiffness * (lambda - length).powi(2)
        + 0.5 * branch * (lambda - length - gamma).powi(2)
        - coupling * (theta - theta_ref) * (lambda - length)
        + capacity * (theta - theta_ref - theta * ln(theta / theta_ref))
})]
#[viscosity(gamma = eta)]
struct Warm<T> {
    stiffness: T,
    branch: T,
    length: T,
    coupling: T,
    capacity: T,
    theta_ref: T,
    eta: T,
}

const WARM: Warm<f64> = Warm {
    stiffness: 50.0,
    branch: 20.0,
    length: 1.0,
    coupling: 0.1,
    capacity: 2.0,
    theta_ref: 300.0,
    eta: 5.0,
};

/// An elastic spring in any scalar.
#[derive(Clone, Debug, FreeEnergy)]
#[free_energy(|lambda: Stretch| 0.5 * stiffness * (lambda - length).powi(2))]
struct Elastic<T> {
    stiffness: T,
    length: T,
}
