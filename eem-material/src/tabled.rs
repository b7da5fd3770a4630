//! A material of a spring behind its table.

use core::any::Any;

use crate::formulas::{ByParameters, Formulas, MOST_PARAMETERS, TableOf};
use crate::free_energy::{Array, Caloric, FreeEnergy, Material, Rates, TogetherOf};
use crate::inversion::Inverse;

/// A material of a spring behind its table.
///
/// | | |
/// |---|---|
/// | N | variables: the stretch, K viscous stretches, the temperature |
/// | K | dashpots in series |
/// | C | corners: 2 (N − 1) with a temperature, else 0 |
/// | R | responses: N + 1 with a temperature, else N |
/// | O | values of the old state for which there is room; a form that keeps more computes them again |
pub struct Tabled<const N: usize, const K: usize, const C: usize, const R: usize, const O: usize> {
    formulas: Box<Table<N, K, C, R, O>>,
    has_constant_capacity: bool,
}

/// The table of a material with these numbers.
type Table<const N: usize, const K: usize, const C: usize, const R: usize, const O: usize> =
    dyn Formulas<[f64; N], [[f64; N]; N], [f64; K], [f64; C], [f64; R], [[f64; N]; R], [f64; O]>;

impl<const N: usize, const K: usize, const C: usize, const R: usize, const O: usize>
    Tabled<N, K, C, R, O>
{
    /// Whether a material is one of these springs.
    #[must_use]
    pub const fn is_for<M: Material>() -> bool {
        M::MEASURES == 1
            && !M::PER_VOLUME
            && M::DASHPOTS == K
            && M::THERMAL == (R > N)
            && M::Drag::LEN == 0
            && M::Variables::LEN == N
            && M::Corners::LEN == C
            && M::Response::LEN == R
            && M::Parameters::LEN <= MOST_PARAMETERS
    }

    /// A material that [is one of these](Self::is_for).
    #[must_use]
    pub fn new<M: Material>(material: M) -> Self {
        let has_constant_capacity = material.has_constant_capacity();
        let mut formulas: Option<Box<TableOf<M, [f64; O]>>> = Some(Box::new(material));
        // The same type by another name.
        let same: &mut dyn Any = &mut formulas;
        let same: Option<&mut Option<Box<Table<N, K, C, R, O>>>> = same.downcast_mut();
        let Some(formulas) = same.and_then(Option::take) else {
            unreachable!("materials with these numbers of variables have this table")
        };
        Self {
            formulas,
            has_constant_capacity,
        }
    }
}

