//! An element before and at the start of a step.

use super::member::{StageMember, StateMember, inputs, unknowns};
use super::site::StageSite;
use super::source::Source;
use crate::element::group::arms::arms_in;
use crate::element::group::begin::shorten;
use crate::element::group::view::StepView;
use crate::element::kinematics::{Arms, Kinematics};
use crate::element::tableau::Tableau;
use crate::material::free_energy::{Array, FreeEnergy};
use crate::number::scalar::Real;

impl<S, M, K, C, const D: usize> StageMember<S, M, K, C, D>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S, D>,
    C: Source<S, M, K, D>,
{
    pub(super) fn new(member: &StateMember<S, M, K, D>, rule: &Tableau) -> Self {
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
            solved: vec![S::zero(); length],
            own: C::new(),
        }
    }

    /// Takes arms, γ and s from the old state, where the trial starts.
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
        for k in 0..M::DASHPOTS {
            self.old_viscous[k] = view.state.viscous.values()[slots.viscous + k];
        }
        if let Some(slot) = slots.thermal {
            self.entropy = view.state.entropies.values()[slot];
            self.prescribed = view.prescribed_at_stages(slot);
        }
        C::begin(self, member.only(), view);
        C::hold(self);
    }
}
