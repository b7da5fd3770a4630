//! One evaluation of the entropy, and what two local models of it propose.

use crate::free_energy::Caloric;
use crate::scalar::Real;

/// The residual is rounding noise below this many ε of the sum of |terms of S|.
const NOISE: f64 = 4.0;

/// Two logarithms of temperatures are the same within this many ε of `max(1, |ln θ|)`.
const RESOLUTION: f64 = 2.0;

/// Entropies that differ by this factor at the start suggest a power law. Any
/// number of about this size will do: it decides one step.
const LARGE_FACTOR: f64 = 8.0;

/// What the entropy is taken to be between two evaluations.
#[derive(Clone, Copy)]
pub(super) enum Model {
    /// `S` is linear in `ln θ`: constant heat capacity.
    Linear,
    /// `ln S` is linear in `ln θ`: a power of the temperature.
    Logarithmic,
}

/// The entropy at one temperature.
#[derive(Clone, Copy)]
pub(super) struct Point<S> {
    pub(super) x: S,
    pub(super) theta: S,
    pub(super) entropy: S,
    pub(super) heat_capacity: S,
    pub(super) residual: S,
    pub(super) noise: S,
}

impl<S: Real> Point<S> {
    pub(super) fn new(x: S, theta: S, caloric: Caloric<S>, target: S) -> Self {
        Self {
            x,
            theta,
            entropy: caloric.entropy,
            heat_capacity: caloric.heat_capacity,
            residual: caloric.entropy - target,
            noise: S::from_f64(NOISE) * S::EPSILON * caloric.magnitude,
        }
    }

    /// On a stable branch: `0 < C < ∞` and `S` finite.
    pub(super) fn stable(&self) -> bool {
        self.heat_capacity > S::zero()
            && self.heat_capacity.is_finite()
            && self.residual.is_finite()
    }

    /// Newton's correction of `x`.
    pub(super) fn newton(&self) -> S {
        -self.residual / self.heat_capacity
    }

    /// Newton's correction for `ln S`, exact for `S ∝ θⁿ`, if both entropies are positive.
    pub(super) fn logarithmic_newton(&self, target: S) -> Option<S> {
        let positive = self.entropy > S::zero() && target > S::zero();
        positive.then(|| -(self.entropy / self.heat_capacity) * (self.entropy / target).ln())
    }

    /// Before anything is known: a power law if the entropies differ by a large factor.
    pub(super) fn first_model(&self, target: S) -> Model {
        let large = S::from_f64(LARGE_FACTOR);
        if self.entropy > large * target || target > large * self.entropy {
            Model::Logarithmic
        } else {
            Model::Linear
        }
    }

    /// The model that is nearer to the entropy found after a step from here.
    pub(super) fn better_model(&self, step: S, entropy: S) -> Model {
        let growth = self.heat_capacity * step;
        let linear = self.entropy + growth - entropy;
        let logarithmic = self.entropy * (growth / self.entropy).exp() - entropy;
        if logarithmic.abs() < linear.abs() {
            Model::Logarithmic
        } else {
            Model::Linear
        }
    }

    /// The distance in `x` that two temperatures must have to be different.
    pub(super) fn resolution(&self) -> S {
        S::from_f64(RESOLUTION) * S::EPSILON * self.x.abs().maximum(S::one())
    }
}
