//! A material behind its table.

use core::any::Any;

use crate::formulas::{Arrays, ArraysOf, ByParameters, Formulas, MOST_PARAMETERS};
use crate::free_energy::{Array, Caloric, FreeEnergy, Material, Rates, TogetherOf};
use crate::inversion::Inverse;

/// A material behind its table.
///
/// If the arrays have room for a dashpot in parallel, it may be missing, as dashpots in series and the temperature may.
pub struct Tabled<A: Arrays> {
    formulas: Box<dyn Formulas<A>>,
    has_constant_capacity: bool,
    dashpots: usize,
    drags: usize,
    is_thermal: bool,
    viscous_strain: usize,
}

impl<A: Arrays> Tabled<A> {
    /// Whether the materials may lack some of the variables.
    const HAS_ROOM: bool = A::Drag::LEN > 0;

    /// Whether a material has these arrays.
    #[must_use]
    pub const fn is_for<M: Material>() -> bool {
        M::MEASURES == A::MEASURES
            && !M::PER_VOLUME
            && M::DASHPOTS == A::DASHPOTS
            && M::THERMAL == A::THERMAL
            && M::Viscosities::LEN == A::Viscosities::LEN
            && M::Drag::LEN == A::Drag::LEN
            && M::Variables::LEN == A::Variables::LEN
            && M::Corners::LEN == A::Corners::LEN
            && M::Response::LEN == A::Response::LEN
            && M::Parameters::LEN <= MOST_PARAMETERS
    }

    /// A material that [has these arrays](Self::is_for); P is that of its measures.
    #[must_use]
    pub fn new<M: Material, P: Array<f64>>(material: M) -> Self {
        let formulas: Box<dyn Formulas<ArraysOf<M, P, A::Kept>>> = Box::new(material);
        let mut formulas = Some(formulas);
        // The same type by another name.
        let same: &mut dyn Any = &mut formulas;
        let same: Option<&mut Option<Box<dyn Formulas<A>>>> = same.downcast_mut();
        let Some(formulas) = same.and_then(Option::take) else {
            unreachable!("materials with these numbers of variables have this table")
        };
        let facts = formulas.facts();
        Self {
            formulas,
            has_constant_capacity: facts.has_constant_capacity,
            dashpots: facts.dashpots,
            drags: facts.drags,
            is_thermal: facts.is_thermal,
            viscous_strain: facts.viscous_strain,
        }
    }
}

