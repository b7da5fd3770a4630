//! Solids.

use crate::FreeEnergy;

/// Quadratic in the Green–Lagrange strain, ψ = ½ Λ tr²E + μ E:E.
///
/// For large rotations and small strains; under strong compression it softens. A. J. C. Barré de Saint-Venant
/// 1844, G. Kirchhoff 1852; e.g. P. G. Ciarlet, *Mathematical Elasticity I*, 1988, §3.9.
///
/// ```
/// use eem::FreeEnergy;
/// use eem::materials::SaintVenantKirchhoff;
///
/// let solid = SaintVenantKirchhoff { lame: 2000.0, shear: 1000.0 };
/// // One direction strained by 0.1: tr E = 0.1, E:E = 0.01.
/// let psi = solid.free_energy(&[0.1, 0.01]);
/// assert!((psi - 20.0_f64).abs() < 1e-12);
/// ```
#[derive(Clone, Debug, FreeEnergy)]
#[free_energy(|e1: StrainTrace, e2: StrainSquare| 0.5 * lame * e1.powi(2) + shear * e2)]
pub struct SaintVenantKirchhoff {
    /// Λ, Pa.
    #[unit("Pa")]
    pub lame: f64,
    /// μ, Pa.
    #[unit("Pa")]
    pub shear: f64,
}

/// Compressible rubber, ψ = μ (tr E − ln J) + ½ Λ ln²J.
///
/// The energy becomes infinite as the volume goes to zero. J. C. Simo & K. S. Pister, *Comput. Methods Appl. Mech. Eng.* **46**
/// (1984) 201–215.
///
/// ```
/// use eem::FreeEnergy;
/// use eem::materials::NeoHooke;
///
/// let rubber = NeoHooke { shear: 1000.0, lame: 2000.0 };
/// // tr E = 0.1 at a constant volume; the second variable is J − 1.
/// let psi = rubber.free_energy(&[0.1, 0.0]);
/// assert!((psi - 100.0_f64).abs() < 1e-12);
/// ```
#[derive(Clone, Debug, FreeEnergy)]
#[free_energy(|e1: StrainTrace, j: Dilatation| {
    let growth = ln_1p(j);
    shear * (e1 - growth) + 0.5 * lame * growth.powi(2)
})]
pub struct NeoHooke {
    /// μ, Pa.
    #[unit("Pa")]
    pub shear: f64,
    /// Λ, Pa.
    #[unit("Pa")]
    pub lame: f64,
}

/// [`NeoHooke`] with heat: ψ = (μ − μ′ ϑ) (tr E − ln J) + ½ Λ ln²J − β ϑ ln J + c (ϑ − θ ln(θ/θr)) with ϑ = θ − θr.
///
/// When it is heated, it expands and its shear modulus falls; the heat capacity c is constant. The thermal terms are
/// those of [`ThermoelasticSpring`](super::ThermoelasticSpring), with ln J for the strain.
///
/// ```
/// use eem::FreeEnergy;
/// use eem::materials::ThermoelasticSolid;
///
/// let rubber = ThermoelasticSolid::RUBBER;
/// let caloric = rubber.caloric(&[0.1, 0.0, 310.0]);
/// // μ′ tr E + c ln(θ/θr).
/// let entropy = 2.0 * 0.1 + 100.0 * (310.0_f64 / 300.0).ln();
/// assert!((caloric.entropy - entropy).abs() < 1e-12);
/// ```
#[derive(Clone, Debug, FreeEnergy)]
#[free_energy(|e1: StrainTrace, j: Dilatation, theta: Temperature| {
    let heating = theta - theta_ref;
    let growth = ln_1p(j);
    (shear - softening * heating) * (e1 - growth) + 0.5 * lame * growth.powi(2)
        - expansion * heating * growth
        + capacity * (heating - theta * ln(theta / theta_ref))
})]
pub struct ThermoelasticSolid {
    /// μ, Pa.
    #[unit("Pa")]
    pub shear: f64,
    /// μ′, Pa/K.
    #[unit("Pa/K")]
    pub softening: f64,
    /// Λ, Pa.
    #[unit("Pa")]
    pub lame: f64,
    /// β, Pa/K.
    #[unit("Pa/K")]
    pub expansion: f64,
    /// c, Pa/K.
    #[unit("Pa/K")]
    pub capacity: f64,
    /// θr, K.
    #[unit("K")]
    pub theta_ref: f64,
}

impl ThermoelasticSolid {
    /// A soft rubber with strong thermal effects.
    pub const RUBBER: Self = Self {
        shear: 1000.0,
        softening: 2.0,
        lame: 2000.0,
        expansion: 3.0,
        capacity: 100.0,
        theta_ref: 300.0,
    };
}
