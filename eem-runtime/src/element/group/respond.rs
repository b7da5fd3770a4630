//! The response of the elements at a trial state, and its checks.

use super::arms::{add_scaled, measures_in};
use super::point::{Known, Point, Viscosities, temperature_in};
use super::pose::{Pose, placed_measures};
use crate::element::conjugates::{ElementScheme, Form};
use crate::element::error::StateError;
use crate::element::group::view::{StepView, Trial};
use crate::element::handle::Element;
use crate::element::kinematics::{Arms, Ends, Kinematics, Measures};
use eem_material::free_energy::{Array, FreeEnergy, Material};
use eem_material::number::scalar::is_positive;

/// Arms of an element at a trial.
pub(super) struct TrialArms<K: Kinematics<D>, const D: usize> {
    pub(super) old: Arms<K, D>,
    /// The new arms, or the mean ones for a scheme at the midpoint.
    pub(super) placed: Arms<K, D>,
    /// `r¹ − r⁰ − (1 − w) h ṙ⁰`; only schemes in temperature and Kelvin–Voigt dashpots use it.
    pub(super) motion: Arms<K, D>,
}

impl<M: Material, K: Kinematics<D>, C: ElementScheme<M>, const D: usize> Point<M, K, C, D> {
    /// Finds the measures of the trial state, its temperature if that is not an unknown, and other values that the form
    /// of the scheme needs, unless they are known. Returns the measures of the arms that the scheme uses.
    #[inline]
    pub(super) fn locate_trial(
        &mut self,
        r1: &Arms<K, D>,
        trial: &Trial<D>,
        prepared: Option<C::Memory>,
    ) -> Result<Measures<K, D>, StateError> {
        let [measures1, measures] = self.placed(r1);
        check_measures::<K, D>(&self.kinematics, self.element, &measures, r1)?;
        for (a, &measure) in measures.as_ref().iter().enumerate() {
            self.x[a] = measure;
        }
        if M::THERMAL && !self.scheme.is_in_temperature() && !self.is_prescribed {
            for at_point in self.single.as_ref() {
                let change = at_point.entropy_change;
                let theta = self
                    .scheme
                    .temperature(&self.model, &self.start, &self.x, change);
                let theta = theta.map_err(|infeasible| infeasible.of(self.element))?;
                self.x[Self::TEMPERATURE] = theta;
            }
        }
        if let Some(prepared) = prepared {
            self.memory = prepared;
        } else if !trial.is_start {
            C::prepare(&self.model, &self.start, &self.x, &mut self.memory)
                .map_err(|infeasible| infeasible.of(self.element))?;
        }
        Ok(measures1)
    }

    /// The measures of arms, and those at which the scheme evaluates the model.
    #[inline]
    pub(super) fn placed(&self, r1: &Arms<K, D>) -> [Measures<K, D>; 2] {
        let measures1 = self.kinematics.measure(r1);
        let measures0 = measures_in::<K, D>(&self.start.x0);
        let placed = placed_measures::<K, D>(self.scheme.placement(), &measures0, measures1);
        [measures1, placed]
    }

    /// The gradients in the configuration that the scheme uses, which has these measures.
    #[inline]
    pub(super) fn pose(&self, arms: &TrialArms<K, D>, measures: &Measures<K, D>) -> Pose<K, D> {
        let measures = [measures_in::<K, D>(&self.start.x0), *measures];
        let ends = Ends::new(&self.kinematics, [arms.old, arms.placed], measures);
        Pose::new(&self.kinematics, self.scheme.placement(), ends)
    }

    /// The response and its tangent at the trial that has been located.
    #[inline]
    pub(super) fn form(&self, trial: &Trial<D>) -> Form<f64, M> {
        if trial.is_start
            && let Some(form) = C::starting_form(&self.model, &self.start, &self.x)
        {
            return form;
        }
        self.scheme
            .form(&self.model, &self.start, &self.x, &self.memory)
    }

    /// Finds the viscosities for a response, unless they are known; an error if the trial is unstable or a value is not
    /// finite.
    #[inline]
    pub(super) fn accept(
        &mut self,
        per_step: f64,
        form: &Form<f64, M>,
        known: Option<Viscosities<M>>,
    ) -> Result<(), StateError> {
        C::check(&self.x, form).map_err(|infeasible| infeasible.of(self.element))?;
        self.accept_response(per_step, &form.0, known)
    }

