//! A point among the nodes of its element.

use core::ops::{Deref, DerefMut};

use super::arms::{add_scaled, along};
use super::point::{Point, variables};
use super::pose::{Pose, placed_measures};
use super::respond::TrialArms;
use crate::element::conjugates::{Family, Form, OneSet};
use crate::element::error::StateError;
use crate::element::group::view::{StepView, Trial};
use crate::element::handle::Element;
use crate::element::kinematics::{Arms, Ends, Gradient, Kinematics, Measures};
use crate::element::state::State;
use eem_material::arrays::Arrays;
use eem_material::free_energy::Array;

/// A point, and what it takes to find its measures from the nodes and to bring its forces to them.
pub(crate) struct PlacedPoint<A: Arrays, K: Kinematics<D>, const D: usize> {
    pub(super) kinematics: K,
    /// The derivative of the measures with respect to the new arms.
    pub(super) sensitivity: Gradient<K, D>,
    /// The derivative of `r_s` with respect to the new arms, without that through the measures: through the increments for
    /// a scheme in temperature, through the rates of Kelvin–Voigt dashpots for all classical schemes.
    pub(super) by_increment: Option<Box<Arms<K, D>>>,
    pub(super) point: Point<A, K::Measures>,
}

impl<A: Arrays, K: Kinematics<D>, const D: usize> Deref for PlacedPoint<A, K, D> {
    type Target = Point<A, K::Measures>;

    #[inline]
    fn deref(&self) -> &Self::Target {
        &self.point
    }
}

impl<A: Arrays, K: Kinematics<D>, const D: usize> DerefMut for PlacedPoint<A, K, D> {
    #[inline]
    fn deref_mut(&mut self) -> &mut Self::Target {
        &mut self.point
    }
}

impl<A: Arrays, K: Kinematics<D>, const D: usize> PlacedPoint<A, K, D> {
    /// The index of the temperature among the variables.
    pub(super) const TEMPERATURE: usize = A::MEASURES + A::DASHPOTS;

    pub(super) fn new(kinematics: K, point: Point<A, K::Measures>) -> Self {
        let nowhere = Arms::<K, D>::filled([0.0; D]);
        let is_classical = matches!(point.scheme, OneSet::Point(_));
        Self {
            kinematics,
            sensitivity: Gradient::<K, D>::filled(nowhere),
            by_increment: is_classical.then(|| Box::new(nowhere)),
            point,
        }
    }

    /// Its measures with these arms; an error if the deformation is inadmissible.
    #[inline]
    pub(super) fn admissible_measures(&self, r: &Arms<K, D>) -> Result<Measures<K, D>, StateError> {
        admissible(&self.kinematics, self.point.element, r)
    }

    /// An error unless the deformation given by these arms is admissible.
    #[inline]
    pub(super) fn check_measures(
        &self,
        measures: &Measures<K, D>,
        r: &Arms<K, D>,
    ) -> Result<(), StateError> {
        if self.kinematics.is_admissible(r, measures) {
            return Ok(());
        }
        Err(self.kinematics.refusal(self.point.element, r))
    }

    /// The variables in a state with these arms.
    pub(super) fn variables_in(&self, r: &Arms<K, D>, state: &State) -> A::Variables {
        let measures = self.kinematics.measure(r);
        variables(&self.model, measures.as_ref(), self.point.slots(), state)
    }

    /// The same; an error if the deformation is inadmissible.
    #[inline]
    pub(super) fn locate(&self, r: &Arms<K, D>, state: &State) -> Result<A::Variables, StateError> {
        let measures = self.admissible_measures(r)?;
        Ok(variables(
            &self.model,
            measures.as_ref(),
            self.point.slots(),
            state,
        ))
    }

    /// The measures of arms, and those at which the scheme evaluates the model.
    #[inline]
    pub(super) fn placed<C: Family>(&self, r1: &Arms<K, D>) -> [Measures<K, D>; 2] {
        let measures1 = self.kinematics.measure(r1);
        let at = C::placement(self.point.scheme);
        let placed = placed_measures::<K, D>(at, &self.point.old_measures(), measures1);
        [measures1, placed]
    }

