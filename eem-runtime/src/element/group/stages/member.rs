//! One element at the stages of a step.

use super::site::{PerPair, StageSite};
use crate::element::conjugates::PointRule;
use crate::element::group::arms::{add_scaled, change_in_set};
use crate::element::group::member::Member;
use crate::element::group::point::Point;
use crate::element::group::site::Contact;
use crate::element::group::view::Trial;
use crate::element::kinematics::{Arms, Kinematics};
use crate::element::tableau::{MOST_SETS, MOST_STAGES, Tableau};
use eem_material::free_energy::{Array, FreeEnergy, Material};
use eem_material::number::scalar::Real;

/// The same element in a state, apart from any step.
pub(super) type StateMember<S, M, K, const D: usize> = Member<S, M, K, PointRule, D>;

/// One of its points.
pub(super) type StatePoint<S, M, K, const D: usize> = Point<S, M, K, PointRule, D>;

/// What one step needs to remember of an element.
pub(crate) struct StageMember<
    S: Real,
    M: Material<S>,
    K: Kinematics<S, D>,
    C: Send + Sync + 'static,
    const D: usize,
> {
    pub(super) site: StageSite<K, S, D>,
    /// The old arms, m.
    pub(super) r0: Arms<K, S, D>,
    /// In memory of their own: those of a cell with many points are large.
    pub(super) points: Vec<StagePoint<S, M, K, C, D>>,
}

/// What one step needs to remember of a point of an element, with its source of conjugates.
pub(crate) struct StagePoint<S: Real, M: FreeEnergy<S>, K: Kinematics<S, D>, C, const D: usize> {
    pub(super) kinematics: K,
    /// Where its seen temperatures are, if it conducts heat to others.
    pub(super) contacts: Option<PerPair<Contact<K, S, D>>>,
    /// s⁰, J/K; zero without temperature.
    pub(super) entropy: S,
    /// The temperatures that a thermostat gives, at the stages or where the rule looks at supports, K.
    pub(super) prescribed: Option<[S; MOST_STAGES]>,
    /// The unit of viscous stretches.
    pub(super) viscous_unit: S,
    /// γ⁰.
    pub(super) old_viscous: M::Viscosities,
    /// The solved local system, see [`LocalStages`](super::local::LocalStages).
    pub(super) solved: Vec<S>,
    /// Where its conjugates come from.
    pub(super) own: C,
}

/// The arms of an element at a trial, m.
pub(crate) struct StageArms<K: Kinematics<S, D>, S: Real, const D: usize> {
    pub(super) old: Arms<K, S, D>,
    /// What they have changed by at the stage of each set of unknowns.
    pub(super) changes: [Arms<K, S, D>; MOST_SETS],
}

impl<K: Kinematics<S, D>, S: Real, const D: usize> StageArms<K, S, D> {
    /// Those at the stage of a set of unknowns.
    pub(super) fn of_set(&self, set: usize) -> Arms<K, S, D> {
        let mut r = self.changes[set];
        add_scaled::<K, S, D>(&mut r, S::one(), &self.old);
        r
    }

    /// Those at a stage.
    pub(super) fn at(&self, rule: &Tableau, stage: usize) -> Arms<K, S, D> {
        match rule.set_of(stage) {
            None => self.old,
            Some(set) => self.of_set(set),
        }
    }
}

impl<S: Real, M: Material<S>, K: Kinematics<S, D>, C: Send + Sync + 'static, const D: usize>
    StageMember<S, M, K, C, D>
{
    /// Its arms at a trial.
    pub(super) fn arms(&self, rule: &Tableau, trial: &Trial<S, D>) -> StageArms<K, S, D> {
        let mut changes = [Arms::<K, S, D>::filled([S::zero(); D]); MOST_SETS];
        for (set, change) in changes.iter_mut().enumerate().take(rule.sets()) {
            *change = change_in_set::<K, S, D>(&self.site.common().nodes, trial, set);
        }
        StageArms {
            old: self.r0,
            changes,
        }
    }
}

/// Number of local unknowns of a point: `γ…` and then `Θ`, set after set.
pub(super) const fn unknowns<S: Real, M: FreeEnergy<S>>(rule: &Tableau) -> usize {
    rule.sets() * (M::DASHPOTS + M::THERMAL as usize)
}
