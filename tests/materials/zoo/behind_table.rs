//! A material behind its table as a free energy again, so that every function of the table is compared.

use eem::{Array, Caloric, FreeEnergy};
use eem_material::arrays::Arrays;
use eem_material::free_energy::TogetherOf;
use eem_material::tabled::Tabled;

pub(crate) struct Behind<A: Arrays>(pub(crate) Tabled<A>);

/// The most parameters of a material of the zoo.
type Parameters = [f64; 64];

impl<A: Arrays> Behind<A> {
    fn by_parameters(&self, write: impl Fn(&mut [f64])) -> Parameters {
        let mut found = [0.0; 64];
        write(&mut found[..self.parameter_count()]);
        found
    }

    fn own<'a>(&self, direction: &'a Parameters) -> &'a [f64] {
        &direction[..self.parameter_count()]
    }
}

impl<A: Arrays> FreeEnergy<f64> for Behind<A> {
    const MEASURES: usize = A::MEASURES;
    const DASHPOTS: usize = A::DASHPOTS;
    const THERMAL: bool = A::THERMAL;
    const MODEL: &'static str = "material";
    const PARAMETERS: &'static [&'static str] = &[];

    type Parameters = Parameters;
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
        Self(self.0.duplicate())
    }

    fn model(&self) -> &'static &'static str {
        self.0.facts().model
    }

    fn dashpots(&self) -> usize {
        self.0.dashpots()
    }

    fn drags(&self) -> usize {
        self.0.drags()
    }

    fn is_thermal(&self) -> bool {
        self.0.is_thermal()
    }

    fn together(&self) -> Option<&TogetherOf<Self>> {
        self.0.together()
    }

    fn parameter_count(&self) -> usize {
        self.0.facts().parameter_count
    }

    fn parameter_names(&self) -> &'static [&'static str] {
        self.0.parameter_names()
    }

    fn has_parameter_derivatives(&self) -> bool {
        self.0.facts().has_parameter_derivatives
    }

    fn has_constant_capacity(&self) -> bool {
        self.0.has_constant_capacity()
    }

    fn parameter(&self, index: usize) -> f64 {
        self.0.parameter(index)
    }

    fn free_energy(&self, x: &A::Variables) -> f64 {
        self.0.free_energy(x)
    }

    fn energy_magnitude(&self, x: &A::Variables) -> f64 {
        self.0.energy_magnitude(x)
    }

    /// Not in the table.
    fn internal_energy(&self, _: &A::Variables) -> f64 {
        f64::NAN
    }

    fn gradient(&self, x: &A::Variables) -> A::Variables {
        self.0.gradient(x)
    }

    fn hessian(&self, x: &A::Variables) -> (A::Variables, A::Hessian) {
        self.0.hessian(x)
    }

    fn caloric(&self, x: &A::Variables) -> Caloric<f64> {
        self.0.caloric(x)
    }

    fn caloric_at(&self, x: A::Variables) -> impl Fn(f64) -> (Caloric<f64>, f64) {
        move |theta| self.0.caloric_at(&x, theta)
    }

    fn caloric_between(
        &self,
        x0: &A::Variables,
        x1: &A::Variables,
        new: usize,
    ) -> impl Fn(f64) -> (Caloric<f64>, f64) {
        move |theta| self.0.caloric_between([x0, x1], new, theta)
    }

    fn entropy_hessian(&self, x: &A::Variables) -> A::Hessian {
        self.0.entropy_hessian(x)
    }

    fn viscosity(&self, theta: f64) -> (A::Viscosities, A::Viscosities) {
        self.0.viscosity(theta)
    }

    fn drag(&self, theta: f64) -> (A::Drag, A::Drag) {
        self.0.drag(theta)
    }

    fn entropy_form_old(&self, x0: &A::Variables) -> A::Kept {
        let mut kept = A::Kept::filled(0.0);
        self.0.keep_for_entropy_form(x0, &mut kept);
        kept
    }

    fn entropy_form(
        &self,
        old: &A::Kept,
        x1: &A::Variables,
        corners: &A::Corners,
    ) -> (A::Response, A::Tangent) {
        self.0.entropy_form(old, x1, corners)
    }

    fn entropy_form_response(
        &self,
        old: &A::Kept,
        x1: &A::Variables,
        corners: &A::Corners,
    ) -> A::Response {
        self.0.entropy_form_response(old, x1, corners)
    }

    fn mixed_states(
        &self,
        x0: &A::Variables,
        old: &A::Kept,
        x1: &A::Variables,
        corners: &A::Corners,
    ) -> [A::Corners; 2] {
        self.0.mixed_states(x0, old, x1, corners)
    }

    fn temperature_form_old(&self, x0: &A::Variables) -> A::Kept {
        let mut kept = A::Kept::filled(0.0);
        self.0.keep_for_temperature_form(x0, &mut kept);
        kept
    }

    fn temperature_form(&self, old: &A::Kept, x1: &A::Variables) -> (A::Response, A::Tangent) {
        self.0.temperature_form(old, x1)
    }

    fn temperature_form_response(&self, old: &A::Kept, x1: &A::Variables) -> A::Response {
        self.0.temperature_form_response(old, x1)
    }

    fn temperature_form_adjoint(
        &self,
        x0: &A::Variables,
        x1: &A::Variables,
        weights: &A::Response,
    ) -> Parameters {
        self.by_parameters(|found| {
            self.0.temperature_form_adjoint([x0, x1], weights, found);
        })
    }

    fn temperature_form_tangent(
        &self,
        x0: &A::Variables,
        x1: &A::Variables,
        direction: &Parameters,
    ) -> A::Response {
        self.0
            .temperature_form_tangent([x0, x1], self.own(direction))
    }

    fn entropy_form_adjoint(
        &self,
        x0: &A::Variables,
        x1: &A::Variables,
        corners: &A::Corners,
        weights: &A::Response,
    ) -> Parameters {
        self.by_parameters(|found| {
            self.0
                .entropy_form_adjoint([x0, x1], corners, weights, found);
        })
    }

    fn entropy_form_tangent(
        &self,
        x0: &A::Variables,
        x1: &A::Variables,
        corners: &A::Corners,
        direction: &Parameters,
    ) -> A::Response {
        self.0
            .entropy_form_tangent([x0, x1], corners, self.own(direction))
    }

    fn energy_by_parameters(&self, x: &A::Variables) -> Parameters {
        self.by_parameters(|found| {
            self.0.energy_by_parameters(x, found);
        })
    }

    fn viscosity_adjoint(&self, theta: f64, weights: &A::Viscosities) -> Parameters {
        self.by_parameters(|found| {
            self.0.viscosity_adjoint(theta, weights, found);
        })
    }

    fn drag_adjoint(&self, theta: f64, weights: &A::Drag) -> Parameters {
        self.by_parameters(|found| {
            self.0.drag_adjoint(theta, weights, found);
        })
    }
}