impl<const N: usize, const K: usize, const C: usize, const R: usize, const O: usize> FreeEnergy<f64>
    for Tabled<N, K, C, R, O>
{
    const MEASURES: usize = 1;
    const DASHPOTS: usize = K;
    const THERMAL: bool = R > N;
    const MAY_BE_TOGETHER: bool = true;
    const MODEL: &'static str = "material";
    /// Empty: the names are known at run time, see `parameter_names`.
    const PARAMETERS: &'static [&'static str] = &[];

    type Parameters = ByParameters;
    type Variables = [f64; N];
    type Hessian = [[f64; N]; N];
    type Viscosities = [f64; K];
    type Drag = [f64; 0];
    type Corners = [f64; C];
    type Response = [f64; R];
    type Tangent = [[f64; N]; R];
    type EntropyFormOld = [f64; O];
    type TemperatureFormOld = [f64; O];

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
    fn has_constant_capacity(&self) -> bool {
        self.has_constant_capacity
    }

    fn parameter(&self, index: usize) -> f64 {
        self.formulas.parameter(index)
    }

    fn free_energy(&self, x: &[f64; N]) -> f64 {
        self.formulas.free_energy(x)
    }

    fn energy_magnitude(&self, x: &[f64; N]) -> f64 {
        self.formulas.energy_magnitude(x)
    }

    fn internal_energy(&self, x: &[f64; N]) -> f64 {
        self.formulas.internal_energy(x)
    }

    fn gradient(&self, x: &[f64; N]) -> [f64; N] {
        self.formulas.gradient(x)
    }

    fn hessian(&self, x: &[f64; N]) -> ([f64; N], [[f64; N]; N]) {
        self.formulas.hessian(x)
    }

    fn caloric(&self, x: &[f64; N]) -> Caloric<f64> {
        self.formulas.caloric(x)
    }

    #[inline]
    fn caloric_at(&self, x: [f64; N]) -> impl Fn(f64) -> (Caloric<f64>, f64) {
        move |theta| self.formulas.caloric_at(&x, theta)
    }

    #[inline]
    fn inverse(&self) -> Option<&dyn Inverse<[f64; N]>> {
        Some(&*self.formulas)
    }

    fn caloric_between(
        &self,
        x0: &[f64; N],
        x1: &[f64; N],
        new: usize,
    ) -> impl Fn(f64) -> (Caloric<f64>, f64) {
        move |theta| self.formulas.caloric_between([x0, x1], new, theta)
    }

    fn rates(&self, x: &[f64; N]) -> Rates<[f64; N]> {
        self.formulas.rates(x)
    }

    fn rates_at(&self, x: [f64; N]) -> impl Fn(f64) -> (Rates<[f64; N]>, [f64; 2]) {
        move |theta| self.formulas.rates_at(&x, theta)
    }

    fn entropy_hessian(&self, x: &[f64; N]) -> [[f64; N]; N] {
        self.formulas.entropy_hessian(x)
    }

    #[inline]
    fn viscosity(&self, theta: f64) -> ([f64; K], [f64; K]) {
        self.formulas.viscosity(theta)
    }

    /// There is none.
    #[inline]
    fn drag(&self, _: f64) -> ([f64; 0], [f64; 0]) {
        ([], [])
    }

    fn entropy_form_old(&self, x0: &[f64; N]) -> [f64; O] {
        let mut kept = [0.0; O];
        self.formulas.keep_for_entropy_form(x0, &mut kept);
        kept
    }

    #[inline]
    fn keep_for_entropy_form(&self, x0: &[f64; N], old: &mut [f64; O]) {
        self.formulas.keep_for_entropy_form(x0, old);
    }

    #[inline]
    fn entropy_form(
        &self,
        old: &[f64; O],
        x1: &[f64; N],
        corners: &[f64; C],
    ) -> ([f64; R], [[f64; N]; R]) {
        self.formulas.entropy_form(old, x1, corners)
    }

    #[inline]
    fn entropy_form_response(&self, old: &[f64; O], x1: &[f64; N], corners: &[f64; C]) -> [f64; R] {
        self.formulas.entropy_form_response(old, x1, corners)
    }

    #[inline]
    fn mixed_states(
        &self,
        x0: &[f64; N],
        old: &[f64; O],
        x1: &[f64; N],
        corners: &[f64; C],
    ) -> [[f64; C]; 2] {
        self.formulas.mixed_states(x0, old, x1, corners)
    }

    fn temperature_form_old(&self, x0: &[f64; N]) -> [f64; O] {
        let mut kept = [0.0; O];
        self.formulas.keep_for_temperature_form(x0, &mut kept);
        kept
    }

    #[inline]
    fn keep_for_temperature_form(&self, x0: &[f64; N], old: &mut [f64; O]) {
        self.formulas.keep_for_temperature_form(x0, old);
    }

    #[inline]
    fn temperature_form(&self, old: &[f64; O], x1: &[f64; N]) -> ([f64; R], [[f64; N]; R]) {
        self.formulas.temperature_form(old, x1)
    }

    #[inline]
    fn temperature_form_response(&self, old: &[f64; O], x1: &[f64; N]) -> [f64; R] {
        self.formulas.temperature_form_response(old, x1)
    }

    fn temperature_form_adjoint(
        &self,
        x0: &[f64; N],
        x1: &[f64; N],
        weights: &[f64; R],
    ) -> ByParameters {
        self.formulas.temperature_form_adjoint([x0, x1], weights)
    }

    fn temperature_form_tangent(
        &self,
        x0: &[f64; N],
        x1: &[f64; N],
        direction: &ByParameters,
    ) -> [f64; R] {
        self.formulas.temperature_form_tangent([x0, x1], direction)
    }

    fn entropy_form_adjoint(
        &self,
        x0: &[f64; N],
        x1: &[f64; N],
        corners: &[f64; C],
        weights: &[f64; R],
    ) -> ByParameters {
        let ends = [x0, x1];
        self.formulas.entropy_form_adjoint(ends, corners, weights)
    }

    fn entropy_form_tangent(
        &self,
        x0: &[f64; N],
        x1: &[f64; N],
        corners: &[f64; C],
        direction: &ByParameters,
    ) -> [f64; R] {
        let ends = [x0, x1];
        self.formulas.entropy_form_tangent(ends, corners, direction)
    }

    fn gradient_adjoint(&self, x: &[f64; N], weights: &[f64; N]) -> ByParameters {
        self.formulas.gradient_adjoint(x, weights)
    }

    fn energy_by_parameters(&self, x: &[f64; N]) -> ByParameters {
        self.formulas.energy_by_parameters(x)
    }

    fn viscosity_adjoint(&self, theta: f64, weights: &[f64; K]) -> ByParameters {
        self.formulas.viscosity_adjoint(theta, weights)
    }

    fn drag_adjoint(&self, _: f64, _: &[f64; 0]) -> ByParameters {
        [0.0; MOST_PARAMETERS]
    }
}
