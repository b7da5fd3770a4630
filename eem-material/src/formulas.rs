//! Materials behind a table: what steps a scene is compiled once, in the runtime, for all materials with the same numbers of
//! variables.
//!
//! ```text
//! M: FreeEnergy ─▶ WithRoom, if its arrays are longer ─▶ dyn Formulas ─▶ Tabled ─▶ elements
//! ```
//!
//! The results have the bits of the material's own functions.

use core::any::Any;

use crate::arrays::Arrays;
use crate::free_energy::{Array, Caloric, FreeEnergy, Material, Together, TogetherOf};
use crate::inversion::{InversionError, temperature_near};

/// What is known of a material without evaluating it, see the functions of [`FreeEnergy`] with these names.
#[derive(Clone, Copy, Debug)]
pub struct Facts {
    pub model: &'static &'static str,
    pub kind: u64,
    pub dashpots: usize,
    pub drags: usize,
    pub is_thermal: bool,
    pub viscous_strain: usize,
    pub has_constant_capacity: bool,
    pub parameter_count: usize,
    /// The number of parameters for which there is room in an array of derivatives: all or none.
    pub derivatives: usize,
    pub parameter_units: &'static [&'static str],
    pub has_parameter_derivatives: bool,
}

/// The functions of a [`FreeEnergy`] with these arrays, as a table. Implemented for every material; see the functions of
/// [`FreeEnergy`] with the same names.
pub trait Formulas<A: Arrays>: Send + Sync {
    fn facts(&self) -> Facts;
    fn as_any(&self) -> &dyn Any;
    fn duplicate(&self) -> Box<dyn Formulas<A>>;
    fn parameter_names(&self) -> &'static [&'static str];
    fn together(&self) -> Option<&TogetherIn<A>>;
    fn parameter(&self, index: usize) -> f64;
    fn free_energy(&self, x: &A::Variables) -> f64;
    fn energy_magnitude(&self, x: &A::Variables) -> f64;
    fn gradient(&self, x: &A::Variables) -> A::Variables;
    fn hessian(&self, x: &A::Variables) -> (A::Variables, A::Hessian);
    fn caloric(&self, x: &A::Variables) -> Caloric<f64>;
    fn caloric_at(&self, x: &A::Variables, theta: f64) -> (Caloric<f64>, f64);
    fn caloric_between(
        &self,
        ends: [&A::Variables; 2],
        new: usize,
        theta: f64,
    ) -> (Caloric<f64>, f64);
    /// [`temperature_near`] with the other variables of `x`; the numbers are entropy, guess and `enough`.
    ///
    /// # Errors
    ///
    /// As [`invert`](crate::invert).
    fn temperature_of(&self, x: &A::Variables, numbers: [f64; 3]) -> Result<f64, InversionError>;
    fn entropy_hessian(&self, x: &A::Variables) -> A::Hessian;
    fn viscosity(&self, theta: f64) -> (A::Viscosities, A::Viscosities);
    fn drag(&self, theta: f64) -> (A::Drag, A::Drag);
    fn keep_for_entropy_form(&self, x0: &A::Variables, old: &mut A::Kept);
    fn entropy_form(
        &self,
        old: &A::Kept,
        x1: &A::Variables,
        corners: &A::Corners,
    ) -> (A::Response, A::Tangent);
    fn entropy_form_response(
        &self,
        old: &A::Kept,
        x1: &A::Variables,
        corners: &A::Corners,
    ) -> A::Response;
    fn mixed_states(
        &self,
        x0: &A::Variables,
        old: &A::Kept,
        x1: &A::Variables,
        corners: &A::Corners,
    ) -> [A::Corners; 2];
    fn keep_for_temperature_form(&self, x0: &A::Variables, old: &mut A::Kept);
    fn temperature_form(&self, old: &A::Kept, x1: &A::Variables) -> (A::Response, A::Tangent);
    fn temperature_form_response(&self, old: &A::Kept, x1: &A::Variables) -> A::Response;
    fn temperature_form_adjoint(
        &self,
        ends: [&A::Variables; 2],
        weights: &A::Response,
        found: &mut [f64],
    );
    fn temperature_form_tangent(&self, ends: [&A::Variables; 2], direction: &[f64]) -> A::Response;
    fn entropy_form_adjoint(
        &self,
        ends: [&A::Variables; 2],
        corners: &A::Corners,
        weights: &A::Response,
        found: &mut [f64],
    );
    fn entropy_form_tangent(
        &self,
        ends: [&A::Variables; 2],
        corners: &A::Corners,
        direction: &[f64],
    ) -> A::Response;
    fn energy_by_parameters(&self, x: &A::Variables, found: &mut [f64]);
    fn viscosity_adjoint(&self, theta: f64, weights: &A::Viscosities, found: &mut [f64]);
    fn drag_adjoint(&self, theta: f64, weights: &A::Drag, found: &mut [f64]);
}

/// A response and its derivatives with respect to the new variables.
pub type Form<A> = (<A as Arrays>::Response, <A as Arrays>::Tangent);

/// [`Together`] for these arrays.
pub type TogetherIn<A> = dyn Together<
        <A as Arrays>::Variables,
        <A as Arrays>::Viscosities,
        <A as Arrays>::Corners,
        <A as Arrays>::Response,
        <A as Arrays>::Tangent,
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

/// Stores as many derivatives as there is room for.
fn copy(by: &[f64], found: &mut [f64]) {
    found.copy_from_slice(&by[..found.len()]);
}

