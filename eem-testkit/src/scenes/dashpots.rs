//! Springs with one, two and three Maxwell branches in parallel, whose viscosities fall with the
//! temperature.
//!
//! ```text
//! ψ = ½ C ln²(λ/λ0) − β (θ − θr) ln(λ/λ0) + c (θ − θr − θ ln(θ/θr)) + Σ_k ½ μ_k (λ − λ0 − γ_k)²
//! η_k = η0_k exp(a (1/θ − 1/θr))
//! ```

pub use eem::materials::MaxwellDamper as OneDashpot;
use eem::prelude::*;

/// Two branches; μ and η of the second come last.
#[derive(Clone, Debug, FreeEnergy)]
#[free_energy(|lambda: Stretch, gamma1: Viscous, gamma2: Viscous, theta: Temperature| {
    let strain = ln(lambda / natural_length);
    let extension = lambda - natural_length;
    0.5 * stiffness * strain.powi(2) - coupling * (theta - theta_ref) * strain
        + capacity * (theta - theta_ref - theta * ln(theta / theta_ref))
        + 0.5 * mu1 * (extension - gamma1).powi(2) + 0.5 * mu2 * (extension - gamma2).powi(2)
})]
#[viscosity(
    gamma1 = eta1 * exp(a * (1 / theta - 1 / theta_ref)),
    gamma2 = eta2 * exp(a * (1 / theta - 1 / theta_ref))
)]
pub struct TwoDashpots {
    pub stiffness: f64,
    pub coupling: f64,
    pub capacity: f64,
    pub natural_length: f64,
    pub theta_ref: f64,
    pub a: f64,
    pub mu1: f64,
    pub eta1: f64,
    pub mu2: f64,
    pub eta2: f64,
}

/// Three branches.
#[derive(Clone, Debug, FreeEnergy)]
#[free_energy(|lambda: Stretch, gamma1: Viscous, gamma2: Viscous, gamma3: Viscous, theta: Temperature| {
    let strain = ln(lambda / natural_length);
    let extension = lambda - natural_length;
    0.5 * stiffness * strain.powi(2) - coupling * (theta - theta_ref) * strain
        + capacity * (theta - theta_ref - theta * ln(theta / theta_ref))
        + 0.5 * mu1 * (extension - gamma1).powi(2) + 0.5 * mu2 * (extension - gamma2).powi(2)
        + 0.5 * mu3 * (extension - gamma3).powi(2)
})]
#[viscosity(
    gamma1 = eta1 * exp(a * (1 / theta - 1 / theta_ref)),
    gamma2 = eta2 * exp(a * (1 / theta - 1 / theta_ref)),
    gamma3 = eta3 * exp(a * (1 / theta - 1 / theta_ref))
)]
pub struct ThreeDashpots {
    pub stiffness: f64,
    pub coupling: f64,
    pub capacity: f64,
    pub natural_length: f64,
    pub theta_ref: f64,
    pub a: f64,
    pub mu1: f64,
    pub eta1: f64,
    pub mu2: f64,
    pub eta2: f64,
    pub mu3: f64,
    pub eta3: f64,
}

/// Data of one branch.
pub const ONE_DASHPOT: OneDashpot = OneDashpot {
    stiffness: 100.0,
    coupling: 0.5,
    capacity: 2.0,
    natural_length: 1.0,
    theta_ref: 300.0,
    a: 500.0,
    mu: 40.0,
    eta: 20.0,
};

impl TwoDashpots {
    pub const DATA: Self = Self {
        stiffness: 100.0,
        coupling: 0.5,
        capacity: 2.0,
        natural_length: 1.0,
        theta_ref: 300.0,
        a: 500.0,
        mu1: 40.0,
        eta1: 20.0,
        mu2: 25.0,
        eta2: 5.0,
    };
}

impl ThreeDashpots {
    pub const DATA: Self = Self {
        stiffness: 100.0,
        coupling: 0.5,
        capacity: 2.0,
        natural_length: 1.0,
        theta_ref: 300.0,
        a: 500.0,
        mu1: 40.0,
        eta1: 20.0,
        mu2: 25.0,
        eta2: 5.0,
        mu3: 10.0,
        eta3: 60.0,
    };
}
