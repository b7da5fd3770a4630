//! An element before and at the start of a step.

use super::member::{StageMember, StagePoint, StateMember, unknowns};
use super::site::StageSite;
use super::source::Source;
use crate::element::group::arms::arms_in;
use crate::element::group::begin::shorten;
use crate::element::group::view::StepView;
use crate::element::kinematics::{Arms, Kinematics};
use crate::element::tableau::Tableau;
use eem_material::free_energy::{Array, Material};
use eem_material::number::scalar::Real;

impl<S: Real, M: Material<S>, K: Kinematics<S, D>, C: Source<S, M, K, D>, const D: usize>
    StageMember<S, M, K, C, D>
{
    pub(super) fn new(member: &StateMember<S, M, K, D>, rule: &Tableau) -> Self {
        let length = (1 + C::inputs_of(rule)) * unknowns::<S, M>(rule);
        Self {
            site: StageSite::unconnected(member.site),
            r0: Arms::<K, S, D>::filled([S::zero(); D]),
            points: (member.points.as_ref().iter())
                .map(|in_state| StagePoint {
                    kinematics: in_state.kinematics,
                    contacts: None,
                    entropy: S::zero(),
                    prescribed: None,
                    viscous_unit: S::one(),
                    old_viscous: M::Viscosities::filled(S::zero()),
                    solved: vec![S::zero(); length],
                    own: C::new(),
                })
                .collect(),
        }
    }

    /// Takes arms, γ and s from the old state, where the trial starts.
    pub(super) fn begin(
        &mut self,
        member: &StateMember<S, M, K, D>,
        view: &StepView<'_, S>,
        lengths: &mut [S],
    ) {
        let nodes = &member.site.nodes;
        self.r0 = arms_in::<K, S, D>(nodes, &view.state.positions);
        let points = self.points.iter_mut();
        for (point, in_state) in points.zip(member.points.as_ref()) {
            let slots = in_state.slots();
            let measures = point.kinematics.measure(&self.r0);
            let length = point.kinematics.length(&measures);
            shorten::<K, S, D>(nodes, length, lengths);
            point.viscous_unit = point.kinematics.unit(&measures);
            for k in 0..M::DASHPOTS {
                point.old_viscous[k] = view.state.viscous.values()[slots.viscous + k];
            }
            if let Some(slot) = slots.thermal {
                point.entropy = view.state.entropies.values()[slot];
                point.prescribed = view.prescribed_at_stages(slot);
            }
            C::begin(point, in_state, view, &self.r0);
            C::hold(point);
        }
    }
}
