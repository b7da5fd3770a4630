//! Solids in the plane.

pub use eem::materials::{SaintVenantKirchhoff as SaintVenant, ThermoelasticSolid};
use eem::prelude::*;

/// The section of all solids here.
pub const SECTION: Section = Section {
    density: 10.0,
    thickness: 1.0,
};

/// A solid with a dashpot for the change of volume.
#[derive(Clone, Debug, FreeEnergy)]
#[free_energy(|e1: StrainTrace, e2: StrainSquare, gamma: Viscous, theta: Temperature| {
    let heating = theta - theta_ref;
    0.5 * lame * e1.powi(2) + shear * e2 + 0.5 * relaxing * (e1 - gamma).powi(2)
        - expansion * heating * e1
        + capacity * (heating - theta * ln(theta / theta_ref))
})]
#[viscosity(gamma = eta * exp(a / theta - a / theta_ref))]
pub struct Viscous {
    #[unit("Pa")]
    pub lame: f64,
    #[unit("Pa")]
    pub shear: f64,
    #[unit("Pa")]
    pub relaxing: f64,
    #[unit("Pa/K")]
    pub expansion: f64,
    #[unit("Pa/K")]
    pub capacity: f64,
    #[unit("Pa s")]
    pub eta: f64,
    #[unit("K")]
    pub a: f64,
    #[unit("K")]
    pub theta_ref: f64,
}

impl Viscous {
    pub const RUBBER: Self = Self {
        lame: 2000.0,
        shear: 1000.0,
        relaxing: 1500.0,
        expansion: 3.0,
        capacity: 100.0,
        eta: 300.0,
        a: 50.0,
        theta_ref: 300.0,
    };
}

/// A solid with dashpots for the change of volume and for a fibre.
#[derive(Clone, Debug, FreeEnergy)]
#[free_energy(|e1: StrainTrace, e2: StrainSquare, e4: FibreStrain, volume: Viscous, fibre: Viscous, theta: Temperature| {
    let heating = theta - theta_ref;
    0.5 * lame * e1.powi(2) + shear * e2
        + 0.5 * kv * (e1 - volume).powi(2) + 0.5 * kf * (e4 - fibre).powi(2)
        - expansion * heating * e1
        + capacity * (heating - theta * ln(theta / theta_ref))
})]
#[viscosity(volume = eta_v * exp(a / theta - a / theta_ref), fibre = eta_f * exp(a / theta - a / theta_ref))]
pub struct Reinforced {
    #[unit("Pa")]
    pub lame: f64,
    #[unit("Pa")]
    pub shear: f64,
    #[unit("Pa")]
    pub kv: f64,
    #[unit("Pa")]
    pub kf: f64,
    #[unit("Pa/K")]
    pub expansion: f64,
    #[unit("Pa/K")]
    pub capacity: f64,
    #[unit("K")]
    pub theta_ref: f64,
    #[unit("Pa s")]
    pub eta_v: f64,
    #[unit("Pa s")]
    pub eta_f: f64,
    #[unit("K")]
    pub a: f64,
}

impl Reinforced {
    pub const RUBBER: Self = Self {
        lame: 2000.0,
        shear: 1000.0,
        kv: 1500.0,
        kf: 2500.0,
        expansion: 3.0,
        capacity: 100.0,
        theta_ref: 300.0,
        eta_v: 300.0,
        eta_f: 500.0,
        a: 50.0,
    };
}

/// Compressible Mooney–Rivlin, free of stress at the reference temperature, that expands when it is warm.
#[derive(Clone, Debug, FreeEnergy)]
#[free_energy(|e1: StrainTrace, e2: StrainSquare, j: Dilatation, theta: Temperature| {
    let isochoric = 2 * a * e1 + b * (4 * e1 + 2 * (e1.powi(2) - e2));
    let volumetric = 0.5 * c1 * j.powi(2) - d1 * ln_1p(j);
    let heating = theta - theta_ref;
    isochoric + volumetric - 3 * beta * heating * (c2 * j - d2 / (1 + j))
        + capacity * (heating - theta * ln(theta / theta_ref))
})]
pub struct MooneyRivlin {
    #[unit("Pa")]
    pub a: f64,
    #[unit("Pa")]
    pub b: f64,
    #[unit("Pa")]
    pub c1: f64,
    #[unit("Pa")]
    pub d1: f64,
    #[unit("Pa")]
    pub c2: f64,
    #[unit("Pa")]
    pub d2: f64,
    #[unit("1/K")]
    pub beta: f64,
    #[unit("Pa/K")]
    pub capacity: f64,
    #[unit("K")]
    pub theta_ref: f64,
}

