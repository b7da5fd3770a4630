//! Springs without dashpots.

use crate::FreeEnergy;

/// Hooke's law, ψ = ½ k (λ − L)².
///
/// R. Hooke, *De potentia restitutiva*, London 1678.
///
/// ```
/// use eem::FreeEnergy;
/// use eem::materials::Hooke;
///
/// let spring = Hooke { stiffness: 100.0, natural_length: 1.0 };
/// // A force of 2 N extends it by 2 cm.
/// let [force]: [f64; 1] = spring.gradient(&[1.02]);
/// assert!((force - 2.0).abs() < 1e-12);
/// ```
#[derive(Clone, Copy, Debug, FreeEnergy)]
#[free_energy(|lambda: Stretch| 0.5 * stiffness * (lambda - natural_length).powi(2))]
pub struct Hooke {
    /// k, N/m.
    #[unit("N/m")]
    pub stiffness: f64,
    /// L, m.
    #[unit("m")]
    pub natural_length: f64,
}

/// A spring that is linear in the logarithmic strain, ψ = ½ k ln²(λ/L).
///
/// For a bar, k is Young's modulus times the volume. H. Hencky, *Z. techn. Phys.* **9** (1928) 215–220.
///
/// ```
/// use eem::FreeEnergy;
/// use eem::materials::Hencky;
///
/// let spring = Hencky { stiffness: 100.0, natural_length: 1.0 };
/// // At twice its length: k ln 2/λ.
/// let [force] = spring.gradient(&[2.0]);
/// assert!((force - 50.0 * 2.0_f64.ln()).abs() < 1e-12);
/// ```
#[derive(Clone, Debug, FreeEnergy)]
#[free_energy(|lambda: Stretch| 0.5 * stiffness * ln(lambda / natural_length).powi(2))]
pub struct Hencky {
    /// k, J.
    #[unit("J")]
    pub stiffness: f64,
    /// L, m.
    #[unit("m")]
    pub natural_length: f64,
}

/// A rubber band with a largest stretch, ψ = −½ E J ln(1 − (I − 3)/J) with I = s² + 2/s and s = λ/L.
///
/// Its length is bounded by I − 3 = J; near its natural length it is neo-Hookean. E is the shear modulus times the volume.
/// A. N. Gent, *Rubber Chem. Technol.* **69** (1996) 59–61, for uniaxial tension of an incompressible band.
///
/// ```
/// use eem::FreeEnergy;
/// use eem::materials::GentSpring;
///
/// let band = GentSpring { modulus: 2.0, limit: 20.0, natural_length: 0.5 };
/// // I − 3 = 2 at twice its length.
/// let psi = band.free_energy(&[1.0]);
/// assert!((psi + 20.0 * 0.9_f64.ln()).abs() < 1e-12);
/// ```
#[derive(Clone, Debug, FreeEnergy)]
#[free_energy(|lambda: Stretch| {
    let s = lambda / natural_length;
    -0.5 * modulus * limit * ln(1.0 - (s.powi(2) + 2.0 / s - 3.0) / limit)
})]
pub struct GentSpring {
    /// E, J.
    #[unit("J")]
    pub modulus: f64,
    /// J, the largest I − 3; dimensionless.
    #[unit("1")]
    pub limit: f64,
    /// L, m.
    #[unit("m")]
    pub natural_length: f64,
}

/// A thermoelastic spring, ψ = ½ k ε² − β (θ − θr) ε + c (θ − θr − θ ln(θ/θr)) with ε = ln(λ/L).
///
/// It expands when it is heated, and cools when it is pulled fast. S. Conde Martín, P. Betsch & J. C. García Orden,
/// *Commun. Nonlinear Sci. Numer. Simul.* **32** (2016) 63–80, eq. 43 with constant stiffness, as in the double pendulums
/// of Romero and Krüger.
///
/// ```
/// use eem::FreeEnergy;
/// use eem::materials::ThermoelasticSpring;
///
/// let spring = ThermoelasticSpring {
///     stiffness: 100.0,
///     coupling: 0.5,
///     capacity: 2.0,
///     natural_length: 1.0,
///     theta_ref: 300.0,
/// };
/// // The entropy of a spring that has been pulled to twice its length at 300 K: β ln 2.
/// let caloric = spring.caloric(&[2.0, 300.0]);
/// assert!((caloric.entropy - 0.5 * 2.0_f64.ln()).abs() < 1e-12);
/// assert!((caloric.heat_capacity - 2.0).abs() < 1e-12);
/// ```
#[derive(Clone, Debug, FreeEnergy)]
#[free_energy(|lambda: Stretch, theta: Temperature| {
    let strain = ln(lambda / natural_length);
    0.5 * stiffness * strain.powi(2)
        - coupling * (theta - theta_ref) * strain
        + capacity * (theta - theta_ref - theta * ln(theta / theta_ref))
})]
pub struct ThermoelasticSpring {
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
    /// θr, K, at which there is no thermal stress.
    #[unit("K")]
    pub theta_ref: f64,
}

/// A thermoelastic spring whose stiffness is logarithmic in the temperature, so that its entropy has no closed inverse:
/// [`ThermoelasticSpring`] with k = C₀ − C₁ θr ln(θ/θr).
///
/// S. Conde Martín, P. Betsch & J. C. García Orden, *Commun. Nonlinear Sci. Numer. Simul.* **32** (2016) 63–80,
/// eq. 43.
///
/// ```
/// use eem::FreeEnergy;
/// use eem::materials::LogarithmicStiffness;
///
/// // At the reference temperature its stiffness is C₀.
/// let spring = LogarithmicStiffness::FIRST;
/// let [force, _] = spring.gradient(&[4.0, 300.0]);
/// assert!((force - 1250.0 * 2.0_f64.ln()).abs() < 1e-9);
/// ```
#[derive(Clone, Debug, FreeEnergy)]
#[free_energy(|lambda: Stretch, theta: Temperature| {
    let strain = ln(lambda / natural_length);
    let modulus = stiffness - softening * theta_ref * ln(theta / theta_ref);
    0.5 * modulus * strain.powi(2)
        - coupling * (theta - theta_ref) * strain
        + capacity * (theta - theta_ref - theta * ln(theta / theta_ref))
})]
pub struct LogarithmicStiffness {
    /// C₀, J.
    #[unit("J")]
    pub stiffness: f64,
    /// C₁, J/K.
    #[unit("J/K")]
    pub softening: f64,
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
}

impl LogarithmicStiffness {
    /// The first spring of the published double pendulum.
    pub const FIRST: Self = Self {
        stiffness: 5000.0,
        softening: 50.0,
        coupling: 20.0,
        capacity: 5000.0,
        natural_length: 2.0,
        theta_ref: 300.0,
    };
}
