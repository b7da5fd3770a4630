//! A point among the nodes of its element.

use super::arms::{add_scaled, along};
use super::points::Exchange;
use super::pose::{Pose, placed_measures};
use crate::element::conjugates::{Family, OneSet, Placement};
use crate::element::error::StateError;
use crate::element::handle::Element;
use crate::element::kinematics::{Arms, Ends, Gradient, Kinematics, Measures};
use crate::element::layout::Shape;
use eem_material::free_energy::Array;

/// What it takes to find the measures of a point from the nodes and to bring its forces to them.
pub(crate) struct PlacedPoint<K: Kinematics<D>, const D: usize> {
    pub(super) kinematics: K,
    /// The old measures, and those of the trial at which the scheme evaluates.
    pub(super) measures0: Measures<K, D>,
    pub(super) measures: Measures<K, D>,
    /// The derivative of the measures with respect to the new arms.
    pub(super) sensitivity: Gradient<K, D>,
    /// The derivative of `r_s` with respect to the new arms, without that through the measures: through the increments for
    /// a scheme in temperature, through the rates of Kelvin–Voigt dashpots for all classical schemes.
    pub(super) by_increment: Option<Box<Arms<K, D>>>,
}

/// Scheme and models of a group, as far as its nodes know them.
#[derive(Clone, Copy, Debug)]
pub(super) struct OfGroup {
    pub(super) scheme: OneSet,
    /// Whether the points have Kelvin–Voigt dashpots, temperatures, unknowns of their own.
    pub(super) has_drag: bool,
    pub(super) is_thermal: bool,
    pub(super) has_unknowns: bool,
}

impl OfGroup {
    pub(super) fn new(scheme: OneSet, shape: &Shape) -> Self {
        Self {
            scheme,
            has_drag: shape.drag,
            is_thermal: shape.thermal,
            has_unknowns: shape.thermal || shape.dashpots > 0,
        }
    }

    /// Whether the points need the increments of their measures. Elements of a known family have no Kelvin–Voigt dashpots.
    #[inline]
    pub(super) fn has_increments<C: Family>(self) -> bool {
        !C::IS_EXACT && (self.has_drag || self.is_thermal && self.scheme.is_in_temperature())
    }
}

/// Arms of an element at a trial.
pub(super) struct TrialArms<K: Kinematics<D>, const D: usize> {
    pub(super) old: Arms<K, D>,
    /// The new arms, or the mean ones for a scheme at the midpoint.
    pub(super) placed: Arms<K, D>,
    /// `r¹ − r⁰ − (1 − w) h ṙ⁰`; only schemes in temperature and Kelvin–Voigt dashpots use it.
    pub(super) motion: Arms<K, D>,
}

impl<K: Kinematics<D>, const D: usize> PlacedPoint<K, D> {
    pub(super) fn new(kinematics: K, scheme: OneSet) -> Self {
        let nowhere = Arms::<K, D>::filled([0.0; D]);
        let measures = Measures::<K, D>::filled(0.0);
        let is_classical = matches!(scheme, OneSet::Point(_));
        Self {
            kinematics,
            measures0: measures,
            measures,
            sensitivity: Gradient::<K, D>::filled(nowhere),
            by_increment: is_classical.then(|| Box::new(nowhere)),
        }
    }

    /// Finds the measures of a trial, and their increments if they are needed; false if the deformation is inadmissible.
    #[expect(
        clippy::inline_always,
        reason = "a call costs 1 % of a step of a spring"
    )]
    #[inline(always)]
    pub(super) fn place<C: Family>(
        &mut self,
        of: OfGroup,
        arms: &TrialArms<K, D>,
        exchange: &mut Exchange<K::Measures>,
    ) -> bool {
        if !self.measure::<C>(of, arms) {
            return false;
        }
        exchange.measures = self.measures;
        if of.has_increments::<C>() {
            let at = C::placement(of.scheme);
            let pose = self.pose::<C>(of, arms);
            exchange.increments = if C::is_exact(of.scheme) {
                Self::rates_along(&pose.direction, &arms.motion)
            } else {
                pose.increase(&self.kinematics, at, &arms.motion).0
            };
        }
        true
    }

    /// Finds the measures of a trial; false if the deformation is inadmissible.
    #[inline]
    pub(super) fn measure<C: Family>(&mut self, of: OfGroup, arms: &TrialArms<K, D>) -> bool {
        let measures = self.kinematics.measure(&arms.placed);
        let at = C::placement(of.scheme);
        self.measures = placed_measures::<K, D>(at, &self.measures0, measures);
        (self.kinematics).is_admissible(&arms.placed, &self.measures)
    }

    /// The gradients in the configuration that the scheme uses.
    #[inline]
    pub(super) fn pose<C: Family>(&self, of: OfGroup, arms: &TrialArms<K, D>) -> Pose<K, D> {
        let mut measures = [self.measures0, self.measures];
        if !C::IS_EXACT && C::placement(of.scheme) == Placement::Start {
            measures[1] = self.kinematics.measure(&arms.placed);
        }
        let ends = Ends::new(&self.kinematics, [arms.old, arms.placed], measures);
        Pose::new(&self.kinematics, C::placement(of.scheme), ends)
    }

    /// Takes the derivatives of measures and, for classical schemes, of the heat balance with respect to the new arms; returns those of
    /// the increments.
    #[inline]
    pub(super) fn take_sensitivity<C: Family>(
        &mut self,
        of: OfGroup,
        pose: &Pose<K, D>,
        arms: &TrialArms<K, D>,
        exchange: &Exchange<K::Measures>,
    ) -> Option<Gradient<K, D>> {
        self.sensitivity = pose.sensitivity;
        if C::is_exact(of.scheme) || !of.has_increments::<C>() {
            return None;
        }
        let at = C::placement(of.scheme);
        let (_, by_arm) = pose.increase(&self.kinematics, at, &arms.motion);
        if let Some(by_increment) = &mut self.by_increment {
            let mut sum = Arms::<K, D>::filled([0.0; D]);
            let slopes = exchange.heat_by_increment.as_ref().iter();
            for (&slope, row) in slopes.zip(by_arm.as_ref()) {
                add_scaled::<K, D>(&mut sum, slope, row);
            }
            **by_increment = sum;
        }
        Some(by_arm)
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