/// A direction as the array of a material, which may be longer.
fn parameters<M: Material>(direction: &[f64]) -> M::Parameters {
    let mut parameters = M::Parameters::filled(0.0);
    parameters.as_mut()[..direction.len()].copy_from_slice(direction);
    parameters
}

impl<M, A> Formulas<A> for M
where
    M: Material,
    A: Arrays<
            Variables = M::Variables,
            Hessian = M::Hessian,
            Viscosities = M::Viscosities,
            Drag = M::Drag,
            Corners = M::Corners,
            Response = M::Response,
            Tangent = M::Tangent,
        >,
{
    fn facts(&self) -> Facts {
        Facts {
            model: self.model(),
            kind: self.kind(),
            dashpots: self.dashpots(),
            drags: self.drags(),
            is_thermal: self.is_thermal(),
            viscous_strain: self.viscous_strain(),
            has_constant_capacity: self.has_constant_capacity(),
            parameter_count: self.parameter_count(),
            derivatives: match self.parameter_count() {
                count if count <= M::Parameters::LEN => count,
                _ => 0,
            },
            parameter_units: self.parameter_units(),
            has_parameter_derivatives: self.has_parameter_derivatives(),
        }
    }

    fn as_any(&self) -> &dyn Any {
        FreeEnergy::as_any(self)
    }

    fn duplicate(&self) -> Box<dyn Formulas<A>> {
        Box::new(FreeEnergy::duplicate(self))
    }

    fn parameter_names(&self) -> &'static [&'static str] {
        FreeEnergy::parameter_names(self)
    }

    fn together(&self) -> Option<&TogetherOf<M>> {
        // They store what forms keep, never the old variables in its place.
        let fits = const {
            M::EntropyFormOld::LEN <= A::Kept::LEN && M::TemperatureFormOld::LEN <= A::Kept::LEN
        };
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

    fn temperature_of(
        &self,
        x: &M::Variables,
        [entropy, guess, enough]: [f64; 3],
    ) -> Result<f64, InversionError> {
        let at_theta = FreeEnergy::caloric_at(self, *x);
        let caloric_at = |theta| (at_theta(theta).0, []);
        let found = temperature_near((guess, caloric_at(guess)), caloric_at, entropy, enough);
        found.map(|(theta, [])| theta)
    }

    fn entropy_hessian(&self, x: &M::Variables) -> M::Hessian {
        FreeEnergy::entropy_hessian(self, x)
    }

    fn viscosity(&self, theta: f64) -> (M::Viscosities, M::Viscosities) {
        FreeEnergy::viscosity(self, theta)
    }

    fn drag(&self, theta: f64) -> (M::Drag, M::Drag) {
        FreeEnergy::drag(self, theta)
    }

    fn keep_for_entropy_form(&self, x0: &M::Variables, kept: &mut A::Kept) {
        keep(x0, |x0| self.entropy_form_old(x0), kept);
    }

    fn entropy_form(
        &self,
        kept: &A::Kept,
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
        kept: &A::Kept,
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
        kept: &A::Kept,
        x1: &M::Variables,
        corners: &M::Corners,
    ) -> [M::Corners; 2] {
        with_kept(
            kept,
            |x0| self.entropy_form_old(x0),
            |old| FreeEnergy::mixed_states(self, x0, old, x1, corners),
        )
    }

    fn keep_for_temperature_form(&self, x0: &M::Variables, kept: &mut A::Kept) {
        keep(x0, |x0| self.temperature_form_old(x0), kept);
    }

    fn temperature_form(&self, kept: &A::Kept, x1: &M::Variables) -> (M::Response, M::Tangent) {
        with_kept(
            kept,
            |x0| self.temperature_form_old(x0),
            |old| FreeEnergy::temperature_form(self, old, x1),
        )
    }

    fn temperature_form_response(&self, kept: &A::Kept, x1: &M::Variables) -> M::Response {
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
        found: &mut [f64],
    ) {
        let by = FreeEnergy::temperature_form_adjoint(self, x0, x1, weights);
        copy(by.as_ref(), found);
    }

    fn temperature_form_tangent(
        &self,
        [x0, x1]: [&M::Variables; 2],
        direction: &[f64],
    ) -> M::Response {
        FreeEnergy::temperature_form_tangent(self, x0, x1, &parameters::<M>(direction))
    }

    fn entropy_form_adjoint(
        &self,
        [x0, x1]: [&M::Variables; 2],
        corners: &M::Corners,
        weights: &M::Response,
        found: &mut [f64],
    ) {
        let by = FreeEnergy::entropy_form_adjoint(self, x0, x1, corners, weights);
        copy(by.as_ref(), found);
    }

    fn entropy_form_tangent(
        &self,
        [x0, x1]: [&M::Variables; 2],
        corners: &M::Corners,
        direction: &[f64],
    ) -> M::Response {
        FreeEnergy::entropy_form_tangent(self, x0, x1, corners, &parameters::<M>(direction))
    }

    fn energy_by_parameters(&self, x: &M::Variables, found: &mut [f64]) {
        copy(FreeEnergy::energy_by_parameters(self, x).as_ref(), found);
    }

    fn viscosity_adjoint(&self, theta: f64, weights: &M::Viscosities, found: &mut [f64]) {
        copy(
            FreeEnergy::viscosity_adjoint(self, theta, weights).as_ref(),
            found,
        );
    }

    fn drag_adjoint(&self, theta: f64, weights: &M::Drag, found: &mut [f64]) {
        copy(
            FreeEnergy::drag_adjoint(self, theta, weights).as_ref(),
            found,
        );
    }
}
