//! Models beside the published ones: without temperature, with two dashpots, with powers.

use eem::FreeEnergy;

/// A bar of incompressible rubber.
#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| {
    let stretch = lambda / length;
    0.5 * shear * (stretch.powi(2) + 2.0 / stretch - 3.0)
})]
pub(crate) struct NeoHookean {
    pub(crate) shear: f64,
    pub(crate) length: f64,
}

/// Two Maxwell branches with stiffnesses that fall with the temperature.
#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, fast: Viscous, slow: Viscous, theta: Temperature| {
    let softening = exp(-fall * (theta - theta_ref));
    let strain = ln(lambda);
    let branches = k_fast * (strain - fast).powi(2) + k_slow * (strain - slow).powi(2);
    0.5 * softening * (k * strain.powi(2) + branches) - coupling * (theta - theta_ref) * strain
        + capacity * (theta - theta * ln(theta / theta_ref))
})]
#[viscosity(fast = eta_fast * exp(activation / theta - activation / theta_ref))]
#[viscosity(slow = eta_slow * (theta_ref / theta).powf(1.5))]
pub(crate) struct TwoDashpots {
    pub(crate) k: f64,
    pub(crate) k_fast: f64,
    pub(crate) k_slow: f64,
    pub(crate) fall: f64,
    pub(crate) coupling: f64,
    pub(crate) capacity: f64,
    pub(crate) theta_ref: f64,
    pub(crate) eta_fast: f64,
    pub(crate) eta_slow: f64,
    pub(crate) activation: f64,
}

/// A heat capacity `c (θ/θ_r)ⁿ`, and Ogden's powers of the stretch.
#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, theta: Temperature| {
    let ratio = theta / theta_ref;
    modulus * ratio * (lambda.powf(alpha) / alpha + 2.0 / (alpha * lambda.powf(0.5 * alpha)))
        - coupling * sqrt(theta) * lambda.powi(3)
        - capacity * theta * ratio.powf(order) / (order * (order + 1.0))
})]
pub(crate) struct PowerHeat {
    pub(crate) modulus: f64,
    pub(crate) alpha: f64,
    pub(crate) coupling: f64,
    pub(crate) capacity: f64,
    pub(crate) order: f64,
    pub(crate) theta_ref: f64,
}

/// A force that saturates, and a power in which base and exponent vary.
#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, gamma: Viscous, theta: Temperature| {
    let ratio = theta / theta_ref;
    limit * tanh(lambda / length) * ratio + bond * lambda.powf(ratio)
        + mu * cosh(gamma) / ratio - capacity * theta * ln(ratio)
})]
#[viscosity(gamma = eta0 * tanh(theta_ref / theta))]
pub(crate) struct Saturating {
    pub(crate) limit: f64,
    pub(crate) length: f64,
    pub(crate) bond: f64,
    pub(crate) mu: f64,
    pub(crate) capacity: f64,
    pub(crate) eta0: f64,
    pub(crate) theta_ref: f64,
}
