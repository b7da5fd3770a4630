//! Springs without temperature, with constant viscosities.

use eem::materials::{Hencky, Hooke};
use eem::prelude::*;

/// A spring beside a spring with a dashpot in series, `½ k (λ − ℓ)² + ½ μ (λ − ℓ − γ)²`.
#[derive(Clone, Copy, Debug, FreeEnergy)]
#[free_energy(|lambda: Stretch, gamma: Viscous| {
    0.5 * k * (lambda - length).powi(2) + 0.5 * mu * (lambda - length - gamma).powi(2)
})]
#[viscosity(gamma = eta)]
pub struct Branched {
    pub k: f64,
    pub mu: f64,
    pub eta: f64,
    pub length: f64,
}

/// A spring with a dashpot beside it, `½ k (λ − ℓ)²`.
#[derive(Clone, Copy, Debug, FreeEnergy)]
#[free_energy(|lambda: Stretch| 0.5 * k * (lambda - length).powi(2))]
#[viscosity(lambda = eta)]
pub struct Braked {
    pub k: f64,
    pub eta: f64,
    pub length: f64,
}

/// ½ k (λ − L)².
pub const fn hooke(stiffness: f64, natural_length: f64) -> Hooke {
    Hooke {
        stiffness,
        natural_length,
    }
}

/// The same, of 1 m.
pub const fn linear(stiffness: f64) -> Hooke {
    hooke(stiffness, 1.0)
}

/// ½ k ln²(λ/L).
pub const fn hencky(stiffness: f64, natural_length: f64) -> Hencky {
    Hencky {
        stiffness,
        natural_length,
    }
}
