//! The same free energies as functions of any number, term by term.

use eem::FreeEnergy;
use num_dual::{Dual, DualNum};

use crate::dual_numbers::models::{NeoHookean, PowerHeat, Saturating, TwoDashpots};
use crate::support::{Hencky, LogarithmicStiffness, ThermoViscoElastic};

/// A real or dual number.
pub(crate) trait Number: DualNum<Primitive = f64> + Copy {}

impl<D: DualNum<Primitive = f64> + Copy> Number for D {}

/// A model, written without the derive.
pub(crate) trait Formula: FreeEnergy<f64> {
    /// The model with data.
    fn example() -> Self;

    /// A state in the middle of what the model is for; θ last.
    fn state() -> Vec<f64>;

    /// The terms that ψ(x) is the sum of. Neither the factors of a term nor its derivatives should
    /// cancel: the sum of the |terms| is what errors are measured by.
    fn terms<D: Number>(&self, x: &[D]) -> Vec<D>;

    /// `η_k(θ)`.
    fn viscosities<D: Number>(&self, _theta: D) -> Vec<D> {
        Vec::new()
    }
}

impl ThermoViscoElastic {
    /// The terms of the elastic part.
    fn elastic<D: Number>(&self, lambda: D, theta: D) -> [D; 5] {
        let strain = (lambda / self.natural_length).ln();
        let heating = theta - self.theta_ref;
        [
            strain * strain * (0.5 * self.k0),
            -(heating * strain * strain * (0.5 * self.k1)),
            -(heating * strain * self.coupling),
            heating * self.capacity,
            -(theta * (theta / self.theta_ref).ln() * self.capacity),
        ]
    }
}

impl Formula for ThermoViscoElastic {
    fn example() -> Self {
        Self::PENDULUM
    }

    fn state() -> Vec<f64> {
        vec![1.3, 0.2, 345.0]
    }

    fn terms<D: Number>(&self, x: &[D]) -> Vec<D> {
        let (lambda, gamma, theta) = (x[0], x[1], x[2]);
        let heating = theta - self.theta_ref;
        let elastic = self.elastic(lambda, theta);
        let instantaneous = elastic.map(|term| term * (1.0 + self.ratio));
        let along = Dual::new(lambda, D::one());
        let slopes = self.elastic(along, Dual::from_re(theta));
        let relaxing = slopes.map(|slope| -(gamma * slope.eps * self.ratio));
        let viscous = [
            gamma * gamma * self.mu0,
            -(heating * gamma * gamma * self.mu1),
        ];
        [&instantaneous[..], &viscous, &relaxing].concat()
    }

    fn viscosities<D: Number>(&self, theta: D) -> Vec<D> {
        let exponent = (theta.recip() - 1.0 / self.theta_ref) * self.a;
        vec![exponent.exp() * self.eta0]
    }
}

impl Formula for LogarithmicStiffness {
    fn example() -> Self {
        Self::FIRST
    }

    fn state() -> Vec<f64> {
        vec![3.1, 380.0]
    }

    fn terms<D: Number>(&self, x: &[D]) -> Vec<D> {
        let (lambda, theta) = (x[0], x[1]);
        let strain = (lambda / self.natural_length).ln();
        let logarithm = (theta / self.theta_ref).ln();
        let softening = self.softening * self.theta_ref;
        vec![
            strain * strain * (0.5 * self.stiffness),
            -(strain * strain * logarithm * (0.5 * softening)),
            -((theta - self.theta_ref) * strain * self.coupling),
            (theta - self.theta_ref) * self.capacity,
            -(theta * logarithm * self.capacity),
        ]
    }
}

impl Formula for Hencky {
    fn example() -> Self {
        Self {
            stiffness: 100.0,
            natural_length: 2.0,
        }
    }

    fn state() -> Vec<f64> {
        vec![2.6]
    }

    fn terms<D: Number>(&self, x: &[D]) -> Vec<D> {
        let strain = (x[0] / self.natural_length).ln();
        vec![strain * strain * (0.5 * self.stiffness)]
    }
}

impl Formula for NeoHookean {
    fn example() -> Self {
        Self {
            shear: 3.0,
            length: 0.5,
        }
    }