    /// Finds the response at a trial, without its tangent, at the end of a step. The response may be known.
    #[inline]
    pub(super) fn respond_alone(
        &mut self,
        view: &StepView<'_>,
        trial: &Trial<D>,
        arms: &TrialArms<K, D>,
        known: Known<C::Memory, M::Response, M>,
    ) -> Result<(), StateError> {
        let per_step = view.per_step;
        let prepared = known.map(|(prepared, ..)| prepared);
        let measures = self.locate_trial(&arms.placed, trial, prepared)?;
        if Self::DRAGS > 0 {
            let pose = self.pose(arms, &measures);
            self.extend(&pose, &arms.motion);
        }
        if trial.is_start {
            let form = self.form(trial);
            self.accept(per_step, &form, None)?;
            self.response = form.0;
            return Ok(());
        }
        if M::THERMAL && self.scheme.is_in_temperature() {
            let mut form = self.form(trial);
            let pose = self.pose(arms, &measures);
            self.change_entropy_at_rates(view.step, &pose, &arms.motion, &mut form);
            self.accept(per_step, &form, None)?;
            self.response = form.0;
            return Ok(());
        }
        self.response = known.map_or_else(
            || {
                self.scheme
                    .response(&self.model, &self.start, &self.x, &self.memory)
            },
            |(_, response, _)| response,
        );
        let response = self.response;
        self.accept_response(per_step, &response, known.map(|known| known.2))
    }

    #[inline]
    fn accept_response(
        &mut self,
        per_step: f64,
        response: &M::Response,
        known: Option<Viscosities<M>>,
    ) -> Result<(), StateError> {
        check_response::<M>(self.element, response)?;
        self.check_conducting(response)?;
        self.find_drag(per_step, response)?;
        self.find_damping()?;
        self.find_viscosities(temperature_in::<M>(response), known)
    }

    /// For a scheme in temperature: calls [`ElementScheme::change_entropy_at_rates`] with the increments of the trial.
    pub(super) fn change_entropy_at_rates(
        &mut self,
        step: f64,
        pose: &Pose<K, D>,
        motion: &Arms<K, D>,
        form: &mut Form<f64, M>,
    ) {
        let (own, by_arm) = pose.increase(&self.kinematics, self.scheme.placement(), motion);
        let increments = self.increments(&own, step);
        let (model, start) = (&self.model, &self.start);
        let slopes = self
            .scheme
            .change_entropy_at_rates(model, start, &self.x, &increments, form);
        for at_point in self.single.as_mut() {
            at_point.by_increment = combined::<K, M, D>(&slopes, by_arm.as_ref());
        }
    }

    /// The increments of measures, viscous stretches and temperature, less the contribution of the old state.
    fn increments(&self, measures: &Measures<K, D>, step: f64) -> M::Variables {
        let mut increments = M::Variables::filled(0.0);
        let (old, last) = (&self.start.x0, Self::VARIABLES - 1);
        for (a, &increment) in measures.as_ref().iter().enumerate() {
            increments[a] = increment;
        }
        for at_point in self.single.as_ref() {
            for index in M::MEASURES..last {
                let change = self.x[index] - old[index];
                increments[index] = change - step * at_point.old_rates[index];
            }
            if M::THERMAL {
                let change = self.new_temperature(old[last]) - old[last];
                increments[last] = change - step * at_point.old_heating;
            }
        }
        increments
    }
}

/// `Σ_a slope_a ∂Λ_a/∂r¹`.
fn combined<K: Kinematics<D>, M: FreeEnergy<f64>, const D: usize>(
    slopes: &M::Variables,
    by_arm: &[Arms<K, D>],
) -> Arms<K, D> {
    let mut sum = Arms::<K, D>::filled([0.0; D]);
    for (&slope, row) in slopes.as_ref().iter().zip(by_arm) {
        add_scaled::<K, D>(&mut sum, slope, row);
    }
    sum
}

/// An error unless the deformation given by these arms is admissible.
#[inline]
pub(super) fn check_measures<K: Kinematics<D>, const D: usize>(
    kinematics: &K,
    element: Element,
    measures: &Measures<K, D>,
    r: &Arms<K, D>,
) -> Result<(), StateError> {
    if kinematics.is_admissible(r, measures) {
        return Ok(());
    }
    Err(kinematics.refusal(element, r))
}

/// An error unless the temperature of a response is positive and the response finite.
#[inline]
fn check_response<M: FreeEnergy<f64>>(
    element: Element,
    response: &M::Response,
) -> Result<(), StateError> {
    if M::THERMAL {
        check_temperature(element, response[M::MEASURES + M::DASHPOTS])?;
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
