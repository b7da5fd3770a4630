//! Values of an element at a stage, stored when a step is closed.

use crate::element::kinematics::{Arms, Gradient, Kinematics};
use eem_material::free_energy::{Array, FreeEnergy, Rates};

/// The values from which the rates of a point follow.
pub(super) struct Found<M: FreeEnergy<f64>, K: Kinematics<D>, const D: usize> {
    pub(super) theta: f64,
    pub(super) rates: Rates<M::Variables>,
    pub(super) viscosities: M::Viscosities,
    pub(super) gradient: Gradient<K, D>,
}

/// The last evaluation of a point in a closing.
#[derive(Clone, Copy)]
pub(super) struct Closed<M: FreeEnergy<f64>, K: Kinematics<D>, const D: usize> {
    /// The temperature at which the model was evaluated, K.
    pub(super) theta: f64,
    pub(super) rates: Rates<M::Variables>,
    /// η and dη/dθ.
    pub(super) viscosities: (M::Viscosities, M::Viscosities),
    pub(super) gradient: Gradient<K, D>,
    pub(super) values: Values,
}

/// The magnitude of the terms of ψ, and that of the terms of the energy at the same evaluation, J.
#[derive(Clone, Copy)]
pub(super) struct Values {
    magnitude: f64,
    terms: f64,
}

/// The magnitude of ψ is evaluated again when the terms of the energy have changed by this factor.
const CHANGE: f64 = 2.0;

/// Up to this multiple of the terms of the energy, the magnitude of ψ adds nothing to the bound that matters:
/// 8 ε of it are below 64 ε of the terms.
const UNIMPORTANT: f64 = 8.0;

impl Values {
    /// Evaluates the magnitude of ψ where it may matter, given the terms of the energy; otherwise keeps the last one.
    #[inline]
    pub(super) fn update(&mut self, terms: f64, magnitude: impl FnOnce() -> f64) -> f64 {
        let is_near = terms <= CHANGE * self.terms && self.terms <= CHANGE * terms;
        let is_small = self.magnitude <= UNIMPORTANT * terms;
        if !(is_near && is_small) {
            self.magnitude = magnitude();
            self.terms = terms;
        }
        self.magnitude
    }
}

impl<M: FreeEnergy<f64>, K: Kinematics<D>, const D: usize> Closed<M, K, D> {
    /// Nothing yet.
    pub(super) fn none() -> Self {
        let zeros = M::Variables::filled(0.0);
        let viscosities = M::Viscosities::filled(1.0);
        let nowhere = Arms::<K, D>::filled([0.0; D]);
        Self {
            theta: 0.0,
            rates: Rates {
                forces: zeros,
                slopes: zeros,
            },
            viscosities: (viscosities, viscosities),
            gradient: Gradient::<K, D>::filled(nowhere),
            values: Values {
                magnitude: 0.0,
                terms: 0.0,
            },
        }
    }

    /// Forces and viscosities at a temperature that is nearly that of the evaluation:
    /// `∂f/∂θ = −∂s/∂λ`, `∂g/∂θ = ∂s/∂γ`.
    #[inline]
    pub(super) fn at(&self, theta: f64, dashpots: usize) -> Found<M, K, D> {
        let change = theta - self.theta;
        let (mut rates, (mut viscosities, slopes)) = (self.rates, self.viscosities);
        for a in 0..M::MEASURES {
            rates.forces[a] -= rates.slopes[a] * change;
        }
        for k in 0..dashpots {
            let index = M::MEASURES + k;
            rates.forces[index] += rates.slopes[index] * change;
            viscosities[k] += slopes[k] * change;
        }
        Found {
            theta,
            rates,
            viscosities,
            gradient: self.gradient,
        }
    }
}
