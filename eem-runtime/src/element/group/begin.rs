//! The old state of the elements, where a step and its trial start.

use super::arms::spread;
use super::member::Member;
use super::placed::PlacedPoint;
use super::point::{Point, grown, variables};
use super::pose::Pose;
use crate::element::conjugates::Family;
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

impl<A: Arrays, K: Kinematics<D>, const D: usize> Member<A, K, D> {
    /// Takes the old state, except what the scheme [keeps](Self::keep) of it.
    #[inline]
    pub(super) fn begin<C: Family>(
        &mut self,
        view: &StepView<'_>,
        old: &mut Old<'_, D>,
    ) -> Result<(), StateError> {
        let r0 = self.arms_in(view.state);
        self.r0 = r0;
        for point in self.points.as_mut() {
            let measures = point.kinematics.measure(&r0);
            point.begin::<C>(view, old.before.as_ref(), &measures);
            let length = point.kinematics.length(&measures);
            shorten::<K, D>(&self.site.nodes, length, old.lengths);
        }
        if C::implicit(self.scheme()) < 1.0 {
            self.take_old_share(view, old.force)?;
        }
        Ok(())
    }

    /// Stores what the scheme keeps of the old state.
    #[inline]
    pub(super) fn keep(&mut self, view: &StepView<'_>) {
        for point in self.points.as_mut() {
            point.keep_old(view);
        }
    }

    /// Finds the part of rates and nodal forces that the scheme takes from the old state.
    fn take_old_share(
        &mut self,
        view: &StepView<'_>,
        old_force: &mut [[f64; D]],
    ) -> Result<(), StateError> {
        let velocities = self.old_velocities(view);
        let share = 1.0 - self.scheme().implicit();
        for point in self.points.as_mut() {
            let measures0 = point.old_measures();
            let by_arm = point.kinematics.gradient(&self.r0, &measures0);
            let rates = PlacedPoint::<A, K, D>::rates_along(&by_arm, &velocities);
            let gradient = point.take_old_share(view, &rates)?;
            let ends = [&self.r0, &self.r0];
            let pose = Pose::between(&point.kinematics, point.scheme.placement(), ends, measures0);
            for (a, row) in pose.direction.as_ref().iter().enumerate() {
                let by_node = spread::<K, D>(row);
                for (entry, &node) in by_node.as_ref().iter().zip(self.site.nodes.as_ref()) {
                    for (force, &entry) in old_force[node as usize].iter_mut().zip(entry) {
                        *force += share * gradient[a] * entry;
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
    fn keep_old(&mut self, view: &StepView<'_>) {
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
    fn take_old_share(
        &mut self,
        view: &StepView<'_>,
        speeds: &Numbers<Q>,
    ) -> Result<A::Variables, StateError> {
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
        if let Some(at_point) = &mut self.single {
            (at_point.old_rates, at_point.old_power) = (rates, old_power);
        }
        if self.is_thermal() && self.scheme.is_in_temperature() {
            self.find_old_heating(speeds, heat / theta);
        }
        Ok(gradient)
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
        if let Some(at_point) = &mut self.single {
            for index in A::MEASURES..last {
                rest -= slope(index) * at_point.old_rates[index];
            }
            at_point.old_heating = rest / slope(last);
            at_point.old_rates[last] = 0.0;
        }
    }
}
