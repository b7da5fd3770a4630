//! The response of a point at a trial state, its checks, and what its element is told of it.

use super::arms::measures_in;
use super::point::{Point, temperature_in};
use super::points::{Exchange, TrialView};
use super::site::paths_of;
use crate::element::conjugates::{Any, Family, Form, check_stable};
use crate::element::error::StateError;
use crate::element::handle::Element;
use crate::element::kinematics::{MeasureSet, Numbers};
use eem_material::arrays::Arrays;
use eem_material::free_energy::Array;
use eem_material::number::scalar::is_positive;

impl<A: Arrays, Q: MeasureSet> Point<A, Q> {
    /// Evaluates response and tangent at a trial, and eliminates the internal variables. With a known form, mixed states and viscosities
    /// are those that the point stores.
    #[expect(
        clippy::inline_always,
        reason = "a call costs 1 % of a step of a spring"
    )]
    #[inline(always)]
    pub(super) fn linearize<C: Family>(
        &mut self,
        at: &TrialView<'_>,
        known: Option<&Form<A>>,
        exchange: &mut Exchange<Q>,
    ) -> Result<(), StateError> {
        let view = at.view;
        self.locate_trial::<C>(&exchange.measures, at.is_start, known.is_some())?;
        self.extend(&exchange.increments);
        // Used in place: copies would cost a good part of the time.
        let mut form = known.map_or_else(|| self.form::<C>(at.is_start), |form| *form);
        if !C::IS_EXACT {
            exchange.heat_by_increment = Numbers::<Q>::filled(0.0);
        }
        if self.is_thermal() && C::is_in_temperature(self.scheme) {
            let slopes = self.change_entropy_at_rates(view.step, &exchange.increments, &mut form);
            exchange.heat_by_increment = measures_in::<Q>(&slopes);
        }
        self.accept::<C>(view.per_step, &form, known.is_some())?;
        let elastic = self.add_drag::<C>(view.per_step, &mut form);
        let undamped = self.add_damping::<C>(&mut form);
        let contact = self.contact_in(at.contacts);
        self.condense::<C>(view, at.interface, &form, paths_of(contact))?;
        if self.has_rates::<C>() {
            self.warm_by_rates::<C>(view, &mut exchange.heat_by_increment);
        }
        self.answer::<C>(&form, (at, contact.is_some()), exchange);
        self.keep::<C>(&form);
        self.drop_damping(undamped.as_ref());
        self.drop_drag(&elastic);
        Ok(())
    }

    /// Writes its forces and its temperature as functions of the measures.
    #[expect(
        clippy::inline_always,
        reason = "a call costs 1 % of a step of a spring"
    )]
    #[inline(always)]
    pub(super) fn answer<C: Family>(
        &self,
        form: &Form<A>,
        (at, is_coupled): (&TrialView<'_>, bool),
        exchange: &mut Exchange<Q>,
    ) {
        exchange.heat_factor = self.condensed.heat_factor;
        exchange.contact = if is_coupled { self.contact } else { u32::MAX };
        if is_coupled {
            let row = Self::TEMPERATURE;
            exchange.heat = if C::is_damped(self.scheme) {
                self.condensed_row::<C>(row, &self.conducting::<C>(form), true)
            } else {
                self.condensed_row::<C>(row, form, true)
            };
            let slot = self.slots().thermal.unwrap_or_default();
            exchange.heat.value -= at.interface.values()[slot];
        }
        for a in 0..A::MEASURES {
            exchange.forces[a] = form.0[a];
            exchange.rows[a] = self.condensed_row::<C>(a, form, is_coupled);
        }
        if self.has_rates::<C>() {
            for a in 0..self.drags() {
                exchange.drags[a] = self.drag.viscosity.0[a];
            }
        }
    }

    /// Evaluates the response at a trial without its tangent, unless the one stored is known to be right.
    #[expect(
        clippy::inline_always,
        reason = "a call costs 1 % of a step of a spring"
    )]
    #[inline(always)]
    pub(super) fn respond<C: Family>(
        &mut self,
        at: &TrialView<'_>,
        exchange: &Exchange<Q>,
        is_known: bool,
    ) -> Result<(), StateError> {
        let per_step = at.view.per_step;
        self.locate_trial::<C>(&exchange.measures, at.is_start, is_known)?;
        self.extend(&exchange.increments);
        let is_in_temperature = self.is_thermal() && C::is_in_temperature(self.scheme);
        if at.is_start || is_in_temperature {
            let mut form = self.form::<C>(at.is_start);
            if !at.is_start {
                let step = at.view.step;
                self.change_entropy_at_rates(step, &exchange.increments, &mut form);
            }
            self.accept::<C>(per_step, &form, false)?;
            self.response = form.0;
            return Ok(());
        }
        if !is_known {
            let (start, model) = (&self.start, &self.model);
            self.response = start.response::<C>(self.scheme, model, &self.x, &self.corners);
        }
        let response = self.response;
        self.accept_response::<C>(per_step, &response, is_known)
    }
}

