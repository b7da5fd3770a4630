//! One element at the stages of a step, and one of its points.

use super::site::{PerPair, StageSite};
use crate::element::conjugates::PointRule;
use crate::element::group::arms::{add_scaled, arms_in, change_in_set};
use crate::element::group::member::Member;
use crate::element::group::point::Point;
use crate::element::group::site::Contact;
use crate::element::group::view::{StepView, Trial};
use crate::element::kinematics::{Arms, Kinematics};
use crate::element::tableau::{MOST_SETS, MOST_STAGES, Tableau};
use eem_material::free_energy::Array;
use eem_material::number::scalar::Real;

/// The same element in a state, apart from any step.
pub(super) type StateMember<S, M, K, const D: usize> = Member<S, M, K, PointRule, D>;

/// One of its points.
pub(super) type StatePoint<S, M, K, const D: usize> = Point<S, M, K, PointRule, D>;

/// An element, whose points are [sources](super::source::Source) of conjugates.
pub(crate) struct StageMember<K: Kinematics<S, D>, S: Real, C, const D: usize> {
    pub(super) site: StageSite<K, S, D>,
    /// On the heap: those of a cell with many points are large.
    pub(super) points: Vec<C>,
}

/// A point of an element, apart from its conjugates.
pub(crate) struct StagePoint<K: Kinematics<S, D>, S: Real, const D: usize> {
    pub(super) rule: &'static Tableau,
    pub(super) kinematics: K,
    /// The matrix indices of its coupled interface temperatures, if it conducts heat to other elements.
    pub(super) contacts: Option<PerPair<Contact<K, S, D>>>,
    /// s⁰, J/K; zero without temperature.
    pub(super) entropy: S,
    /// The temperatures of a thermostat at the stages, or at the supports of the path, K.
    pub(super) prescribed: Option<[S; MOST_STAGES]>,
    /// The unit of viscous stretches.
    pub(super) viscous_unit: S,
    /// The solved local system, see [`LocalStages`](super::local::LocalStages).
    pub(super) solved: Vec<S>,
}

/// The arms of an element at a trial, m.
pub(crate) struct StageArms<K: Kinematics<S, D>, S: Real, const D: usize> {
    pub(super) old: Arms<K, S, D>,
    /// Their changes at the stage of each set of unknowns.
    pub(super) changes: [Arms<K, S, D>; MOST_SETS],
}

impl<K: Kinematics<S, D>, S: Real, const D: usize> StageArms<K, S, D> {
    /// Of the element with these nodes.
    pub(super) fn new(
        rule: &Tableau,
        nodes: &K::PerNode<u32>,
        (view, trial): (&StepView<'_, S>, &Trial<S, D>),
    ) -> Self {
        let mut changes = [Arms::<K, S, D>::filled([S::zero(); D]); MOST_SETS];
        for (set, change) in changes.iter_mut().enumerate().take(rule.sets()) {
            *change = change_in_set::<K, S, D>(nodes, trial, set);
        }
        let old = arms_in::<K, S, D>(nodes, &view.state.positions);
        Self { old, changes }
    }

    /// Those at the stage of a set of unknowns.
    pub(super) fn of_set(&self, set: usize) -> Arms<K, S, D> {
        let mut r = self.changes[set];
        add_scaled::<K, S, D>(&mut r, S::one(), &self.old);
        r
    }
}
