//! One element at the stages of a step.

use super::site::StageSite;
use crate::element::conjugates::PointRule;
use crate::element::group::arms::{add_scaled, change_in_set};
use crate::element::group::member::Member;
use crate::element::group::point::Point;
use crate::element::group::view::Trial;
use crate::element::kinematics::{Arms, Kinematics};
use crate::element::tableau::{MOST_STAGES, Tableau};
use crate::material::free_energy::FreeEnergy;
use crate::number::scalar::Real;

/// The same element in a state, apart from any step.
pub(super) type StateMember<S, M, K, const D: usize> = Member<S, M, K, PointRule, D>;

/// Its point.
pub(super) type StatePoint<S, M, K, const D: usize> = Point<S, M, K, PointRule, D>;

/// What one step needs to remember of an element, with its source of conjugates.
pub(crate) struct StageMember<S, M, K, C, const D: usize>
where
    S: Real,
    M: FreeEnergy<S>,
    K: Kinematics<S, D>,
{
    pub(super) kinematics: K,
    pub(super) site: StageSite<K, S, D>,
    /// s⁰, J/K; zero without temperature.
    pub(super) entropy: S,
    /// The temperatures that a thermostat gives, at the stages or where the rule looks at supports, K.
    pub(super) prescribed: Option<[S; MOST_STAGES]>,
    /// The old arms and the unit of viscous stretches, m.
    pub(super) r0: Arms<K, S, D>,
    pub(super) length: S,
    /// γ⁰, m.
    pub(super) old_viscous: M::Viscosities,
    /// The solved local system, see [`LocalStages`](super::local::LocalStages).
    pub(super) solved: Vec<S>,
    /// Where its conjugates come from.
    pub(super) own: C,
}

impl<S, M, K, C, const D: usize> StageMember<S, M, K, C, D>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S, D>,
{
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
