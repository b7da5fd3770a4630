//! One element at the three stages of a step.

use super::point::Point;
use super::site::StageSite;
use super::{END, MIDDLE, StageView};
use crate::free_energy::{Array, FreeEnergy};
use crate::group::arms::{arms, points};
use crate::group::begin::shorten;
use crate::group::member::{Member, grown};
use crate::group::variables;
use crate::kinematics::{Arms, Gradient, Kinematics};
use crate::scalar::Real;
use crate::scheme::Variational;

/// The same element as those see it who look at states.
pub(super) type StateMember<S, M, K, const D: usize> = Member<S, M, K, Variational, D>;

/// What one step needs to remember of an element.
pub(super) struct StageMember<S: Real, M: FreeEnergy<S>, K: Kinematics<S, D>, const D: usize> {
    pub(super) site: StageSite<K, S, D>,
    /// s⁰, J/K; zero without temperature.
    pub(super) entropy: S,
    /// The temperatures of the stages, if a thermostat gives them, K.
    pub(super) prescribed: Option<[S; 3]>,
    /// The trial variables `(π, γ, θ)` at the stages.
    pub(super) x: [M::Variables; 3],
    /// The same before the last correction, and the correction; that of `θ_m` follows from the others.
    pub(super) previous: [M::Variables; 3],
    pub(super) correction: [M::Variables; 3],
    /// What the model says there.
    pub(super) points: [Point<S, M>; 3],
    /// `∂π/∂r` there.
    pub(super) gradients: [Gradient<K, S, D>; 3],
    /// The entropy that dashpots and conduction gave it in the step, J/K.
    pub(super) entropy_received: S,
    /// The solved local system, see [`LocalStages`](super::local::LocalStages).
    pub(super) solved: Vec<S>,
}

impl<S, M, K, const D: usize> StageMember<S, M, K, D>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S, D>,
{
    /// Number of local unknowns `(γ_m…, γ¹…, θ_0, θ_1)`.
    pub(super) const UNKNOWNS: usize = 2 * (M::DASHPOTS + M::THERMAL as usize);

    /// Number of inputs `(π_m…, π_1…, Q_0, Q_m)`, what other elements and the nodes decide.
    pub(super) const INPUTS: usize = 2 * (M::MEASURES + M::THERMAL as usize);

    pub(super) fn new(member: &StateMember<S, M, K, D>) -> Self {
        let zeros = [M::Variables::filled(S::zero()); 3];
        let nowhere = Arms::<K, S, D>::filled([S::zero(); D]);
        Self {
            site: StageSite::unconnected(member.site),
            entropy: S::zero(),
            prescribed: None,
            x: zeros,
            previous: zeros,
            correction: zeros,
            points: [(); 3].map(|()| Point::zero()),
            gradients: [Gradient::<K, S, D>::filled(nowhere); 3],
            entropy_received: S::zero(),
            solved: vec![S::zero(); (1 + Self::INPUTS) * Self::UNKNOWNS],
        }
    }

    /// Looks at the old state, where the trial starts.
    pub(super) fn begin(
        &mut self,
        kinematics: K,
        member: &StateMember<S, M, K, D>,
        view: &StageView<'_, S>,
        lengths: &mut [S],
    ) {
        let (nodes, slots) = (&member.site.nodes, member.slots());
        let r0 = arms::<K, S, D>(nodes, points(view.state.positions.values()));
        let measures = kinematics.measure(&r0);
        shorten::<K, S, D>(nodes, &measures, lengths);
        self.gradients[0] = kinematics.gradient(&r0, &measures);
        self.x = [variables::<S, M>(measures.as_ref(), slots, view.state); 3];
        if let Some(slot) = slots.thermal {
            self.entropy = view.state.entropies.values()[slot];
            self.prescribed = view.prescribed(slot);
            let prescribed = self.prescribed.into_iter().flatten();
            for (x, theta) in self.x.iter_mut().zip(prescribed) {
                x[M::Variables::LEN - 1] = theta;
            }
        }
        self.hold();
    }

    /// The temperature of a stage, K; only for elements that have one.
    pub(super) fn temperature(&self, stage: usize) -> S {
        self.x[stage][M::Variables::LEN - 1]
    }

    /// Starts the next correction from the present trial, with none.
    pub(super) fn hold(&mut self) {
        self.previous = self.x;
        self.correction = [M::Variables::filled(S::zero()); 3];
    }

    /// Applies the fraction `share` of the correction: viscous stretches linearly, temperatures
    /// in their logarithms, so that they stay positive.
    pub(super) fn apply(&mut self, share: S) {
        let last = M::Variables::LEN - 1;
        for stage in 0..=END {
            let (previous, change) = (&self.previous[stage], &self.correction[stage]);
            let x = &mut self.x[stage];
            for index in M::MEASURES..M::MEASURES + M::DASHPOTS {
                x[index] = previous[index] + share * change[index];
            }
            if M::THERMAL && stage != MIDDLE {
                let theta = previous[last];
                x[last] = grown(theta, share * change[last]);
            }
        }
        if M::THERMAL && self.prescribed.is_none() {
            let mean = S::from_f64(0.5) * (self.temperature(0) + self.temperature(END));
            self.x[MIDDLE][last] = mean;
        }
    }
}
