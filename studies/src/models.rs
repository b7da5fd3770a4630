//! Free energies: springs of every kind, and two solids.

use eem::prelude::*;

/// Elastic, in logarithmic strain.
#[derive(Clone, Debug, FreeEnergy)]
#[free_energy(|lambda: Stretch| 0.5 * stiffness * ln(lambda / length).powi(2))]
pub struct Elastic {
    /// J
    #[unit("J")]
    pub stiffness: f64,
    /// m
    #[unit("m")]
    pub length: f64,
}

/// Thermoelastic, with a stiffness logarithmic in the temperature: Conde Martín, Betsch & García Orden (2016), eq. 43.
#[derive(Clone, Debug, FreeEnergy)]
#[free_energy(|lambda: Stretch, theta: Temperature| {
    let strain = ln(lambda / length);
    let modulus = stiffness - softening * theta_ref * ln(theta / theta_ref);
    0.5 * modulus * strain.powi(2) - coupling * (theta - theta_ref) * strain
        + capacity * (theta - theta_ref - theta * ln(theta / theta_ref))
})]
pub struct Thermoelastic {
    /// J
    #[unit("J")]
    pub stiffness: f64,
    /// J/K
    #[unit("J/K")]
    pub softening: f64,
    /// J/K
    #[unit("J/K")]
    pub coupling: f64,
    /// J/K
    #[unit("J/K")]
    pub capacity: f64,
    /// m
    #[unit("m")]
    pub length: f64,
    /// K
    #[unit("K")]
    pub theta_ref: f64,
}

/// The thermo-visco-elastic spring of García Orden & Romero (2012), §4.1.
#[derive(Clone, Debug, FreeEnergy)]
#[free_energy(|lambda: Stretch, gamma: Viscous, theta: Temperature| {
    let strain = ln(lambda / natural_length);
    let heating = theta - theta_ref;
    let elastic = 0.5 * (k0 - k1 * heating) * strain.powi(2)
        - thermal_coupling * heating * strain
        + capacity * (heating - theta * ln(theta / theta_ref));
    (1 + viscous_coupling) * elastic
        + (mu0 - mu1 * heating) * gamma.powi(2)
        - viscous_coupling * gamma * diff(elastic, lambda)
})]
#[viscosity(gamma = eta0 * exp(a * (1 / theta - 1 / theta_ref)))]
pub struct Creeping {
    /// m
    #[unit("m")]
    pub natural_length: f64,
    /// K
    #[unit("K")]
    pub theta_ref: f64,
    /// N m
    #[unit("N m")]
    pub k0: f64,
    /// N m/K
    #[unit("N m/K")]
    pub k1: f64,
    /// N m/K
    #[unit("N m/K")]
    pub thermal_coupling: f64,
    /// N m/K
    #[unit("N m/K")]
    pub capacity: f64,
    /// A pure number.
    #[unit("1")]
    pub viscous_coupling: f64,
    /// N/m
    #[unit("N/m")]
    pub mu0: f64,
    /// N/(m K)
    #[unit("N/(m K)")]
    pub mu1: f64,
    /// N s/m
    #[unit("N s/m")]
    pub eta0: f64,
    /// K
    #[unit("K")]
    pub a: f64,
}

/// Two Maxwell branches beside a spring, without temperature.
#[derive(Clone, Debug, FreeEnergy)]
#[free_energy(|lambda: Stretch, fast: Viscous, slow: Viscous| {
    0.5 * stiffness * (lambda - length).powi(2)
        + 0.5 * stiffness * (lambda - length - fast).powi(2)
        + 0.5 * stiffness * (lambda - length - slow).powi(2)
})]
#[viscosity(fast = eta, slow = 10 * eta)]
pub struct TwoDashpots {
    /// N/m
    #[unit("N/m")]
    pub stiffness: f64,
    /// m
    #[unit("m")]
    pub length: f64,
    /// N s/m
    #[unit("N s/m")]
    pub eta: f64,
}

/// A dashpot beside the spring, which thins with heat: Kelvin and Voigt.
#[derive(Clone, Debug, FreeEnergy)]
#[free_energy(|lambda: Stretch, theta: Temperature| {
    let strain = ln(lambda / length);
    0.5 * stiffness * strain.powi(2) - coupling * (theta - theta_ref) * strain
        + capacity * (theta - theta_ref - theta * ln(theta / theta_ref))
})]
#[viscosity(lambda = eta * exp(activation * (1 / theta - 1 / theta_ref)))]
pub struct Voigt {
    /// J
    #[unit("J")]
    pub stiffness: f64,
    /// m
    #[unit("m")]
    pub length: f64,
    /// J/K
    #[unit("J/K")]
    pub coupling: f64,
    /// J/K
    #[unit("J/K")]
    pub capacity: f64,
    /// K
    #[unit("K")]
    pub theta_ref: f64,
    /// N s/m
    #[unit("N s/m")]
    pub eta: f64,
    /// K
    #[unit("K")]
    pub activation: f64,
}

/// The solid of Saint-Venant and Kirchhoff.
#[derive(Clone, Debug, FreeEnergy)]
#[free_energy(|e1: StrainTrace, e2: StrainSquare| 0.5 * lame * e1.powi(2) + shear * e2)]
pub struct Solid {
    /// Pa
    #[unit("Pa")]
    pub lame: f64,
    /// Pa
    #[unit("Pa")]
    pub shear: f64,
}

/// A solid whose shear modulus falls with the temperature.
#[derive(Clone, Debug, FreeEnergy)]
#[free_energy(|e1: StrainTrace, j: Dilatation, theta: Temperature| {
    let heating = theta - theta_ref;
    let growth = ln_1p(j);
    (shear - softening * heating) * (e1 - growth) + 0.5 * lame * growth.powi(2)
        - expansion * heating * growth
        + capacity * (heating - theta * ln(theta / theta_ref))
})]
pub struct WarmSolid {
    /// Pa
    #[unit("Pa")]
    pub shear: f64,
    /// Pa/K
    #[unit("Pa/K")]
    pub softening: f64,
    /// Pa
    #[unit("Pa")]
    pub lame: f64,
    /// Pa/K
    #[unit("Pa/K")]
    pub expansion: f64,
    /// Pa/K
    #[unit("Pa/K")]
    pub capacity: f64,
    /// K
    #[unit("K")]
    pub theta_ref: f64,
}
