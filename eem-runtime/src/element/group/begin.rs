//! The old state of the elements, where a step and its trial start.

use super::arms::{measures_in, spread};
use super::member::{Block, Member};
use super::placed::{OfGroup, PlacedPoint};
use super::point::{Point, grown, variables};
use super::points::PointSet;
use super::pose::Pose;
use crate::element::conjugates::{Any, Family};
use crate::element::error::StateError;
use crate::element::group::view::{Before, Old, StepView};
use crate::element::kinematics::{Kinematics, MeasureSet, Numbers};
use eem_material::arrays::Arrays;
use eem_material::free_energy::Array;

/// Reduces the unit of length of each node to that of its elements, if that is shorter.
#[inline]
pub(super) fn shorten<K: Kinematics<D>, const D: usize>(
    nodes: &K::PerNode<u32>,
    own: f64,
    lengths: &mut [f64],
) {
    for &node in nodes.as_ref() {
        let length = &mut lengths[node as usize];
        // No NaN: lengths of an admissible state.
        if own < *length {
            *length = own;
        }
    }
}

impl<K: Kinematics<D>, P: ?Sized + PointSet<K::Measures>, const D: usize> Block<K, P, D> {
    /// Takes the old state.
    #[inline]
    pub(super) fn begin<C: Family>(
        &mut self,
        of: OfGroup,
        view: &StepView<'_>,
        old: &mut Old<'_, D>,
    ) -> Result<(), StateError> {
        let (before, mut index) = ((old.before.as_ref(), old.by_factors), 0);
        for member in &mut self.members {
            member.r0 = member.arms_in(view.state);
            for point in member.points.as_mut() {
                let own = point.kinematics.measure(&member.r0);
                point.measures0 = own;
                self.points.begin(index, view, before, &own);
                index += 1;
                let length = point.kinematics.length(&own);
                shorten::<K, D>(&member.site.nodes, length, old.lengths);
            }
        }
        if C::implicit(of.scheme) < 1.0 {
            self.take_old_share(of, view, old.force)?;
        }
        if !C::IS_EXACT && self.points.is_together() {
            self.points.keep_together(view);
        }
        Ok(())
    }

    /// Finds the part of rates and nodal forces that the scheme takes from the old state.
    fn take_old_share(
        &mut self,
        of: OfGroup,
        view: &StepView<'_>,
        old_force: &mut [[f64; D]],
    ) -> Result<(), StateError> {
        let (at, share) = (of.scheme.placement(), 1.0 - of.scheme.implicit());
        let firsts = (0..).step_by(Member::<K, D>::POINTS);
        for (first, member) in firsts.zip(&self.members) {
            let velocities = member.old_velocities(view);
            for (index, point) in (first..).zip(member.points.as_ref()) {
                let by_arm = point.kinematics.gradient(&member.r0, &point.measures0);
                let rates = PlacedPoint::<K, D>::rates_along(&by_arm, &velocities);
                let forces = self.points.take_old_share(index, view, &rates)?;
                let ends = [&member.r0, &member.r0];
                let pose = Pose::between(&point.kinematics, at, ends, point.measures0);
                for (row, &force) in pose.direction.as_ref().iter().zip(forces.as_ref()) {
                    let by_node = spread::<K, D>(row);
                    let nodes = member.site.nodes.as_ref();
                    for (entry, &node) in by_node.as_ref().iter().zip(nodes) {
                        for (sum, &entry) in old_force[node as usize].iter_mut().zip(entry) {
                            *sum += share * force * entry;
                        }
                    }
                }
            }
        }
        Ok(())
    }
}