impl MooneyRivlin {
    /// λ = 5209 Pa, μ = 997.5 Pa.
    pub const RUBBER: Self = Self {
        a: 997.5 / 4.0,
        b: 997.5 / 4.0,
        c1: 5209.0 - 997.5,
        d1: 997.5 * 1.5,
        c2: 5209.0,
        d2: 665.0,
        beta: 2.233e-4,
        capacity: 100.0,
        theta_ref: 293.15,
    };
}

/// A solid whose shear stress relaxes, with a branch that softens when it is warm: strains, viscous strain and
/// temperature do not separate.
#[derive(Clone, Debug, FreeEnergy)]
#[free_energy(|e1: StrainTrace, e2: StrainSquare, m3: ViscousStrain, m2: ViscousSquare, theta: Temperature| {
    let heating = theta - theta_ref;
    0.5 * lame * e1.powi(2) + shear * e2
        + (branch - softening * heating) * (e2 - 2 * m3 + m2)
        - expansion * heating * e1
        + capacity * (heating - theta * ln(theta / theta_ref))
})]
#[viscosity(m3 = eta * exp(a / theta - a / theta_ref))]
pub struct Relaxing {
    #[unit("Pa")]
    pub lame: f64,
    #[unit("Pa")]
    pub shear: f64,
    #[unit("Pa")]
    pub branch: f64,
    #[unit("Pa/K")]
    pub softening: f64,
    #[unit("Pa/K")]
    pub expansion: f64,
    #[unit("Pa/K")]
    pub capacity: f64,
    #[unit("Pa s")]
    pub eta: f64,
    #[unit("K")]
    pub a: f64,
    #[unit("K")]
    pub theta_ref: f64,
}

impl Relaxing {
    pub const RUBBER: Self = Self {
        lame: 2000.0,
        shear: 1000.0,
        branch: 1500.0,
        softening: 2.0,
        expansion: 3.0,
        capacity: 100.0,
        eta: 300.0,
        a: 50.0,
        theta_ref: 300.0,
    };
}

/// A solid in which everything flows: shape and volume by a tensor, and a fibre by a dashpot of its own.
#[derive(Clone, Debug, FreeEnergy)]
#[free_energy(|e1: StrainTrace, fibre: Viscous, m1: ViscousTrace, e4: FibreStrain, m3: ViscousStrain,
    j: Dilatation, e2: StrainSquare, theta: Temperature, m2: ViscousSquare| {
    let heating = theta - theta_ref;
    let difference = e2 - 2 * m3 + m2;
    shear * e2 + 0.5 * lame * ln_1p(j).powi(2) + kf * (e4 - fibre).powi(2)
        + (branch - softening * heating) * difference * (1 + difference)
        + 0.5 * bulk * (e1 - m1).powi(2)
        - expansion * heating * ln_1p(j)
        + capacity * (heating - theta * ln(theta / theta_ref))
})]
#[viscosity(m1 = eta_v, m3 = eta * exp(a / theta - a / theta_ref), fibre = eta_f)]
pub struct Flowing {
    #[unit("Pa")]
    pub lame: f64,
    #[unit("Pa")]
    pub shear: f64,
    #[unit("Pa")]
    pub branch: f64,
    #[unit("Pa/K")]
    pub softening: f64,
    #[unit("Pa")]
    pub bulk: f64,
    #[unit("Pa")]
    pub kf: f64,
    #[unit("Pa/K")]
    pub expansion: f64,
    #[unit("Pa/K")]
    pub capacity: f64,
    #[unit("Pa s")]
    pub eta: f64,
    #[unit("Pa s")]
    pub eta_v: f64,
    #[unit("Pa s")]
    pub eta_f: f64,
    #[unit("K")]
    pub a: f64,
    #[unit("K")]
    pub theta_ref: f64,
}

impl Flowing {
    pub const RUBBER: Self = Self {
        lame: 2000.0,
        shear: 1000.0,
        branch: 1500.0,
        softening: 2.0,
        bulk: 800.0,
        kf: 2500.0,
        expansion: 3.0,
        capacity: 100.0,
        eta: 300.0,
        eta_v: 200.0,
        eta_f: 500.0,
        a: 50.0,
        theta_ref: 300.0,
    };
}
