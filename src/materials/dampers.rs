//! Springs with a dashpot.

use crate::FreeEnergy;

/// A thermoelastic spring in parallel with a spring and a dashpot in series:
/// ψ = ½ k ε² − β (θ − θr) ε + c (θ − θr − θ ln(θ/θr)) + ½ μ (λ − L − γ)², η = η₀ exp(a (1/θ − 1/θr)).
///
/// Under fast loads it is stiffer than [`ThermoelasticSpring`](super::ThermoelasticSpring), at rest it equals it. The
/// dissipation of the dashpot warms it. J. C. Maxwell, *Phil. Trans. R. Soc.* **157** (1867) 49–88.
///
/// ```
/// use eem::FreeEnergy;
/// use eem::materials::MaxwellDamper;
///
/// let damper = MaxwellDamper {
///     stiffness: 100.0,
///     coupling: 0.5,
///     capacity: 2.0,
///     natural_length: 1.0,
///     theta_ref: 300.0,
///     a: 500.0,
///     mu: 40.0,
///     eta: 20.0,
/// };
/// // Pulled suddenly to twice its length: k ln 2/λ of the spring, and μ (λ − L) of the branch.
/// let [force, _, _] = damper.gradient(&[2.0, 0.0, 300.0]);
/// assert!((force - (50.0 * 2.0_f64.ln() + 40.0)).abs() < 1e-12);
/// let ([eta], _) = damper.viscosity(300.0);
/// assert!((eta - 20.0_f64).abs() < 1e-12);
/// ```
#[derive(Clone, Debug, FreeEnergy)]
#[free_energy(|lambda: Stretch, gamma: Viscous, theta: Temperature| {
    let strain = ln(lambda / natural_length);
    0.5 * stiffness * strain.powi(2) - coupling * (theta - theta_ref) * strain
        + capacity * (theta - theta_ref - theta * ln(theta / theta_ref))
        + 0.5 * mu * (lambda - natural_length - gamma).powi(2)
})]
#[viscosity(gamma = eta * exp(a * (1 / theta - 1 / theta_ref)))]
pub struct MaxwellDamper {
    /// k, J.
    #[unit("J")]
    pub stiffness: f64,
    /// β, J/K.
    #[unit("J/K")]
    pub coupling: f64,
    /// c, J/K.
    #[unit("J/K")]
    pub capacity: f64,
    /// L, m.
    #[unit("m")]
    pub natural_length: f64,
    /// θr, K.
    #[unit("K")]
    pub theta_ref: f64,
    /// a, K: how fast the viscosity falls with the temperature.
    #[unit("K")]
    pub a: f64,
    /// μ, N/m, of the spring in series with the dashpot.
    #[unit("N/m")]
    pub mu: f64,
    /// η₀, N s/m, at θr.
    #[unit("N s/m")]
    pub eta: f64,
}

/// A thermoelastic spring in parallel with a dashpot: ψ = ½ k ε² − β (θ − θr) ε + c (θ − θr − θ ln(θ/θr)), and a force
/// η dλ/dt with η = η₀ exp(a (1/θ − 1/θr)).
///
/// The dissipation of the dashpot warms it. W. Voigt, *Ann. Phys.* **283** (1892) 671–693.
///
/// ```
/// use eem::FreeEnergy;
/// use eem::materials::KelvinVoigtDamper;
///
/// let damper = KelvinVoigtDamper {
///     stiffness: 60.0,
///     coupling: 0.1,
///     capacity: 2.0,
///     natural_length: 1.0,
///     theta_ref: 300.0,
///     a: 800.0,
///     eta: 1.5,
/// };
/// let psi = damper.free_energy(&[2.0, 300.0]);
/// assert!((psi - 30.0 * 2.0_f64.ln().powi(2)).abs() < 1e-12);
/// ```
#[derive(Clone, Debug, FreeEnergy)]
#[free_energy(|lambda: Stretch, theta: Temperature| {
    let strain = ln(lambda / natural_length);
    0.5 * stiffness * strain.powi(2) - coupling * (theta - theta_ref) * strain
        + capacity * (theta - theta_ref - theta * ln(theta / theta_ref))
})]
#[viscosity(lambda = eta * exp(a * (1 / theta - 1 / theta_ref)))]
pub struct KelvinVoigtDamper {
    /// k, J.
    #[unit("J")]
    pub stiffness: f64,
    /// β, J/K.
    #[unit("J/K")]
    pub coupling: f64,
    /// c, J/K.
    #[unit("J/K")]
    pub capacity: f64,
    /// L, m.
    #[unit("m")]
    pub natural_length: f64,
    /// θr, K.
    #[unit("K")]
    pub theta_ref: f64,
    /// a, K: how fast the viscosity falls with the temperature.
    #[unit("K")]
    pub a: f64,
    /// η₀, N s/m, at θr.
    #[unit("N s/m")]
    pub eta: f64,
}

