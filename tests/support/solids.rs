//! Solids in the plane.

use eem::prelude::*;

/// Saint-Venant and Kirchhoff: ½ λ e1² + μ e2 per volume.
#[derive(Clone, Debug, FreeEnergy)]
#[free_energy(|e1: StrainTrace, e2: StrainSquare| 0.5 * lame * e1.powi(2) + shear * e2)]
pub(crate) struct SaintVenant {
    #[unit("Pa")]
    pub(crate) lame: f64,
    #[unit("Pa")]
    pub(crate) shear: f64,
}

/// A solid whose shear modulus falls with the temperature: strains and temperature do not separate.
#[derive(Clone, Debug, FreeEnergy)]
#[free_energy(|e1: StrainTrace, j: Dilatation, theta: Temperature| {
    let heating = theta - theta_ref;
    let growth = ln_1p(j);
    (shear - softening * heating) * (e1 - growth) + 0.5 * lame * growth.powi(2)
        - expansion * heating * growth
        + capacity * (heating - theta * ln(theta / theta_ref))
})]
pub(crate) struct ThermoelasticSolid {
    #[unit("Pa")]
    pub(crate) shear: f64,
    #[unit("Pa/K")]
    pub(crate) softening: f64,
    #[unit("Pa")]
    pub(crate) lame: f64,
    #[unit("Pa/K")]
    pub(crate) expansion: f64,
    #[unit("Pa/K")]
    pub(crate) capacity: f64,
    #[unit("K")]
    pub(crate) theta_ref: f64,
}

impl ThermoelasticSolid {
    pub(crate) const RUBBER: Self = Self {
        shear: 1000.0,
        softening: 2.0,
        lame: 2000.0,
        expansion: 3.0,
        capacity: 100.0,
        theta_ref: 300.0,
    };
}

/// The section of all solids here.
pub(crate) const SECTION: Section = Section {
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
pub(crate) struct Viscous {
    #[unit("Pa")]
    pub(crate) lame: f64,
    #[unit("Pa")]
    pub(crate) shear: f64,
    #[unit("Pa")]
    pub(crate) relaxing: f64,
    #[unit("Pa/K")]
    pub(crate) expansion: f64,
    #[unit("Pa/K")]
    pub(crate) capacity: f64,
    #[unit("Pa s")]
    pub(crate) eta: f64,
    #[unit("K")]
    pub(crate) a: f64,
    #[unit("K")]
    pub(crate) theta_ref: f64,
}

impl Viscous {
    pub(crate) const RUBBER: Self = Self {
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
