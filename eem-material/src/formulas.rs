//! Materials behind a table: what steps a scene is compiled once, in the runtime, for all materials with the same numbers of
//! variables.
//!
//! ```text
//! M: FreeEnergy ─▶ dyn Formulas ── Tabled: FreeEnergy ─▶ elements
//! ```
//!
//! The results have the bits of the material's own functions.

use core::any::Any;

use crate::free_energy::{Array, Caloric, FreeEnergy, Material, Rates, Together, TogetherOf};
use crate::inversion::{Inverse, InversionError, temperature_near};

/// The most parameters of a material behind a table.
pub const MOST_PARAMETERS: usize = 64;

/// An entry per parameter; those beyond the parameters of the material are unused.
pub type ByParameters = [f64; MOST_PARAMETERS];

/// What is known of a material without evaluating it, see the functions of [`FreeEnergy`] with these names.
#[derive(Clone, Copy, Debug)]
pub struct Facts {
    pub model: &'static &'static str,
    pub kind: u64,
    pub parameter_count: usize,
    pub parameter_units: &'static [&'static str],
    pub has_parameter_derivatives: bool,
}

/// The functions of a [`FreeEnergy`] with these variables, Hessian, viscosities, corners, response and tangent, as a table.
/// Implemented for every material; see the functions of [`FreeEnergy`] with the same names.
pub trait Formulas<X, H, V, C, R, T, O>: Inverse<X> + Send + Sync {
    fn facts(&self) -> Facts;
    fn as_any(&self) -> &dyn Any;
    fn duplicate(&self) -> Box<dyn Formulas<X, H, V, C, R, T, O>>;
    fn parameter_names(&self) -> &'static [&'static str];
    fn together(&self) -> Option<&(dyn Together<X, V, C, R, T> + 'static)>;
    fn parameter(&self, index: usize) -> f64;
    fn free_energy(&self, x: &X) -> f64;
    fn energy_magnitude(&self, x: &X) -> f64;
    fn internal_energy(&self, x: &X) -> f64;
    fn gradient(&self, x: &X) -> X;
    fn hessian(&self, x: &X) -> (X, H);
    fn caloric(&self, x: &X) -> Caloric<f64>;
    fn caloric_at(&self, x: &X, theta: f64) -> (Caloric<f64>, f64);
    fn caloric_between(&self, ends: [&X; 2], new: usize, theta: f64) -> (Caloric<f64>, f64);
    fn rates(&self, x: &X) -> Rates<X>;
    fn rates_at(&self, x: &X, theta: f64) -> (Rates<X>, [f64; 2]);
    fn entropy_hessian(&self, x: &X) -> H;
    fn viscosity(&self, theta: f64) -> (V, V);
    fn keep_for_entropy_form(&self, x0: &X, old: &mut O);
    fn entropy_form(&self, old: &O, x1: &X, corners: &C) -> (R, T);
    fn entropy_form_response(&self, old: &O, x1: &X, corners: &C) -> R;
    fn mixed_states(&self, x0: &X, old: &O, x1: &X, corners: &C) -> [C; 2];
    fn keep_for_temperature_form(&self, x0: &X, old: &mut O);
    fn temperature_form(&self, old: &O, x1: &X) -> (R, T);
    fn temperature_form_response(&self, old: &O, x1: &X) -> R;
    fn temperature_form_adjoint(&self, ends: [&X; 2], weights: &R) -> ByParameters;
    fn temperature_form_tangent(&self, ends: [&X; 2], direction: &ByParameters) -> R;
    fn entropy_form_adjoint(&self, ends: [&X; 2], corners: &C, weights: &R) -> ByParameters;
    fn entropy_form_tangent(&self, ends: [&X; 2], corners: &C, direction: &ByParameters) -> R;
    fn gradient_adjoint(&self, x: &X, weights: &X) -> ByParameters;
    fn energy_by_parameters(&self, x: &X) -> ByParameters;
    fn viscosity_adjoint(&self, theta: f64, weights: &V) -> ByParameters;
}

/// The table of a material with room for O.
pub type TableOf<M, O> = dyn Formulas<
        <M as FreeEnergy<f64>>::Variables,
        <M as FreeEnergy<f64>>::Hessian,
        <M as FreeEnergy<f64>>::Viscosities,
        <M as FreeEnergy<f64>>::Corners,
        <M as FreeEnergy<f64>>::Response,
        <M as FreeEnergy<f64>>::Tangent,
        O,
    >;