    /// Locates a trial with these arms, see [`Point::locate_trial`]. Returns the measures of the arms that the scheme uses.
    #[expect(
        clippy::inline_always,
        reason = "a call costs 1 % of a step of a spring"
    )]
    #[inline(always)]
    pub(super) fn locate_trial<C: Family>(
        &mut self,
        r1: &Arms<K, D>,
        is_start: bool,
        is_known: bool,
    ) -> Result<Measures<K, D>, StateError> {
        let [measures1, measures] = self.placed::<C>(r1);
        self.check_measures(&measures, r1)?;
        self.point
            .locate_trial::<C>(&measures, is_start, is_known)?;
        Ok(measures1)
    }

    /// The gradients in the configuration that the scheme uses, which has these measures.
    #[inline]
    pub(super) fn pose<C: Family>(
        &self,
        arms: &TrialArms<K, D>,
        measures: &Measures<K, D>,
    ) -> Pose<K, D> {
        let measures = [self.point.old_measures(), *measures];
        let ends = Ends::new(&self.kinematics, [arms.old, arms.placed], measures);
        Pose::new(&self.kinematics, C::placement(self.point.scheme), ends)
    }

    /// Finds the response at a trial, without its tangent, at the end of a step, unless the one stored is known to be right.
    #[expect(
        clippy::inline_always,
        reason = "a call costs 1 % of a step of a spring"
    )]
    #[inline(always)]
    pub(super) fn respond_alone<C: Family>(
        &mut self,
        view: &StepView<'_>,
        trial: &Trial<D>,
        arms: &TrialArms<K, D>,
        is_known: bool,
    ) -> Result<(), StateError> {
        let per_step = view.per_step;
        let measures = self.locate_trial::<C>(&arms.placed, trial.is_start, is_known)?;
        if self.drags() > 0 {
            let pose = self.pose::<C>(arms, &measures);
            self.extend::<C>(&pose, &arms.motion);
        }
        if trial.is_start {
            let form = self.form::<C>(trial.is_start);
            self.accept::<C>(per_step, &form, false)?;
            self.point.response = form.0;
            return Ok(());
        }
        if self.is_thermal() && C::is_in_temperature(self.scheme) {
            let mut form = self.form::<C>(trial.is_start);
            let pose = self.pose::<C>(arms, &measures);
            self.change_entropy_at_rates(view.step, &pose, &arms.motion, &mut form);
            self.accept::<C>(per_step, &form, false)?;
            self.point.response = form.0;
            return Ok(());
        }
        if !is_known {
            let (start, model) = (&self.start, &self.model);
            self.point.response = start.response::<C>(self.scheme, model, &self.x, &self.corners);
        }
        let response = self.point.response;
        self.accept_response::<C>(per_step, &response, is_known)
    }

    /// For a scheme in temperature: calls [`Point::change_entropy_at_rates`] with the increments of the trial.
    pub(super) fn change_entropy_at_rates(
        &mut self,
        step: f64,
        pose: &Pose<K, D>,
        motion: &Arms<K, D>,
        form: &mut Form<A>,
    ) {
        let at = self.point.scheme.placement();
        let (own, by_arm) = pose.increase(&self.kinematics, at, motion);
        let slopes = self.point.change_entropy_at_rates(step, &own, form);
        // Σ_a slope_a ∂Λ_a/∂r¹
        let mut sum = Arms::<K, D>::filled([0.0; D]);
        for (&slope, row) in slopes.as_ref().iter().zip(by_arm.as_ref()) {
            add_scaled::<K, D>(&mut sum, slope, row);
        }
        if let Some(by_increment) = &mut self.by_increment {
            **by_increment = sum;
        }
    }

    /// `D*π·w` per measure, for a motion w of the arms along given gradients.
    #[inline]
    pub(super) fn rates_along(gradient: &Gradient<K, D>, motion: &Arms<K, D>) -> Measures<K, D> {
        let mut rates = Measures::<K, D>::filled(0.0);
        for (rate, row) in rates.as_mut().iter_mut().zip(gradient.as_ref()) {
            *rate = along::<K, D>(row, motion);
        }
        rates
    }
}

/// The measures of these arms; an error if the deformation of the element is inadmissible.
#[inline]
pub(super) fn admissible<K: Kinematics<D>, const D: usize>(
    kinematics: &K,
    element: Element,
    r: &Arms<K, D>,
) -> Result<Measures<K, D>, StateError> {
    let measures = kinematics.measure(r);
    if kinematics.is_admissible(r, &measures) {
        return Ok(measures);
    }
    Err(kinematics.refusal(element, r))
}
