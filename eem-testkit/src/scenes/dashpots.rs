//! Springs with one, two and three Maxwell branches in parallel, whose viscosities fall with the
//! temperature.
//!
//! ```text
//! ψ = ½ C ln²(λ/λ0) − β (θ − θr) ln(λ/λ0) + c (θ − θr − θ ln(θ/θr)) + Σ_k ½ μ_k (λ − λ0 − γ_k)²
//! η_k = η0_k exp(a (1/θ − 1/θr))
//! ```

pub use eem::materials::MaxwellDamper as OneDashpot;
use eem::prelude::*;

use super::{Hencky, LogarithmicStiffness, ThermoViscoElastic};

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

/// A free body: four masses and six springs, one elastic, two logarithmic, and with one, two and three dashpots, the thermal ones
/// in contact.
pub fn tetrahedron() -> (Scene<3>, [Node; 4]) {
    let mut scene = Scene::<3>::new();
    let nodes = [
        scene.mass(1.0, [1.1, 0.0, 0.0], [0.0, 0.5, 0.1]),
        scene.mass(2.0, [-0.5, 0.9, 0.0], [-0.4, -0.2, 0.0]),
        scene.mass(1.5, [-0.5, -0.9, 0.1], [0.4, -0.1, -0.2]),
        scene.mass(0.5, [0.1, 0.0, 1.3], [0.1, 0.0, 0.3]),
    ];
    let logarithmic = LogarithmicStiffness {
        natural_length: 1.7,
        ..LogarithmicStiffness::FIRST
    };
    let one = ThermoViscoElastic {
        natural_length: 1.5,
        ..ThermoViscoElastic::PENDULUM
    };
    let two = TwoDashpots {
        natural_length: 1.6,
        ..TwoDashpots::DATA
    };
    let three = ThreeDashpots {
        natural_length: 1.5,
        ..ThreeDashpots::DATA
    };
    let thermal = [
        scene.spring(logarithmic.clone(), [nodes[0], nodes[1]]),
        scene.spring(one, [nodes[1], nodes[2]]),
        scene.spring(logarithmic, [nodes[2], nodes[0]]),
        scene.spring(three, [nodes[0], nodes[3]]),
        scene.spring(two, [nodes[1], nodes[3]]),
    ];
    let elastic = Hencky {
        stiffness: 200.0,
        natural_length: 1.6,
    };
    scene.spring(elastic, [nodes[2], nodes[3]]);
    let temperatures = [320.0, 290.0, 310.0, 300.0, 305.0];
    for (element, temperature) in thermal.into_iter().zip(temperatures) {
        scene.set_temperature(element, temperature);
    }
    for (pair, conductance) in thermal.windows(2).zip([5.0, 2.0, 1.0, 3.0]) {
        scene.conduct(pair[0], pair[1], conductance);
    }
    (scene, nodes)
}