/// Stores what a form keeps of the old state, or the old variables if there is no room for it.
#[inline]
fn keep<A: Array<f64>, X: Array<f64>, O: Array<f64>>(
    x0: &X,
    old_of: impl Fn(&X) -> A,
    kept: &mut O,
) {
    if const { A::LEN <= O::LEN } {
        kept.as_mut()[..A::LEN].copy_from_slice(old_of(x0).as_ref());
    } else {
        kept.as_mut()[..X::LEN].copy_from_slice(x0.as_ref());
    }
}

/// Calls a function with what a form has kept.
#[inline]
fn with_kept<A: Array<f64>, X: Array<f64>, O: Array<f64>, T>(
    kept: &O,
    old_of: impl Fn(&X) -> A,
    form: impl FnOnce(&A) -> T,
) -> T {
    if const { A::LEN <= O::LEN } {
        form(A::beginning_of(kept.as_ref()))
    } else {
        form(&old_of(X::beginning_of(kept.as_ref())))
    }
}

/// The first entries, and zeros beyond.
fn resized<A: Array<f64>, B: Array<f64>>(from: &A) -> B {
    let mut to = B::filled(0.0);
    for (to, &from) in to.as_mut().iter_mut().zip(from.as_ref()) {
        *to = from;
    }
    to
}

impl<M: Material> Inverse<M::Variables> for M {
    fn temperature_of(
        &self,
        x: &M::Variables,
        [entropy, guess, enough]: [f64; 3],
    ) -> Result<f64, InversionError> {
        let caloric_at = FreeEnergy::caloric_at(self, *x);
        let found = temperature_near(|theta| (caloric_at(theta).0, []), entropy, guess, enough);
        found.map(|(theta, [])| theta)
    }
}

