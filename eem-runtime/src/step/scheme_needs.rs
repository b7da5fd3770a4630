//! What a scheme needs of its elements and of its solver.

use crate::element::conjugates::{Conjugates, PointRule};
use crate::element::tableau::{Tableau, UnknownSet};
use crate::step::scheme::{Closing, Scheme};

impl Scheme {
    /// Whether nodes feel forces that the old state alone decides; see
    /// [`implicit`](crate::element::conjugates::ElementScheme::implicit).
    pub(crate) const fn has_old_forces(self) -> bool {
        matches!(self.conjugates(), Conjugates::Point(rule) if rule.has_old_share())
    }

    /// Whether its elements have a
    /// [starting form](crate::element::conjugates::ElementScheme::starting_form).
    pub(crate) const fn has_starting_form(self) -> bool {
        matches!(self.conjugates(), Conjugates::EntropyForm)
    }

    /// Whether mechanics and heat are stepped one after the other.
    pub(crate) const fn is_split(self) -> bool {
        matches!(self, Self::Staggered)
    }

    /// Whether it steps springs with a dashpot beside them: along one gradient, with their heat.
    pub(crate) const fn takes_drag(self) -> bool {
        let takes_none = match self.conjugates() {
            Conjugates::Stages(rule) => rule.path.is_none(),
            Conjugates::Point(PointRule::Variational) => true,
            _ => false,
        };
        !takes_none && !self.is_split()
    }

    /// Whether it takes the end of a step from increments, so that it steps solids, whose masses couple nodes, and
    /// rockets.
    pub(crate) fn ends_by_increments(self) -> bool {
        match self.closing() {
            Closing::Increments => true,
            Closing::Stages => self.tableau().is_some_and(|rule| rule.path.is_some()),
            Closing::Start | Closing::Explicit => false,
        }
    }

    /// The numbers of a scheme that goes through stages.
    pub(crate) const fn tableau(self) -> Option<&'static Tableau> {
        match self.conjugates() {
            Conjugates::Stages(rule) => Some(rule),
            _ => None,
        }
    }

    /// The sets of unknowns.
    pub(crate) fn sets(self) -> Vec<UnknownSet> {
        let Some(rule) = self.tableau() else {
            // `(2m/h)(q¹ − q⁰) − 2p⁰ + h F`: twice that of one stage at the end.
            return vec![UnknownSet {
                time: 1.0,
                inertia: 2.0,
            }];
        };
        let sets = (0..rule.sets()).map(|set| {
            let time = rule.times[rule.stage_of(set)];
            let inertia = time.recip();
            UnknownSet { time, inertia }
        });
        sets.collect()
    }
}