impl<A: Arrays> FreeEnergy<f64> for Tabled<A> {
    const MEASURES: usize = A::MEASURES;
    const DASHPOTS: usize = A::DASHPOTS;
    const THERMAL: bool = A::THERMAL;
    const MAY_BE_TOGETHER: bool = true;
    const MODEL: &'static str = "material";
    /// Empty: the names are known at run time, see `parameter_names`.
    const PARAMETERS: &'static [&'static str] = &[];

    type Parameters = ByParameters;
    type Variables = A::Variables;
    type Hessian = A::Hessian;
    type Viscosities = A::Viscosities;
    type Drag = A::Drag;
    type Corners = A::Corners;
    type Response = A::Response;
    type Tangent = A::Tangent;
    type EntropyFormOld = A::Kept;
    type TemperatureFormOld = A::Kept;

    fn duplicate(&self) -> Self {
        Self {
            formulas: self.formulas.duplicate(),
            ..*self
        }
    }

    fn as_any(&self) -> &dyn Any {
        self.formulas.as_any()
    }

    fn model(&self) -> &'static &'static str {
        self.formulas.facts().model
    }

    fn kind(&self) -> u64 {
        self.formulas.facts().kind
    }

    #[inline]
    fn together(&self) -> Option<&TogetherOf<Self>> {
        self.formulas.together()
    }

    fn parameter_count(&self) -> usize {
        self.formulas.facts().parameter_count
    }

    fn parameter_names(&self) -> &'static [&'static str] {
        self.formulas.parameter_names()
    }

    fn parameter_units(&self) -> &'static [&'static str] {
        self.formulas.facts().parameter_units
    }

    fn has_parameter_derivatives(&self) -> bool {
        self.formulas.facts().has_parameter_derivatives
    }

    #[inline]
    fn dashpots(&self) -> usize {
        if Self::HAS_ROOM {
            self.dashpots
        } else {
            A::DASHPOTS
        }
    }

    #[inline]
    fn drags(&self) -> usize {
        if Self::HAS_ROOM { self.drags } else { 0 }
    }

    #[inline]
    fn is_thermal(&self) -> bool {
        A::THERMAL && (!Self::HAS_ROOM || self.is_thermal)
    }

    fn viscous_strain(&self) -> usize {
        self.viscous_strain
    }

    #[inline]
    fn has_constant_capacity(&self) -> bool {
        self.has_constant_capacity
    }

    fn parameter(&self, index: usize) -> f64 {
        self.formulas.parameter(index)
    }

    fn free_energy(&self, x: &A::Variables) -> f64 {
        self.formulas.free_energy(x)
    }

    fn energy_magnitude(&self, x: &A::Variables) -> f64 {
        self.formulas.energy_magnitude(x)
    }

    fn internal_energy(&self, x: &A::Variables) -> f64 {
        self.formulas.internal_energy(x)
    }

    fn gradient(&self, x: &A::Variables) -> A::Variables {
        self.formulas.gradient(x)
    }

    fn hessian(&self, x: &A::Variables) -> (A::Variables, A::Hessian) {
        self.formulas.hessian(x)
    }

    fn caloric(&self, x: &A::Variables) -> Caloric<f64> {
        self.formulas.caloric(x)
    }

    #[inline]
    fn caloric_at(&self, x: A::Variables) -> impl Fn(f64) -> (Caloric<f64>, f64) {
        move |theta| self.formulas.caloric_at(&x, theta)
    }

    #[inline]
    fn inverse(&self) -> Option<&dyn Inverse<A::Variables>> {
        Some(&*self.formulas)
    }

    fn caloric_between(
        &self,
        x0: &A::Variables,
        x1: &A::Variables,
        new: usize,
    ) -> impl Fn(f64) -> (Caloric<f64>, f64) {
        move |theta| self.formulas.caloric_between([x0, x1], new, theta)
    }

    fn rates(&self, x: &A::Variables) -> Rates<A::Variables> {
        self.formulas.rates(x)
    }

    fn rates_at(&self, x: A::Variables) -> impl Fn(f64) -> (Rates<A::Variables>, [f64; 2]) {
        move |theta| self.formulas.rates_at(&x, theta)
    }

    fn entropy_hessian(&self, x: &A::Variables) -> A::Hessian {
        self.formulas.entropy_hessian(x)
    }

    #[inline]
    fn viscosity(&self, theta: f64) -> (A::Viscosities, A::Viscosities) {
        self.formulas.viscosity(theta)
    }

    fn drag(&self, theta: f64) -> (A::Drag, A::Drag) {
        self.formulas.drag(theta)
    }

    fn entropy_form_old(&self, x0: &A::Variables) -> A::Kept {
        let mut kept = A::Kept::filled(0.0);
        self.formulas.keep_for_entropy_form(x0, &mut kept);
        kept
    }

    #[inline]
    fn keep_for_entropy_form(&self, x0: &A::Variables, old: &mut A::Kept) {
        self.formulas.keep_for_entropy_form(x0, old);
    }

    #[inline]
    fn entropy_form(
        &self,
        old: &A::Kept,
        x1: &A::Variables,
        corners: &A::Corners,
    ) -> (A::Response, A::Tangent) {
        self.formulas.entropy_form(old, x1, corners)
    }

    #[inline]
    fn entropy_form_response(
        &self,
        old: &A::Kept,
        x1: &A::Variables,
        corners: &A::Corners,
    ) -> A::Response {
        self.formulas.entropy_form_response(old, x1, corners)
    }

    #[inline]
    fn mixed_states(
        &self,
        x0: &A::Variables,
        old: &A::Kept,
        x1: &A::Variables,
        corners: &A::Corners,
    ) -> [A::Corners; 2] {
        self.formulas.mixed_states(x0, old, x1, corners)
    }

    fn temperature_form_old(&self, x0: &A::Variables) -> A::Kept {
        let mut kept = A::Kept::filled(0.0);
        self.formulas.keep_for_temperature_form(x0, &mut kept);
        kept
    }

    #[inline]
    fn keep_for_temperature_form(&self, x0: &A::Variables, old: &mut A::Kept) {
        self.formulas.keep_for_temperature_form(x0, old);
    }

    #[inline]
    fn temperature_form(&self, old: &A::Kept, x1: &A::Variables) -> (A::Response, A::Tangent) {
        self.formulas.temperature_form(old, x1)
    }

    #[inline]
    fn temperature_form_response(&self, old: &A::Kept, x1: &A::Variables) -> A::Response {
        self.formulas.temperature_form_response(old, x1)
    }

    fn temperature_form_adjoint(
        &self,
        x0: &A::Variables,
        x1: &A::Variables,
        weights: &A::Response,
    ) -> ByParameters {
        self.formulas.temperature_form_adjoint([x0, x1], weights)
    }

    fn temperature_form_tangent(
        &self,
        x0: &A::Variables,
        x1: &A::Variables,
        direction: &ByParameters,
    ) -> A::Response {
        self.formulas.temperature_form_tangent([x0, x1], direction)
    }

    fn entropy_form_adjoint(
        &self,
        x0: &A::Variables,
        x1: &A::Variables,
        corners: &A::Corners,
        weights: &A::Response,
    ) -> ByParameters {
        let ends = [x0, x1];
        self.formulas.entropy_form_adjoint(ends, corners, weights)
    }

    fn entropy_form_tangent(
        &self,
        x0: &A::Variables,
        x1: &A::Variables,
        corners: &A::Corners,
        direction: &ByParameters,
    ) -> A::Response {
        let ends = [x0, x1];
        self.formulas.entropy_form_tangent(ends, corners, direction)
    }

    fn gradient_adjoint(&self, x: &A::Variables, weights: &A::Variables) -> ByParameters {
        self.formulas.gradient_adjoint(x, weights)
    }

    fn energy_by_parameters(&self, x: &A::Variables) -> ByParameters {
        self.formulas.energy_by_parameters(x)
    }

    fn viscosity_adjoint(&self, theta: f64, weights: &A::Viscosities) -> ByParameters {
        self.formulas.viscosity_adjoint(theta, weights)
    }

    fn drag_adjoint(&self, theta: f64, weights: &A::Drag) -> ByParameters {
        self.formulas.drag_adjoint(theta, weights)
    }
}
