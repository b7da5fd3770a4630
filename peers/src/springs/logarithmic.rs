//! The thermoelastic spring of Conde Martín, Betsch & García Orden (2016), eq. (43).
//!
//! ```text
//! x = ln(λ/λ0),   C = C0 − C1 θr ln(θ/θr)
//! ψ = C x²/2 − β (θ − θr) x + c0 (θ − θr − θ ln(θ/θr))
//! ```

use super::{Caloric, Number, Spring, Stretched};
use crate::double_pendulum::ThermoelasticSpring;

/// Its λ and logarithmic strain.
#[derive(Clone, Copy, Debug)]
pub(crate) struct At<R> {
    /// C0, J.
    stiffness: f64,
    /// C1 θr, J.
    softening: f64,
    /// β, J/K.
    coupling: f64,
    /// c0, J/K.
    capacity: f64,
    theta_ref: f64,
    lambda: R,
    strain: R,
}

impl Spring for ThermoelasticSpring {
    type At<R: Number> = At<R>;

    fn at<R: Number>(&self, lambda: R, _gamma: R) -> At<R> {
        At {
            stiffness: self.stiffness,
            softening: self.softening * self.theta_ref,
            coupling: self.coupling,
            capacity: self.capacity,
            theta_ref: self.theta_ref,
            lambda,
            strain: (lambda / self.natural_length).ln(),
        }
    }

    fn capacity(&self) -> f64 {
        self.capacity
    }
}

impl<R: Number> At<R> {
    /// C, J; the logarithm is spared where the stiffness does not depend on temperature.
    fn modulus(self, theta: R) -> R {
        if self.softening == 0.0 {
            return R::from(self.stiffness);
        }
        -((theta / self.theta_ref).ln() * self.softening) + self.stiffness
    }
}

impl<R: Number> Stretched<R> for At<R> {
    fn force(self, theta: R) -> R {
        let heating = theta - self.theta_ref;
        (self.modulus(theta) * self.strain - heating * self.coupling) / self.lambda
    }

    fn dashpot_force(self, _theta: R) -> R {
        R::from(0.0)
    }

    fn viscosity(self, _theta: R) -> R {
        R::from(1.0)
    }

    fn entropy(self, theta: R) -> R {
        let Caloric { a, b, c, .. } = self.caloric();
        a + b / theta + (theta / self.theta_ref).ln() * c
    }

    fn capacity(self, theta: R) -> R {
        -(self.caloric().b / theta) + self.capacity
    }

    fn slopes(self, theta: R) -> [R; 2] {
        let by_lambda = (self.strain * self.softening / theta + self.coupling) / self.lambda;
        [by_lambda, R::from(0.0)]
    }

    fn free_energy(self, theta: R) -> R {
        let heating = theta - self.theta_ref;
        let relative = (theta / self.theta_ref).ln();
        self.modulus(theta) * self.strain * self.strain * 0.5
            - heating * self.strain * self.coupling
            + (heating - theta * relative) * self.capacity
    }

    fn caloric(self) -> Caloric<R> {
        Caloric {
            a: self.strain * self.coupling,
            b: self.strain * self.strain * (0.5 * self.softening),
            c: self.capacity,
            theta_ref: self.theta_ref,
        }
    }
}
