//! One element of a group: its nodes, and the points at which its free energy is evaluated; and some of them with their points.

use super::arms::{add_scaled, arms_in, change_in};
use super::placed::{OfGroup, PlacedPoint, TrialArms};
use super::points::PointPlace;
use super::pose::placed_arms;
use super::site::Site;
use crate::element::conjugates::{Family, OneSet};
use crate::element::group::view::{At, Placed, StepView, Trial};
use crate::element::handle::Element;
use crate::element::kinematics::{Arms, Kinematics, Points};
use crate::element::state::State;
use eem_material::free_energy::Array;

/// Some elements, and their points behind a wall.
pub(super) struct Block<K: Kinematics<D>, P: ?Sized, const D: usize> {
    pub(super) members: Vec<Member<K, D>>,
    pub(super) points: Box<P>,
}

/// An element.
pub(crate) struct Member<K: Kinematics<D>, const D: usize> {
    pub(super) site: Site<K, D>,
    /// The old arms.
    pub(super) r0: Arms<K, D>,
    pub(super) points: K::PerPoint<PlacedPoint<K, D>>,
}

/// The elements without a scheme: the handle of the first point of each, and the kinematics of all its points.
pub(crate) type LooseElement<K, const D: usize> = (Element, <K as Kinematics<D>>::PerPoint<K>);

impl<K: Kinematics<D>, const D: usize> Member<K, D> {
    /// Number of points of an element.
    pub(super) const POINTS: usize = K::PerPoint::<()>::LEN;

    /// An element whose points have consecutive handles, of which the first is given.
    pub(super) fn new(
        scheme: OneSet,
        (first, kinematics): &LooseElement<K, D>,
        placed: Placed<'_>,
    ) -> Self {
        let of_point = |point: usize| PlacedPoint::new(kinematics.as_ref()[point], scheme);
        Self {
            site: Site::unconnected(placed.nodes.of(first.index())),
            r0: Arms::<K, D>::filled([0.0; D]),
            points: K::PerPoint::from_fn(of_point),
        }
    }

    /// The kinematics of its points.
    pub(super) fn kinematics(&self) -> K::PerPoint<K> {
        K::PerPoint::from_fn(|point| self.points.as_ref()[point].kinematics)
    }

    /// Its arms in a state.
    #[inline]
    pub(super) fn arms_in(&self, state: &State) -> Arms<K, D> {
        arms_in::<K, D>(&self.site.nodes, &state.positions)
    }

    /// The new arms `r¹ = r⁰ + Δr`.
    #[inline]
    pub(super) fn new_arms(&self, trial: &Trial<D>) -> Arms<K, D> {
        let mut r1 = change_in::<K, D>(&self.site.nodes, trial);
        add_scaled::<K, D>(&mut r1, 1.0, &self.r0);
        r1
    }

    /// Its arms at a trial.
    #[expect(
        clippy::inline_always,
        reason = "a call costs 0.3 % of a step of a spring"
    )]
    #[inline(always)]
    pub(super) fn trial_arms<C: Family>(
        &self,
        of: OfGroup,
        (view, trial): At<'_, D>,
    ) -> TrialArms<K, D> {
        let at = C::placement(of.scheme);
        let mut motion = self.r0;
        if of.has_increments::<C>() {
            motion = self.motion(1.0 - C::implicit(of.scheme), view, trial);
        }
        TrialArms {
            old: self.r0,
            placed: placed_arms::<K, D>(at, &self.r0, self.new_arms(trial)),
            motion,
        }
    }

    /// The motion `r¹ − r⁰ − share h ṙ⁰` of the arms.
    #[inline(never)]
    fn motion(&self, share: f64, view: &StepView<'_>, trial: &Trial<D>) -> Arms<K, D> {
        let rest = share * view.step;
        let mut motion = change_in::<K, D>(&self.site.nodes, trial);
        let velocities = self.old_velocities(view);
        add_scaled::<K, D>(&mut motion, -rest, &velocities);
        motion
    }

    /// The old velocities of the arms; those of anchors are means over the step, m/s.
    pub(super) fn old_velocities(&self, view: &StepView<'_>) -> Arms<K, D> {
        let velocity = |node: u32| view.old_velocity::<D>(node as usize);
        let nodes = self.site.nodes.as_ref();
        let first = velocity(nodes[0]);
        let mut velocities = Arms::<K, D>::filled([0.0; D]);
        for (arm, &node) in velocities.as_mut().iter_mut().zip(&nodes[1..]) {
            *arm = velocity(node);
            for (component, &first) in arm.iter_mut().zip(&first) {
                *component -= first;
            }
        }
        velocities
    }
}

impl<K: Kinematics<D>, P: ?Sized, const D: usize> Block<K, P, D> {
    /// Each element with the index of its first point.
    pub(super) fn elements(&self) -> impl Iterator<Item = (usize, &Member<K, D>)> {
        let members = self.members.iter().enumerate();
        members.map(|(index, member)| (index * Member::<K, D>::POINTS, member))
    }
}

/// The places of all points of elements.
pub(super) fn places<'a, K: Kinematics<D>, const D: usize>(
    elements: &'a [LooseElement<K, D>],
    placed: Placed<'a>,
) -> impl Iterator<Item = PointPlace> + 'a {
    elements.iter().flat_map(move |(first, _)| {
        (0..Member::<K, D>::POINTS).map(move |point| {
            let element = first.after(point);
            (element, placed.layout.elements[element.index()])
        })
    })
}
