//! The free energy of a point of a solid: the free energy per volume times the volume.

use crate::free_energy::{Array, Caloric, FreeEnergy};

/// The free energy of a volume. Energy, entropy, forces and viscosities are multiplied by the volume, temperatures are not.
#[derive(Clone, Debug)]
pub struct PointEnergy<M> {
    density: M,
    /// w, m³.
    volume: f64,
}

impl<M: FreeEnergy<f64>> PointEnergy<M> {
    /// The free energy of a `volume` in m³, from that per volume.
    pub fn new(density: M, volume: f64) -> Self {
        Self { density, volume }
    }

    fn scaled<A: Array<f64>>(&self, mut values: A) -> A {
        for value in values.as_mut() {
            *value *= self.volume;
        }
        values
    }

    fn scaled_rows(&self, mut rows: M::Hessian) -> M::Hessian {
        for row in rows.as_mut() {
            *row = self.scaled(*row);
        }
        rows
    }

    fn scaled_caloric(&self, caloric: Caloric<f64>) -> Caloric<f64> {
        Caloric {
            entropy: self.volume * caloric.entropy,
            heat_capacity: self.volume * caloric.heat_capacity,
            magnitude: self.volume * caloric.magnitude,
        }
    }

    fn scaled_at(
        &self,
        density: impl Fn(f64) -> (Caloric<f64>, f64),
    ) -> impl Fn(f64) -> (Caloric<f64>, f64) {
        move |theta| {
            let (caloric, psi) = density(theta);
            (self.scaled_caloric(caloric), self.volume * psi)
        }
    }

    /// Whether a row of a response is a temperature.
    const fn is_temperature(row: usize) -> bool {
        M::THERMAL && row == M::MEASURES + M::DASHPOTS
    }

    fn scaled_response(&self, mut response: M::Response) -> M::Response {
        for (row, value) in response.as_mut().iter_mut().enumerate() {
            if !Self::is_temperature(row) {
                *value *= self.volume;
            }
        }
        response
    }

    fn scaled_form(
        &self,
        (response, mut tangent): (M::Response, M::Tangent),
    ) -> (M::Response, M::Tangent) {
        for (row, values) in tangent.as_mut().iter_mut().enumerate() {
            if !Self::is_temperature(row) {
                *values = self.scaled(*values);
            }
        }
        (self.scaled_response(response), tangent)
    }
}