    fn state() -> Vec<f64> {
        vec![0.8]
    }

    fn terms<D: Number>(&self, x: &[D]) -> Vec<D> {
        let stretch = x[0] / self.length;
        vec![
            stretch.powi(2) * (0.5 * self.shear),
            stretch.recip() * self.shear,
            D::from(-1.5 * self.shear),
        ]
    }
}

impl Formula for TwoDashpots {
    fn example() -> Self {
        Self {
            k: 20.0,
            k_fast: 5.0,
            k_slow: 7.0,
            fall: 0.002,
            coupling: 0.05,
            capacity: 2.0,
            theta_ref: 290.0,
            eta_fast: 4.0,
            eta_slow: 60.0,
            activation: 900.0,
        }
    }

    fn state() -> Vec<f64> {
        vec![1.4, 0.3, -0.1, 320.0]
    }

    fn terms<D: Number>(&self, x: &[D]) -> Vec<D> {
        let (lambda, fast, slow, theta) = (x[0], x[1], x[2], x[3]);
        let heating = theta - self.theta_ref;
        let softening = (heating * -self.fall).exp();
        let strain = lambda.ln();
        vec![
            softening * strain.powi(2) * (0.5 * self.k),
            softening * (strain - fast).powi(2) * (0.5 * self.k_fast),
            softening * (strain - slow).powi(2) * (0.5 * self.k_slow),
            -(heating * strain * self.coupling),
            theta * self.capacity,
            -(theta * (theta / self.theta_ref).ln() * self.capacity),
        ]
    }

    fn viscosities<D: Number>(&self, theta: D) -> Vec<D> {
        let exponent = (theta.recip() - 1.0 / self.theta_ref) * self.activation;
        let ratio = theta.recip() * self.theta_ref;
        vec![
            exponent.exp() * self.eta_fast,
            ratio.powf(1.5) * self.eta_slow,
        ]
    }
}

impl Formula for PowerHeat {
    fn example() -> Self {
        Self {
            modulus: 2.0,
            alpha: 1.3,
            coupling: 0.01,
            capacity: 0.4,
            order: 2.2,
            theta_ref: 300.0,
        }
    }

    fn state() -> Vec<f64> {
        vec![1.3, 310.0]
    }

    fn terms<D: Number>(&self, x: &[D]) -> Vec<D> {
        let (lambda, theta) = (x[0], x[1]);
        let ratio = theta / self.theta_ref;
        let per_order = self.capacity / (self.order * (self.order + 1.0));
        vec![
            ratio * lambda.powf(self.alpha) * (self.modulus / self.alpha),
            ratio * lambda.powf(-0.5 * self.alpha) * (2.0 * self.modulus / self.alpha),
            -(theta.sqrt() * lambda.powi(3) * self.coupling),
            -(theta * ratio.powf(self.order) * per_order),
        ]
    }
}

impl Formula for Saturating {
    fn example() -> Self {
        Self {
            limit: 4.0,
            length: 0.9,
            bond: 1.7,
            mu: 0.6,
            capacity: 0.3,
            eta0: 5.0,
            theta_ref: 280.0,
        }
    }

    fn state() -> Vec<f64> {
        vec![1.2, 0.4, 330.0]
    }

    fn terms<D: Number>(&self, x: &[D]) -> Vec<D> {
        let (lambda, gamma, theta) = (x[0], x[1], x[2]);
        let ratio = theta / self.theta_ref;
        // tanh x = 1 − 2/(e²ˣ + 1): `num-dual` takes sinh x/cosh x, whose derivatives cancel.
        let squared = (lambda * (2.0 / self.length)).exp();
        vec![
            ratio * self.limit,
            -(ratio / (squared + 1.0) * (2.0 * self.limit)),
            lambda.powd(ratio) * self.bond,
            gamma.cosh() / ratio * self.mu,
            -(theta * ratio.ln() * self.capacity),
        ]
    }

    fn viscosities<D: Number>(&self, theta: D) -> Vec<D> {
        vec![(theta.recip() * self.theta_ref).tanh() * self.eta0]
    }
}
