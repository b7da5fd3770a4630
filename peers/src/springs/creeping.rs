//! The thermo-visco-elastic spring of García Orden & Romero (2012), §4.1.
//!
//! ```text
//! x = ln(λ/λ0),   k = k0 − k1 (θ − θr),   μ = μ0 − μ1 (θ − θr),   η = η0 exp(a (1/θ − 1/θr))
//! ψe = k x²/2 − βt (θ − θr) x + c (θ − θr − θ ln(θ/θr))
//! ψ = (1 + βc) ψe + μ γ² − βc γ ∂ψe/∂λ
//! ```

use super::{Caloric, Number, Spring, Stretched};
use crate::single_pendulum::CreepingSpring;

/// Its λ, γ and logarithmic strain.
#[derive(Clone, Copy, Debug)]
pub(crate) struct At<R> {
    data: Data,
    lambda: R,
    gamma: R,
    strain: R,
}

/// The data with the symbols of the formulas.
#[derive(Clone, Copy, Debug)]
struct Data {
    k0: f64,
    k1: f64,
    beta_t: f64,
    beta_c: f64,
    c: f64,
    mu0: f64,
    mu1: f64,
    eta0: f64,
    a: f64,
    theta_ref: f64,
}

impl Spring for CreepingSpring {
    type At<R: Number> = At<R>;

    fn at<R: Number>(&self, lambda: R, gamma: R) -> At<R> {
        let data = Data {
            k0: self.k0,
            k1: self.k1,
            beta_t: self.thermal_coupling,
            beta_c: self.viscous_coupling,
            c: self.capacity,
            mu0: self.mu0,
            mu1: self.mu1,
            eta0: self.eta0,
            a: self.a,
            theta_ref: self.theta_ref,
        };
        let strain = (lambda / self.natural_length).ln();
        At {
            data,
            lambda,
            gamma,
            strain,
        }
    }

    fn capacity(&self) -> f64 {
        (1.0 + self.viscous_coupling) * self.capacity
    }
}

impl<R: Number> At<R> {
    /// θ − θr, K.
    fn heating(self, theta: R) -> R {
        theta - self.data.theta_ref
    }

    /// k, N m.
    fn stiffness(self, theta: R) -> R {
        -(self.heating(theta) * self.data.k1) + self.data.k0
    }

    /// μ, N/m.
    fn modulus(self, theta: R) -> R {
        -(self.heating(theta) * self.data.mu1) + self.data.mu0
    }

    /// ∂ψe/∂λ, N.
    fn elastic_force(self, theta: R) -> R {
        let heating = self.heating(theta);
        (self.stiffness(theta) * self.strain - heating * self.data.beta_t) / self.lambda
    }

    /// ∂²ψe/∂λ∂θ, N/K.
    fn elastic_force_by_theta(self) -> R {
        -(self.strain * self.data.k1 + self.data.beta_t) / self.lambda
    }

    /// ∂³ψe/∂λ²∂θ, N/(K m).
    fn elastic_stiffness_by_theta(self) -> R {
        -(self.elastic_force_by_theta() * self.lambda + self.data.k1) / (self.lambda * self.lambda)
    }

    /// ψe, J.
    fn elastic_energy(self, theta: R) -> R {
        let heating = self.heating(theta);
        let relative = (theta / self.data.theta_ref).ln();
        self.stiffness(theta) * self.strain * self.strain * 0.5
            - heating * self.strain * self.data.beta_t
            + (heating - theta * relative) * self.data.c
    }
}

impl<R: Number> Stretched<R> for At<R> {
    fn force(self, theta: R) -> R {
        let elastic = self.elastic_force(theta);
        let squared = self.lambda * self.lambda;
        let elastic_stiffness = (self.stiffness(theta) - self.lambda * elastic) / squared;
        elastic * (1.0 + self.data.beta_c) - self.gamma * elastic_stiffness * self.data.beta_c
    }

    fn dashpot_force(self, theta: R) -> R {
        self.elastic_force(theta) * self.data.beta_c - self.modulus(theta) * self.gamma * 2.0
    }

    fn viscosity(self, theta: R) -> R {
        ((theta.recip() - self.data.theta_ref.recip()) * self.data.a).exp() * self.data.eta0
    }

    fn entropy(self, theta: R) -> R {
        let Caloric { a, c, .. } = self.caloric();
        a + (theta / self.data.theta_ref).ln() * c
    }

    fn capacity(self, _theta: R) -> R {
        R::from((1.0 + self.data.beta_c) * self.data.c)
    }

    fn slopes(self, _theta: R) -> [R; 2] {
        let Data { beta_c, mu1, .. } = self.data;
        let by_theta = self.elastic_force_by_theta();
        let bent = self.gamma * self.elastic_stiffness_by_theta() * beta_c;
        let by_lambda = bent - by_theta * (1.0 + beta_c);
        [by_lambda, self.gamma * (2.0 * mu1) + by_theta * beta_c]
    }

    fn free_energy(self, theta: R) -> R {
        let Data { beta_c, .. } = self.data;
        self.elastic_energy(theta) * (1.0 + beta_c) + self.modulus(theta) * self.gamma * self.gamma
            - self.gamma * self.elastic_force(theta) * beta_c
    }

    fn caloric(self) -> Caloric<R> {
        let Data {
            k1, beta_t, beta_c, ..
        } = self.data;
        let elastic = (self.strain * (0.5 * k1) + beta_t) * self.strain;
        let viscous = self.gamma * self.gamma * self.data.mu1;
        let mixed = self.gamma * self.elastic_force_by_theta() * beta_c;
        Caloric {
            a: elastic * (1.0 + beta_c) + viscous + mixed,
            b: R::from(0.0),
            c: (1.0 + beta_c) * self.data.c,
            theta_ref: self.data.theta_ref,
        }
    }
}
