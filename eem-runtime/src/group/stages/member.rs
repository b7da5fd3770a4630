//! One element at the three stages of a step.

use super::point::Point;
use super::{END, MIDDLE};
use crate::free_energy::{Array, FreeEnergy};
use crate::group::member::limited;
use crate::scalar::Real;

/// What one step needs to remember of an element.
pub(crate) struct StageMember<S: Real, M: FreeEnergy<S>> {
    /// s⁰, J/K; zero without temperature.
    pub(crate) entropy: S,
    /// The temperatures of the stages, if a thermostat gives them, K.
    pub(crate) prescribed: Option<[S; 3]>,
    /// The trial variables `(π, γ, θ)` at the stages.
    pub(crate) x: [M::Variables; 3],
    /// The same before the last correction, and the correction; that of `θ_m` follows from the others.
    pub(crate) previous: [M::Variables; 3],
    pub(crate) correction: [M::Variables; 3],
    /// What the model says there.
    pub(crate) points: [Point<S, M>; 3],
    /// The entropy that dashpots and conduction gave it in the step, J/K.
    pub(crate) entropy_received: S,
    /// The solved local system, see [`LocalStages`](super::local::LocalStages).
    pub(crate) solved: Vec<S>,
}

impl<S: Real, M: FreeEnergy<S>> StageMember<S, M> {
    pub(crate) fn new() -> Self {
        let zeros = [M::Variables::filled(S::zero()); 3];
        let (unknowns, inputs) = (Self::UNKNOWNS, Self::INPUTS);
        Self {
            entropy: S::zero(),
            prescribed: None,
            x: zeros,
            previous: zeros,
            correction: zeros,
            points: [(); 3].map(|()| Point::zero()),
            entropy_received: S::zero(),
            solved: vec![S::zero(); (1 + inputs) * unknowns],
        }
    }

    /// Number of local unknowns `(γ_m…, γ¹…, θ_0, θ_1)`.
    pub(crate) const UNKNOWNS: usize = 2 * (M::DASHPOTS + M::THERMAL as usize);

    /// Number of inputs `(π_m…, π_1…, Q_0, Q_m)`, what other elements and the nodes decide.
    pub(crate) const INPUTS: usize = 2 * (M::MEASURES + M::THERMAL as usize);

    /// The temperature of a stage, K; only for elements that have one.
    pub(crate) fn temperature(&self, stage: usize) -> S {
        self.x[stage].as_ref()[M::Variables::LEN - 1]
    }

    /// Starts the next correction from the present trial, with none.
    pub(crate) fn hold(&mut self) {
        self.previous = self.x;
        self.correction = [M::Variables::filled(S::zero()); 3];
    }

    /// Applies the fraction `share` of the correction: viscous stretches linearly, temperatures
    /// in their logarithms, so that they stay positive.
    pub(crate) fn apply(&mut self, share: S) {
        let last = M::Variables::LEN - 1;
        for stage in 0..=END {
            let (previous, change) = (
                self.previous[stage].as_ref(),
                self.correction[stage].as_ref(),
            );
            let x = self.x[stage].as_mut();
            for index in M::MEASURES..M::MEASURES + M::DASHPOTS {
                x[index] = previous[index] + share * change[index];
            }
            if M::THERMAL && stage != MIDDLE {
                let theta = previous[last];
                x[last] = theta * limited(share * change[last] / theta).exp();
            }
        }
        if M::THERMAL && self.prescribed.is_none() {
            let mean = S::from_f64(0.5) * (self.temperature(0) + self.temperature(END));
            self.x[MIDDLE].as_mut()[last] = mean;
        }
    }
}