impl<M: Material, O: Array<f64>>
    Formulas<M::Variables, M::Hessian, M::Viscosities, M::Corners, M::Response, M::Tangent, O>
    for M
{
    fn facts(&self) -> Facts {
        Facts {
            model: self.model(),
            kind: self.kind(),
            parameter_count: self.parameter_count(),
            parameter_units: self.parameter_units(),
            has_parameter_derivatives: self.has_parameter_derivatives(),
        }
    }

    fn as_any(&self) -> &dyn Any {
        self
    }

    fn duplicate(&self) -> Box<TableOf<M, O>> {
        Box::new(FreeEnergy::duplicate(self))
    }

    fn parameter_names(&self) -> &'static [&'static str] {
        FreeEnergy::parameter_names(self)
    }

    fn together(&self) -> Option<&TogetherOf<M>> {
        // They store what forms keep, never the old variables in its place.
        let fits =
            const { M::EntropyFormOld::LEN <= O::LEN && M::TemperatureFormOld::LEN <= O::LEN };
        FreeEnergy::together(self).filter(|_| fits)
    }

    fn parameter(&self, index: usize) -> f64 {
        FreeEnergy::parameter(self, index)
    }

    fn free_energy(&self, x: &M::Variables) -> f64 {
        FreeEnergy::free_energy(self, x)
    }

    fn energy_magnitude(&self, x: &M::Variables) -> f64 {
        FreeEnergy::energy_magnitude(self, x)
    }

    fn internal_energy(&self, x: &M::Variables) -> f64 {
        FreeEnergy::internal_energy(self, x)
    }

    fn gradient(&self, x: &M::Variables) -> M::Variables {
        FreeEnergy::gradient(self, x)
    }

    fn hessian(&self, x: &M::Variables) -> (M::Variables, M::Hessian) {
        FreeEnergy::hessian(self, x)
    }

    fn caloric(&self, x: &M::Variables) -> Caloric<f64> {
        FreeEnergy::caloric(self, x)
    }

    fn caloric_at(&self, x: &M::Variables, theta: f64) -> (Caloric<f64>, f64) {
        FreeEnergy::caloric_at(self, *x)(theta)
    }

    fn caloric_between(
        &self,
        [x0, x1]: [&M::Variables; 2],
        new: usize,
        theta: f64,
    ) -> (Caloric<f64>, f64) {
        FreeEnergy::caloric_between(self, x0, x1, new)(theta)
    }

    fn rates(&self, x: &M::Variables) -> Rates<M::Variables> {
        FreeEnergy::rates(self, x)
    }

    fn rates_at(&self, x: &M::Variables, theta: f64) -> (Rates<M::Variables>, [f64; 2]) {
        FreeEnergy::rates_at(self, *x)(theta)
    }

    fn entropy_hessian(&self, x: &M::Variables) -> M::Hessian {
        FreeEnergy::entropy_hessian(self, x)
    }

    fn viscosity(&self, theta: f64) -> (M::Viscosities, M::Viscosities) {
        FreeEnergy::viscosity(self, theta)
    }

    fn keep_for_entropy_form(&self, x0: &M::Variables, kept: &mut O) {
        keep(x0, |x0| self.entropy_form_old(x0), kept);
    }

    fn entropy_form(
        &self,
        kept: &O,
        x1: &M::Variables,
        corners: &M::Corners,
    ) -> (M::Response, M::Tangent) {
        with_kept(
            kept,
            |x0| self.entropy_form_old(x0),
            |old| FreeEnergy::entropy_form(self, old, x1, corners),
        )
    }

    fn entropy_form_response(
        &self,
        kept: &O,
        x1: &M::Variables,
        corners: &M::Corners,
    ) -> M::Response {
        with_kept(
            kept,
            |x0| self.entropy_form_old(x0),
            |old| FreeEnergy::entropy_form_response(self, old, x1, corners),
        )
    }

    fn mixed_states(
        &self,
        x0: &M::Variables,
        kept: &O,
        x1: &M::Variables,
        corners: &M::Corners,
    ) -> [M::Corners; 2] {
        with_kept(
            kept,
            |x0| self.entropy_form_old(x0),
            |old| FreeEnergy::mixed_states(self, x0, old, x1, corners),
        )
    }

    fn keep_for_temperature_form(&self, x0: &M::Variables, kept: &mut O) {
        keep(x0, |x0| self.temperature_form_old(x0), kept);
    }

    fn temperature_form(&self, kept: &O, x1: &M::Variables) -> (M::Response, M::Tangent) {
        with_kept(
            kept,
            |x0| self.temperature_form_old(x0),
            |old| FreeEnergy::temperature_form(self, old, x1),
        )
    }

    fn temperature_form_response(&self, kept: &O, x1: &M::Variables) -> M::Response {
        with_kept(
            kept,
            |x0| self.temperature_form_old(x0),
            |old| FreeEnergy::temperature_form_response(self, old, x1),
        )
    }

    fn temperature_form_adjoint(
        &self,
        [x0, x1]: [&M::Variables; 2],
        weights: &M::Response,
    ) -> ByParameters {
        resized(&FreeEnergy::temperature_form_adjoint(self, x0, x1, weights))
    }

    fn temperature_form_tangent(
        &self,
        [x0, x1]: [&M::Variables; 2],
        direction: &ByParameters,
    ) -> M::Response {
        FreeEnergy::temperature_form_tangent(self, x0, x1, &resized(direction))
    }

    fn entropy_form_adjoint(
        &self,
        [x0, x1]: [&M::Variables; 2],
        corners: &M::Corners,
        weights: &M::Response,
    ) -> ByParameters {
        resized(&FreeEnergy::entropy_form_adjoint(
            self, x0, x1, corners, weights,
        ))
    }

    fn entropy_form_tangent(
        &self,
        [x0, x1]: [&M::Variables; 2],
        corners: &M::Corners,
        direction: &ByParameters,
    ) -> M::Response {
        FreeEnergy::entropy_form_tangent(self, x0, x1, corners, &resized(direction))
    }

    fn gradient_adjoint(&self, x: &M::Variables, weights: &M::Variables) -> ByParameters {
        resized(&FreeEnergy::gradient_adjoint(self, x, weights))
    }

    fn energy_by_parameters(&self, x: &M::Variables) -> ByParameters {
        resized(&FreeEnergy::energy_by_parameters(self, x))
    }

    fn viscosity_adjoint(&self, theta: f64, weights: &M::Viscosities) -> ByParameters {
        resized(&FreeEnergy::viscosity_adjoint(self, theta, weights))
    }
}
