//! One element of a group: its nodes, and the points at which its free energy is evaluated.

use super::arms::{add_scaled, arms_in, change_in};
use super::placed::PlacedPoint;
use super::point::Point;
use super::pose::placed_arms;
use super::respond::TrialArms;
use super::site::Site;
use crate::element::conjugates::{Family, OneSet};
use crate::element::group::view::{Placed, StepView, Trial};
use crate::element::handle::Element;
use crate::element::kinematics::{Arms, Kinematics, Points};
use crate::element::state::State;
use eem_material::arrays::Arrays;
use eem_material::free_energy::Array;
use eem_material::tabled::Tabled;

/// An element.
pub(crate) struct Member<A: Arrays, K: Kinematics<D>, const D: usize> {
    pub(super) site: Site<K, D>,
    /// The old arms.
    pub(super) r0: Arms<K, D>,
    pub(super) points: K::PerPoint<PlacedPoint<A, K, D>>,
}

impl<A: Arrays, K: Kinematics<D>, const D: usize> Member<A, K, D> {
    /// An element whose points have consecutive handles, of which the first is given.
    pub(super) fn new(
        scheme: OneSet,
        (first, points): (Element, K::PerPoint<(Tabled<A>, K)>),
        placed: Placed<'_>,
    ) -> Self {
        let mut parts = points.into_iter();
        Self {
            site: Site::unconnected(placed.nodes.of(first.index())),
            r0: Arms::<K, D>::filled([0.0; D]),
            points: K::PerPoint::from_fn(|point| {
                let element = first.after(point);
                let slots = placed.layout.elements[element.index()];
                let (model, kinematics) = next_of(&mut parts);
                PlacedPoint::new(kinematics, Point::new(scheme, element, model, slots))
            }),
        }
    }

    /// The handle of its first point, and model and kinematics of all points.
    pub(super) fn into_parts(self) -> (Element, K::PerPoint<(Tabled<A>, K)>) {
        let first = self.points.as_ref()[0].element;
        let mut points = self.points.into_iter();
        let parts = K::PerPoint::from_fn(|_| {
            let point = next_of(&mut points);
            (point.point.model, point.kinematics)
        });
        (first, parts)
    }

    /// The first point, the only one of a spring.
    pub(super) fn only(&self) -> &PlacedPoint<A, K, D> {
        &self.points.as_ref()[0]
    }

    /// The scheme of its points.
    #[inline]
    pub(super) fn scheme(&self) -> OneSet {
        self.only().scheme
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
        view: &StepView<'_>,
        trial: &Trial<D>,
    ) -> TrialArms<K, D> {
        TrialArms {
            old: self.r0,
            placed: placed_arms::<K, D>(
                C::placement(self.scheme()),
                &self.r0,
                self.new_arms(trial),
            ),
            motion: self.motion::<C>(view, trial),
        }
    }

    /// The motion `r¹ − r⁰ − (1 − w) h ṙ⁰` of the arms; only schemes in temperature and Kelvin–Voigt dashpots use it.
    #[inline]
    fn motion<C: Family>(&self, view: &StepView<'_>, trial: &Trial<D>) -> Arms<K, D> {
        if !C::is_in_temperature(self.scheme()) && self.only().drags() == 0 {
            return self.r0;
        }
        let rest = (1.0 - C::implicit(self.scheme())) * view.step;
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

/// The next item; there are as many as an element has points.
fn next_of<T>(points: &mut impl Iterator<Item = T>) -> T {
    let next = points.next();
    next.unwrap_or_else(|| unreachable!("one per point"))
}
