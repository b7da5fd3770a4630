//! What is kept of an element that has been closed.

use crate::element::kinematics::{Arms, Gradient, Kinematics};
use crate::material::free_energy::{Array, FreeEnergy, Rates};
use crate::number::scalar::Real;

/// What was found of a point when it was closed last.
#[derive(Clone, Copy)]
pub(super) struct Closed<S: Real, M: FreeEnergy<S>, K: Kinematics<S, D>, const D: usize> {
    /// The temperature at which the model was evaluated, K.
    pub(super) theta: S,
    pub(super) rates: Rates<M::Variables>,
    /// η and dη/dθ.
    pub(super) viscosities: (M::Viscosities, M::Viscosities),
    pub(super) gradient: Gradient<K, S, D>,
}

impl<S: Real, M: FreeEnergy<S>, K: Kinematics<S, D>, const D: usize> Closed<S, M, K, D> {
    /// Nothing yet.
    pub(super) fn none() -> Self {
        let zeros = M::Variables::filled(S::zero());
        let viscosities = M::Viscosities::filled(S::one());
        let nowhere = Arms::<K, S, D>::filled([S::zero(); D]);
        Self {
            theta: S::zero(),
            rates: Rates {
                forces: zeros,
                slopes: zeros,
            },
            viscosities: (viscosities, viscosities),
            gradient: Gradient::<K, S, D>::filled(nowhere),
        }
    }

    /// Forces and viscosities at a temperature that is nearly that of the evaluation:
    /// `∂f/∂θ = −∂s/∂λ`, `∂g/∂θ = ∂s/∂γ`.
    #[inline]
    pub(super) fn at(&self, theta: S) -> (Rates<M::Variables>, M::Viscosities) {
        let change = theta - self.theta;
        let (mut rates, (mut viscosities, slopes)) = (self.rates, self.viscosities);
        for a in 0..M::MEASURES {
            rates.forces[a] -= rates.slopes[a] * change;
        }
        for k in 0..M::DASHPOTS {
            let index = M::MEASURES + k;
            rates.forces[index] += rates.slopes[index] * change;
            viscosities[k] += slopes[k] * change;
        }
        (rates, viscosities)
    }
}
