//! The springs of the cases, as formulas written by hand: forces, entropy and their derivatives.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | λ, γ, θ | length, viscous stretch, temperature | m, m, K |
//! | f = ∂ψ/∂λ, g = −∂ψ/∂γ | force of the spring, of the dashpot | N |
//! | s = −∂ψ/∂θ, e = ψ + θs | entropy, internal energy | J/K, J |
//! | c = θ ∂s/∂θ | heat capacity | J/K |

mod creeping;
mod logarithmic;

use num_dual::DualNum;

/// A double, or a dual number that carries derivatives along.
pub(crate) trait Number: DualNum<Primitive = f64> + Copy {}

impl<T: DualNum<Primitive = f64> + Copy> Number for T {}

/// A spring of given λ and γ.
pub(crate) trait Spring {
    /// What depends on λ and γ only.
    type At<R: Number>: Stretched<R>;

    /// The spring at a length and a viscous stretch, m.
    fn at<R: Number>(&self, lambda: R, gamma: R) -> Self::At<R>;

    /// What a change of ln θ adds to the entropy, about, J/K.
    fn capacity(&self) -> f64;
}

/// What a spring answers at a temperature θ, K.
pub(crate) trait Stretched<R: Number>: Copy {
    /// f, N.
    fn force(self, theta: R) -> R;

    /// g, N.
    fn dashpot_force(self, theta: R) -> R;

    /// η, N s/m.
    fn viscosity(self, theta: R) -> R;

    /// s, J/K.
    fn entropy(self, theta: R) -> R;

    /// c, J/K.
    fn capacity(self, theta: R) -> R;

    /// ∂s/∂λ and ∂s/∂γ, J/(K m).
    fn slopes(self, theta: R) -> [R; 2];

    /// ψ, J.
    fn free_energy(self, theta: R) -> R;

    /// e, J.
    fn energy(self, theta: R) -> R {
        self.free_energy(theta) + theta * self.entropy(theta)
    }

    /// The entropy as `(a, b, c)` of `s = a + b/θ + c ln(θ/θr)`, and θr.
    fn caloric(self) -> Caloric<R>;
}

/// An entropy `a + b/θ + c ln(θ/θr)` over the temperature alone.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Caloric<R> {
    pub(crate) a: R,
    pub(crate) b: R,
    pub(crate) c: f64,
    pub(crate) theta_ref: f64,
}
