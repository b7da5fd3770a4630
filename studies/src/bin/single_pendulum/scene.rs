//! The published thermo-visco-elastic pendulum: material, scene, step and end time.
//!
//! Equations, symbols and sources are in the example `single_pendulum`.

#![allow(dead_code, reason = "examples that share this file use a part of it")]

use eem::prelude::*;

use eem_studies::simulate::Watched;

/// Step and end time of the paper, s.
pub(crate) const STEP: f64 = 0.2;
pub(crate) const END: f64 = 20.0;

/// Nonlinear in length and temperature, viscous, softening when hot.
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
pub(crate) struct CreepingSpring {
    #[unit("m")]
    pub(crate) natural_length: f64,
    #[unit("K")]
    pub(crate) theta_ref: f64,
    #[unit("N m")]
    pub(crate) k0: f64,
    #[unit("N m/K")]
    pub(crate) k1: f64,
    #[unit("N m/K")]
    pub(crate) thermal_coupling: f64,
    #[unit("N m/K")]
    pub(crate) capacity: f64,
    #[unit("1")]
    pub(crate) viscous_coupling: f64,
    #[unit("N/m")]
    pub(crate) mu0: f64,
    #[unit("N/(m K)")]
    pub(crate) mu1: f64,
    #[unit("N s/m")]
    pub(crate) eta0: f64,
    #[unit("K")]
    pub(crate) a: f64,
}

/// The material of the paper.
pub(crate) const SPRING: CreepingSpring = CreepingSpring {
    natural_length: 1.0,
    theta_ref: 300.0,
    k0: 100.0,
    k1: 0.5,
    thermal_coupling: 4.0,
    capacity: 1.0,
    viscous_coupling: 0.1,
    mu0: 5.0,
    mu1: 0.1,
    eta0: 100.0,
    a: 10.0,
};

/// Heat conductance to the surroundings, W/K.
pub(crate) const CONDUCTANCE: f64 = 10.0;

/// The pendulum ready to run, and what to record of it; `conductance` in W/K.
pub(crate) fn pendulum(
    scheme: Scheme,
    step: f64,
    conductance: f64,
) -> Result<(Simulation<2>, Watched), SceneError> {
    let (scene, watched) = scene(conductance);
    Ok((Simulation::new(scene, scheme, step)?, watched))
}

/// The pendulum at t = 0, and what to record of it; `conductance` in W/K.
pub(crate) fn scene(conductance: f64) -> (Scene<2>, Watched) {
    let mut scene = Scene::<2>::new();
    let pivot = scene.anchor([0.0, 0.0]);
    let bob = scene.mass(1.0, [3.0, 0.0], [0.0, 1.0]);
    let spring = scene.spring(SPRING, [pivot, bob]);
    scene.set_temperature(spring, 380.0);
    let surroundings = scene.reservoir(300.0);
    scene.conduct(spring, surroundings, conductance);
    let watched = Watched {
        masses: vec![bob],
        elements: vec![spring],
        has_reservoirs: true,
    };
    (scene, watched)
}