/// The thermo-visco-elastic element of a published pendulum, whose viscous part has a ratio r of the elastic energy.
///
/// With the elastic energy e = ½ (k₀ − k₁ ϑ) ε² − β ϑ ε + c (ϑ − θ ln(θ/θr)), ε = ln(λ/L) and ϑ = θ − θr:
/// ψ = (1 + r) e + (μ₀ − μ₁ ϑ) γ² − r γ ∂e/∂λ, η = η₀ exp(a (1/θ − 1/θr)).
///
/// J. C. García Orden & I. Romero, *Eur. J. Mech. A/Solids* **32** (2012) 76–87, §4.1.
///
/// ```
/// use eem::FreeEnergy;
/// use eem::materials::ThermoViscoElastic;
///
/// // A hot spring of three metres that has not crept: the viscosity falls from 100 N s/m by 0.7 %.
/// let spring = ThermoViscoElastic::PENDULUM;
/// let ([eta], _) = spring.viscosity(380.0);
/// assert!((eta - 100.0 * (-8.0_f64 / 1140.0).exp()).abs() < 1e-10);
/// ```
#[derive(Clone, Debug, FreeEnergy)]
#[free_energy(|lambda: Stretch, gamma: Viscous, theta: Temperature| {
    let strain = ln(lambda / natural_length);
    let heating = theta - theta_ref;
    let elastic = 0.5 * (k0 - k1 * heating) * strain.powi(2)
        - coupling * heating * strain
        + capacity * (heating - theta * ln(theta / theta_ref));
    (1.0 + ratio) * elastic + (mu0 - mu1 * heating) * gamma.powi(2)
        - ratio * gamma * diff(elastic, lambda)
})]
#[viscosity(gamma = eta0 * exp(a * (1.0 / theta - 1.0 / theta_ref)))]
pub struct ThermoViscoElastic {
    /// k₀, N m.
    #[unit("N m")]
    pub k0: f64,
    /// k₁, N m/K.
    #[unit("N m/K")]
    pub k1: f64,
    /// r, dimensionless.
    #[unit("1")]
    pub ratio: f64,
    /// β, N m/K.
    #[unit("N m/K")]
    pub coupling: f64,
    /// c, N m/K.
    #[unit("N m/K")]
    pub capacity: f64,
    /// μ₀, N/m.
    #[unit("N/m")]
    pub mu0: f64,
    /// μ₁, N/(m K).
    #[unit("N/(m K)")]
    pub mu1: f64,
    /// η₀, N s/m.
    #[unit("N s/m")]
    pub eta0: f64,
    /// a, K.
    #[unit("K")]
    pub a: f64,
    /// L, m.
    #[unit("m")]
    pub natural_length: f64,
    /// θr, K.
    #[unit("K")]
    pub theta_ref: f64,
}

impl ThermoViscoElastic {
    /// The published parameters.
    pub const PENDULUM: Self = Self {
        k0: 100.0,
        k1: 0.5,
        ratio: 0.1,
        coupling: 4.0,
        capacity: 1.0,
        mu0: 5.0,
        mu1: 0.1,
        eta0: 100.0,
        a: 10.0,
        natural_length: 1.0,
        theta_ref: 300.0,
    };
}
