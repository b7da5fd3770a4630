//! One element at the stages of a step.

use super::at_stage::AtStage;
use super::site::StageSite;
use crate::element::conjugates::Variational;
use crate::element::group::arms::{add_scaled, arms_in, change_in_set};
use crate::element::group::begin::shorten;
use crate::element::group::element_group::variables;
use crate::element::group::member::Member;
use crate::element::group::point::{Point, grown};
use crate::element::group::view::{StepView, Trial};
use crate::element::kinematics::{Arms, Gradient, Kinematics};
use crate::element::tableau::{MOST_STAGES, Tableau};
use crate::material::free_energy::{Array, FreeEnergy};
use crate::number::scalar::Real;

/// The same element in a state, apart from any step.
pub(super) type StateMember<S, M, K, const D: usize> = Member<S, M, K, Variational, D>;

/// Its point.
pub(super) type StatePoint<S, M, K, const D: usize> = Point<S, M, K, Variational, D>;

/// What one step needs to remember of an element.
pub(super) struct StageMember<S: Real, M: FreeEnergy<S>, K: Kinematics<S, D>, const D: usize> {
    pub(super) kinematics: K,
    pub(super) site: StageSite<K, S, D>,
    /// s⁰, J/K; zero without temperature.
    pub(super) entropy: S,
    /// The temperatures of the stages, if a thermostat gives them, K.
    pub(super) prescribed: Option<[S; MOST_STAGES]>,
    /// The old arms and the unit of viscous stretches, m.
    pub(super) r0: Arms<K, S, D>,
    pub(super) length: S,
    /// γ⁰, m.
    pub(super) old_viscous: M::Viscosities,
    /// The trial variables `(π, γ, θ)` at the stages.
    pub(super) x: [M::Variables; MOST_STAGES],
    /// The same before the last correction, and the correction; temperatures only at the stages whose
    /// temperatures are unknowns.
    previous: [M::Variables; MOST_STAGES],
    pub(super) correction: [M::Variables; MOST_STAGES],
    /// What the model says there.
    pub(super) points: [AtStage<S, M>; MOST_STAGES],
    /// `∂π/∂r` there.
    pub(super) gradients: [Gradient<K, S, D>; MOST_STAGES],
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
    pub(super) fn new(member: &StateMember<S, M, K, D>, rule: &Tableau) -> Self {
        let zeros = [M::Variables::filled(S::zero()); MOST_STAGES];
        let nowhere = Arms::<K, S, D>::filled([S::zero(); D]);
        let length = (1 + inputs::<S, M>(rule)) * unknowns::<S, M>(rule);
        Self {
            kinematics: member.only().kinematics,
            site: StageSite::unconnected(member.site),
            entropy: S::zero(),
            prescribed: None,
            r0: nowhere,
            length: S::one(),
            old_viscous: M::Viscosities::filled(S::zero()),
            x: zeros,
            previous: zeros,
            correction: zeros,
            points: [(); MOST_STAGES].map(|()| AtStage::zero()),
            gradients: [Gradient::<K, S, D>::filled(nowhere); MOST_STAGES],
            entropy_received: S::zero(),
            solved: vec![S::zero(); length],
        }
    }

    /// Takes measures, γ and θ from the old state, where the trial starts.
    pub(super) fn begin(
        &mut self,
        member: &StateMember<S, M, K, D>,
        view: &StepView<'_, S>,
        lengths: &mut [S],
    ) {
        let (nodes, slots) = (&member.site.nodes, member.only().slots());
        self.r0 = arms_in::<K, S, D>(nodes, &view.state.positions);
        let measures = self.kinematics.measure(&self.r0);
        self.length = self.kinematics.length(&measures);
        shorten::<K, S, D>(nodes, self.length, lengths);
        self.gradients = [self.kinematics.gradient(&self.r0, &measures); MOST_STAGES];
        self.x = [variables::<S, M>(measures.as_ref(), slots, view.state); MOST_STAGES];
        for k in 0..M::DASHPOTS {
            self.old_viscous[k] = self.x[0][M::MEASURES + k];
        }
        if let Some(slot) = slots.thermal {
            self.entropy = view.state.entropies.values()[slot];
            self.prescribed = view.prescribed_at_stages(slot);
            let prescribed = self.prescribed.into_iter().flatten();
            for (x, theta) in self.x.iter_mut().zip(prescribed) {
                x[M::Variables::LEN - 1] = theta;
            }
        }
        self.hold();
    }

    /// The arms at the stage of a set of unknowns, m.
    pub(super) fn arms_of_set(&self, set: usize, trial: &Trial<S, D>) -> Arms<K, S, D> {
        let mut r = change_in_set::<K, S, D>(&self.site.common().nodes, trial, set);
        add_scaled::<K, S, D>(&mut r, S::one(), &self.r0);
        r
    }

    /// The same at a stage.
    pub(super) fn arms_at(
        &self,
        rule: &Tableau,
        stage: usize,
        trial: &Trial<S, D>,
    ) -> Arms<K, S, D> {
        match rule.set_of(stage) {
            None => self.r0,
            Some(set) => self.arms_of_set(set, trial),
        }
    }

    /// The temperature of a stage, K; only for elements that have one.
    pub(super) fn temperature(&self, stage: usize) -> S {
        self.x[stage][M::Variables::LEN - 1]
    }

    /// Starts the next correction from the present trial, with none.
    pub(super) fn hold(&mut self) {
        self.previous = self.x;
        self.correction = [M::Variables::filled(S::zero()); MOST_STAGES];
    }

    /// Applies the fraction `share` of the correction: viscous stretches linearly, temperatures
    /// in their logarithms, so that they stay positive.
    pub(super) fn apply(&mut self, rule: &Tableau, share: S) {
        let last = M::Variables::LEN - 1;
        for stage in rule.known..rule.stages() {
            for index in M::MEASURES..M::MEASURES + M::DASHPOTS {
                let change = share * self.correction[stage][index];
                self.x[stage][index] = self.previous[stage][index] + change;
            }
        }
        if !M::THERMAL || self.prescribed.is_some() {
            return;
        }
        for stage in rule.entropies.iter().map(|balance| balance.unknown) {
            let change = share * self.correction[stage][last];
            self.x[stage][last] = grown(self.previous[stage][last], change);
        }
        for (stage, shares) in rule.temperatures.iter().enumerate() {
            let terms = shares.iter().zip(rule.entropies);
            let mean = terms.fold(S::zero(), |sum, (&share, balance)| {
                sum + S::from_f64(share) * self.temperature(balance.unknown)
            });
            self.x[stage][last] = mean;
        }
    }
}

/// Number of local unknowns of an element: `γ…` and then `Θ`, set after set.
pub(super) const fn unknowns<S: Real, M: FreeEnergy<S>>(rule: &Tableau) -> usize {
    rule.sets() * (M::DASHPOTS + M::THERMAL as usize)
}

/// Number of inputs, which other elements and the nodes decide: `π…` set after set, and Q stage after
/// stage.
pub(super) const fn inputs<S: Real, M: FreeEnergy<S>>(rule: &Tableau) -> usize {
    rule.sets() * M::MEASURES + rule.stages() * M::THERMAL as usize
}