impl<A: Arrays, Q: MeasureSet> Point<A, Q> {
    /// Takes the measures of a trial, and finds its temperature if that is not an unknown, and other values that the form of
    /// the scheme needs, unless those stored are known to be right.
    #[expect(
        clippy::inline_always,
        reason = "a call costs 1 % of a step of a spring"
    )]
    #[inline(always)]
    pub(super) fn locate_trial<C: Family>(
        &mut self,
        measures: &Numbers<Q>,
        is_start: bool,
        is_known: bool,
    ) -> Result<(), StateError> {
        for (a, &measure) in measures.as_ref().iter().enumerate() {
            self.x[a] = measure;
        }
        if self.is_thermal()
            && let Some(at_point) = self.single::<C>()
            && !self.scheme.is_in_temperature()
            && !self.is_prescribed
        {
            let (rule, change) = (self.scheme.point_rule(), at_point.entropy_change);
            let theta = rule.temperature(&self.model, &self.start, &self.x, change);
            let theta = theta.map_err(|infeasible| infeasible.of(self.element))?;
            self.x[Self::TEMPERATURE] = theta;
        }
        if !C::is_exact(self.scheme) {
            return Ok(());
        }
        if !is_start && !is_known {
            (self.start)
                .prepare(&self.model, &self.x, &mut self.corners)
                .map_err(|infeasible| infeasible.of(self.element))?;
        }
        Ok(())
    }

    /// The response and its tangent at the trial that has been located.
    #[inline]
    pub(super) fn form<C: Family>(&self, is_start: bool) -> Form<A> {
        let (start, model, x) = (&self.start, &self.model, &self.x);
        if C::is_exact(self.scheme)
            && is_start
            && let Some(form) = start.starting_form(model, x)
        {
            return form;
        }
        start.form::<C>(self.scheme, model, x, &self.corners)
    }

    /// Finds the viscosities for a response, unless those stored are known to be right; an error if the trial is unstable or a
    /// value is not finite.
    #[inline]
    pub(super) fn accept<C: Family>(
        &mut self,
        per_step: f64,
        form: &Form<A>,
        is_known: bool,
    ) -> Result<(), StateError> {
        if C::is_exact(self.scheme) {
            check_stable(&self.model, &self.x, form)
                .map_err(|infeasible| infeasible.of(self.element))?;
        }
        self.accept_response::<C>(per_step, &form.0, is_known)
    }

    #[expect(
        clippy::inline_always,
        reason = "a call costs 1.5 % of a step of a spring"
    )]
    #[inline(always)]
    pub(super) fn accept_response<C: Family>(
        &mut self,
        per_step: f64,
        response: &A::Response,
        is_known: bool,
    ) -> Result<(), StateError> {
        check_response::<A>(self.element, self.is_thermal(), response)?;
        self.check_conducting::<C>(response)?;
        self.find_drag::<C>(per_step, response)?;
        self.find_damping::<C>()?;
        let theta = temperature_in::<A>(response);
        if is_known {
            return self.check_viscosities(theta);
        }
        self.find_viscosities(theta)
    }

    /// For a scheme in temperature: calls [`PointRule::change_entropy_at_rates`](crate::element::conjugates::PointRule::change_entropy_at_rates), given the increments of the measures;
    /// returns `∂s/∂x`.
    pub(super) fn change_entropy_at_rates(
        &self,
        step: f64,
        measures: &Numbers<Q>,
        form: &mut Form<A>,
    ) -> A::Variables {
        let increments = self.increments(measures, step);
        let (model, start) = (&self.model, &self.start);
        let rule = self.scheme.point_rule();
        rule.change_entropy_at_rates(model, start, &self.x, &increments, form)
    }

    /// The increments of measures, viscous stretches and temperature, less the contribution of the old state.
    fn increments(&self, measures: &Numbers<Q>, step: f64) -> A::Variables {
        let mut increments = A::Variables::filled(0.0);
        let (old, last) = (&self.start.x0, Self::VARIABLES - 1);
        for (a, &increment) in measures.as_ref().iter().enumerate() {
            increments[a] = increment;
        }
        if let Some(at_point) = self.single::<Any>() {
            for index in A::MEASURES..last {
                let change = self.x[index] - old[index];
                increments[index] = change - step * at_point.old_rates[index];
            }
            if self.is_thermal() {
                let change = self.new_temperature(old[last]) - old[last];
                increments[last] = change - step * at_point.old_heating;
            }
        }
        increments
    }
}

/// An error unless the temperature of a response is positive and the response finite.
#[inline]
fn check_response<A: Arrays>(
    element: Element,
    is_thermal: bool,
    response: &A::Response,
) -> Result<(), StateError> {
    if is_thermal {
        check_temperature(element, response[A::MEASURES + A::DASHPOTS])?;
    }
    // Zero for finite numbers, NaN for others.
    let sum = response
        .as_ref()
        .iter()
        .fold(0.0, |sum, &value| sum + 0.0 * value);
    if sum == 0.0 {
        return Ok(());
    }
    Err(not_finite(element, response.as_ref()))
}

#[cold]
fn not_finite(element: Element, response: &[f64]) -> StateError {
    let value = response.iter().find(|value| !value.is_finite());
    StateError::NotFinite {
        element,
        quantity: "force or entropy",
        value: value.copied().unwrap_or(f64::NAN),
    }
}

/// An error unless a temperature is positive and finite.
#[inline]
pub(super) fn check_temperature(element: Element, theta: f64) -> Result<(), StateError> {
    if is_positive(theta) {
        return Ok(());
    }
    let value = theta;
    Err(StateError::Temperature { element, value })
}