impl<M: FreeEnergy<f64>> FreeEnergy<f64> for PointEnergy<M> {
    const MEASURES: usize = M::MEASURES;
    const DASHPOTS: usize = M::DASHPOTS;
    const THERMAL: bool = M::THERMAL;
    const VISCOUS_STRAIN: usize = M::VISCOUS_STRAIN;
    const HAS_CONSTANT_CAPACITY: bool = M::HAS_CONSTANT_CAPACITY;
    const HAS_PARAMETER_DERIVATIVES: bool = M::HAS_PARAMETER_DERIVATIVES;
    const MODEL: &'static str = M::MODEL;
    const PARAMETERS: &'static [&'static str] = M::PARAMETERS;
    const PARAMETER_UNITS: &'static [&'static str] = M::PARAMETER_UNITS;

    type Parameters = M::Parameters;
    type Variables = M::Variables;
    type Hessian = M::Hessian;
    type Viscosities = M::Viscosities;
    type Drag = M::Drag;
    type Corners = M::Corners;
    type Response = M::Response;
    type Tangent = M::Tangent;
    type EntropyFormOld = M::EntropyFormOld;
    type TemperatureFormOld = M::TemperatureFormOld;

    fn duplicate(&self) -> Self {
        Self {
            density: self.density.duplicate(),
            volume: self.volume,
        }
    }

    fn model(&self) -> &'static &'static str {
        self.density.model()
    }

    fn kind(&self) -> u64 {
        self.density.kind()
    }

    #[inline]
    fn parameter_count(&self) -> usize {
        self.density.parameter_count()
    }

    fn parameter_names(&self) -> &'static [&'static str] {
        self.density.parameter_names()
    }

    #[inline]
    fn dashpots(&self) -> usize {
        self.density.dashpots()
    }

    #[inline]
    fn drags(&self) -> usize {
        self.density.drags()
    }

    #[inline]
    fn has_constant_capacity(&self) -> bool {
        self.density.has_constant_capacity()
    }

    fn parameter(&self, index: usize) -> f64 {
        self.density.parameter(index)
    }

    fn free_energy(&self, x: &M::Variables) -> f64 {
        self.volume * self.density.free_energy(x)
    }

    fn energy_magnitude(&self, x: &M::Variables) -> f64 {
        self.volume * self.density.energy_magnitude(x)
    }

    fn internal_energy(&self, x: &M::Variables) -> f64 {
        self.volume * self.density.internal_energy(x)
    }

    fn gradient(&self, x: &M::Variables) -> M::Variables {
        self.scaled(self.density.gradient(x))
    }

    fn hessian(&self, x: &M::Variables) -> (M::Variables, M::Hessian) {
        let (gradient, hessian) = self.density.hessian(x);
        (self.scaled(gradient), self.scaled_rows(hessian))
    }

    fn caloric(&self, x: &M::Variables) -> Caloric<f64> {
        self.scaled_caloric(self.density.caloric(x))
    }

    fn caloric_at(&self, x: M::Variables) -> impl Fn(f64) -> (Caloric<f64>, f64) {
        self.scaled_at(self.density.caloric_at(x))
    }

    fn caloric_between(
        &self,
        x0: &M::Variables,
        x1: &M::Variables,
        new: usize,
    ) -> impl Fn(f64) -> (Caloric<f64>, f64) {
        self.scaled_at(self.density.caloric_between(x0, x1, new))
    }

    fn entropy_hessian(&self, x: &M::Variables) -> M::Hessian {
        self.scaled_rows(self.density.entropy_hessian(x))
    }

    fn viscosity(&self, theta: f64) -> (M::Viscosities, M::Viscosities) {
        let (viscosities, slopes) = self.density.viscosity(theta);
        (self.scaled(viscosities), self.scaled(slopes))
    }

    fn drag(&self, theta: f64) -> (M::Drag, M::Drag) {
        let (drag, slope) = self.density.drag(theta);
        (self.scaled(drag), self.scaled(slope))
    }

    fn entropy_form_old(&self, x0: &M::Variables) -> M::EntropyFormOld {
        self.density.entropy_form_old(x0)
    }

    fn entropy_form(
        &self,
        old: &M::EntropyFormOld,
        x1: &M::Variables,
        corners: &M::Corners,
    ) -> (M::Response, M::Tangent) {
        self.scaled_form(self.density.entropy_form(old, x1, corners))
    }

    fn entropy_form_response(
        &self,
        old: &M::EntropyFormOld,
        x1: &M::Variables,
        corners: &M::Corners,
    ) -> M::Response {
        self.scaled_response(self.density.entropy_form_response(old, x1, corners))
    }

    fn mixed_states(
        &self,
        x0: &M::Variables,
        old: &M::EntropyFormOld,
        x1: &M::Variables,
        corners: &M::Corners,
    ) -> [M::Corners; 2] {
        let found = self.density.mixed_states(x0, old, x1, corners);
        found.map(|values| self.scaled(values))
    }

    fn temperature_form_old(&self, x0: &M::Variables) -> M::TemperatureFormOld {
        self.density.temperature_form_old(x0)
    }

    fn temperature_form(
        &self,
        old: &M::TemperatureFormOld,
        x1: &M::Variables,
    ) -> (M::Response, M::Tangent) {
        self.scaled_form(self.density.temperature_form(old, x1))
    }

    fn temperature_form_response(
        &self,
        old: &M::TemperatureFormOld,
        x1: &M::Variables,
    ) -> M::Response {
        self.scaled_response(self.density.temperature_form_response(old, x1))
    }

    fn temperature_form_adjoint(
        &self,
        x0: &M::Variables,
        x1: &M::Variables,
        weights: &M::Response,
    ) -> M::Parameters {
        let weights = self.scaled_response(*weights);
        self.density.temperature_form_adjoint(x0, x1, &weights)
    }

    fn temperature_form_tangent(
        &self,
        x0: &M::Variables,
        x1: &M::Variables,
        direction: &M::Parameters,
    ) -> M::Response {
        self.scaled_response(self.density.temperature_form_tangent(x0, x1, direction))
    }

    fn entropy_form_adjoint(
        &self,
        x0: &M::Variables,
        x1: &M::Variables,
        corners: &M::Corners,
        weights: &M::Response,
    ) -> M::Parameters {
        let weights = self.scaled_response(*weights);
        self.density.entropy_form_adjoint(x0, x1, corners, &weights)
    }

    fn entropy_form_tangent(
        &self,
        x0: &M::Variables,
        x1: &M::Variables,
        corners: &M::Corners,
        direction: &M::Parameters,
    ) -> M::Response {
        let density = &self.density;
        self.scaled_response(density.entropy_form_tangent(x0, x1, corners, direction))
    }

    fn gradient_adjoint(&self, x: &M::Variables, weights: &M::Variables) -> M::Parameters {
        self.density.gradient_adjoint(x, &self.scaled(*weights))
    }

    fn energy_by_parameters(&self, x: &M::Variables) -> M::Parameters {
        self.scaled(self.density.energy_by_parameters(x))
    }

    fn viscosity_adjoint(&self, theta: f64, weights: &M::Viscosities) -> M::Parameters {
        let weights = self.scaled(*weights);
        self.density.viscosity_adjoint(theta, &weights)
    }

    fn drag_adjoint(&self, theta: f64, weights: &M::Drag) -> M::Parameters {
        self.density.drag_adjoint(theta, &self.scaled(*weights))
    }
}
