//! One evaluation of the entropy, and what two local models of it propose.

use crate::free_energy::Caloric;
use crate::number::scalar::{Mask, Real};

/// The residual is rounding noise below this many ε of the sum of |terms of S|.
const NOISE: f64 = 4.0;

/// Two logarithms of temperatures are the same within this many ε of `max(1, |ln θ|)`.
const RESOLUTION: f64 = 2.0;

/// The heat capacity may change by this part over a correction that is not
/// checked by an evaluation, if it changes at the rate Σ|terms of S|.
const TRUST: f64 = 0.25;

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
    /// `ln θ`.
    pub(super) x: S,
    /// `θ`.
    pub(super) theta: S,
    /// `C = dS/dx`.
    pub(super) heat_capacity: S,
    /// `S − s`.
    pub(super) residual: S,
    /// `S`.
    pub(super) entropy: S,
    /// What of the residual may be rounding.
    noise: S,
}

impl<S: Real> Point<S> {
    /// The point at `θ = eˣ` of a search for the entropy `target`.
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
        S::zero().less(self.heat_capacity).all()
            && self.heat_capacity.is_finite()
            && self.residual.is_finite()
    }

    /// The entropy has increased with the temperature since `other`, as on one stable branch.
    pub(super) fn follows(&self, other: &Self) -> bool {
        let increase = self.residual - other.residual;
        let noise = other.noise + self.noise;
        if self.x.less(other.x).all() {
            increase.at_most(noise).all()
        } else {
            (-noise).at_most(increase).all()
        }
    }

    /// The residual is not more than rounding.
    pub(super) fn is_noise(&self) -> bool {
        self.residual.abs().at_most(self.noise).all()
    }

    /// Newton's correction of `x`.
    pub(super) fn newton(&self) -> S {
        -self.residual / self.heat_capacity
    }

    /// Newton's correction of a converged point, or nothing where it would itself
    /// be noise: next to a spinodal, where it could lead beyond, or with nearly no capacity.
    pub(super) fn last_correction(&self) -> S {
        let correction = self.newton();
        let magnitude = self.noise / (S::from_f64(NOISE) * S::EPSILON);
        let trusted = S::from_f64(TRUST) * self.heat_capacity / magnitude;
        let is_sound = correction.abs().at_most(trusted.maximum(self.resolution()));
        S::select(is_sound, correction, S::zero())
    }

    /// Newton's correction for `ln S`, exact for `S ∝ θⁿ`, if both entropies are positive.
    pub(super) fn logarithmic_newton(&self, target: S) -> Option<S> {
        let positive = S::zero().less(self.entropy) & S::zero().less(target);
        positive
            .all()
            .then(|| -(self.entropy / self.heat_capacity) * (self.entropy / target).ln())
    }

    /// Before anything is known: a power law if the entropies differ by a large factor.
    pub(super) fn first_model(&self, target: S) -> Model {
        let large = S::from_f64(LARGE_FACTOR);
        let differ = (large * target).less(self.entropy) | (large * self.entropy).less(target);
        if differ.all() {
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
        if logarithmic.abs().less(linear.abs()).all() {
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