impl<A: Arrays, Q: MeasureSet> Point<A, Q> {
    /// Takes measures, γ and θ from the old state, where the trial starts unless γ and θ are predicted.
    #[expect(
        clippy::inline_always,
        reason = "a call costs 1 % of a step of two springs"
    )]
    #[inline(always)]
    pub(super) fn begin<C: Family>(
        &mut self,
        view: &StepView<'_>,
        before: Option<&Before<'_>>,
        measures: &Numbers<Q>,
    ) {
        let slots = self.slots();
        let x0 = variables(&self.model, measures.as_ref(), slots, view.state);
        self.start.x0 = x0;
        self.x = x0;
        self.creep = A::Viscosities::filled(0.0);
        if let Some(slot) = slots.thermal {
            let theta = x0[Self::TEMPERATURE];
            self.corners = A::Corners::filled(theta);
            let prescribed = view.prescribed(slot, C::placement(self.scheme));
            self.is_prescribed = prescribed.is_some();
            self.x[Self::TEMPERATURE] = prescribed.unwrap_or(theta);
        }
        if C::is_exact(self.scheme)
            && let Some(before) = before
        {
            self.predict(before);
        }
        if let Some(at_point) = self.single_mut::<C>() {
            at_point.entropy_change = 0.0;
        }
        self.begin_damping::<C>(view);
        self.hold::<C>();
    }

    /// Stores what the scheme keeps of the old state.
    #[inline]
    pub(super) fn keep_old(&mut self, view: &StepView<'_>) {
        let slot = self.slots().thermal;
        let entropy = slot.map_or(0.0, |slot| view.state.entropies.values()[slot]);
        (self.start).keep(self.scheme, &self.model, entropy, self.is_prescribed);
    }

    /// Predicts the internal variables by their changes in the last step: viscous stretches linearly, the temperature by a
    /// factor.
    #[inline]
    fn predict(&mut self, before: &Before<'_>) {
        let slots = self.slots();
        for k in 0..self.dashpots() {
            let index = A::MEASURES + k;
            let old = self.start.x0[index];
            self.creep[k] = before.ratio * (old - before.viscous[slots.viscous + k]);
            self.x[index] = old + self.creep[k];
        }
        if let Some(slot) = slots.thermal.filter(|_| !self.is_prescribed) {
            let old = self.start.x0[Self::TEMPERATURE];
            let change = before.ratio * (old - before.temperatures[slot]);
            self.x[Self::TEMPERATURE] = grown(old, change);
        }
    }

    /// Finds the part of the rates that the scheme takes from the old state, given `π̇⁰`; returns the old gradient.
    pub(super) fn take_old_share(
        &mut self,
        view: &StepView<'_>,
        speeds: &Numbers<Q>,
    ) -> Result<Numbers<Q>, StateError> {
        let share = 1.0 - self.scheme.implicit();
        let x0 = self.start.x0;
        let theta = x0[Self::VARIABLES - 1];
        self.find_viscosities(theta)?;
        let mut gradient = self.model.gradient(&x0);
        let mut rates = A::Variables::filled(0.0);
        let mut heat = self.add_old_drag(speeds, &mut gradient, &mut rates)?;
        for k in 0..self.dashpots() {
            let index = A::MEASURES + k;
            let g = -gradient[index];
            let rate = g / self.viscosities.0[k];
            rates[index] = share * rate;
            heat += g * rate;
        }
        let old_power = share * heat;
        if let Some(slot) = self.slots().thermal {
            let temperatures = &view.state.temperatures;
            heat += view.conduction.heat_flow(slot, theta, temperatures).heat;
            rates[Self::TEMPERATURE] = share * heat / theta;
        }
        if let Some(at_point) = self.single_mut::<Any>() {
            (at_point.old_rates, at_point.old_power) = (rates, old_power);
        }
        if self.is_thermal() && self.scheme.is_in_temperature() {
            self.find_old_heating(speeds, heat / theta);
        }
        Ok(measures_in::<Q>(&gradient))
    }

    /// Finds `(1 − w) θ̇⁰`, which a scheme in temperature uses instead of `(1 − w) ṡ⁰`.
    fn find_old_heating(&mut self, speeds: &Numbers<Q>, entropy_rate: f64) {
        let share = 1.0 - self.scheme.implicit();
        let last = Self::TEMPERATURE;
        let (_, hessian) = self.model.hessian(&self.start.x0);
        // ∂s/∂x = −∂²ψ/∂θ∂x
        let slope = |index: usize| -hessian[last][index];
        let mut rest = share * entropy_rate;
        for a in 0..A::MEASURES {
            rest -= slope(a) * share * speeds[a];
        }
        if let Some(at_point) = self.single_mut::<Any>() {
            for index in A::MEASURES..last {
                rest -= slope(index) * at_point.old_rates[index];
            }
            at_point.old_heating = rest / slope(last);
            at_point.old_rates[last] = 0.0;
        }
    }
}
