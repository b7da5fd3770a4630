//! The energy–entropy–momentum scheme in temperature form.
//!
//! ```text
//! θ* = D_θ e / D_θ s,   f* = D_λ e − θ* D_λ s,   g* = −(D_γ e − θ* D_γ s)
//! ```
//!
//! with partitioned discrete derivatives of e(λ, γ, θ) and s(λ, γ, θ) (Conde Martín, Betsch & García
//! Orden 2016, eqs. 37–39). `f*Δλ − g*Δγ + θ*Δs = Δe` exactly, hence the first law; `θ*` is
//! a mean of temperatures weighted with the heat capacity, hence positive, hence the second. No
//! inversion is needed: the new temperature is the unknown.

use crate::element::conjugates::element::{ElementScheme, Form, Placement, Start};
use eem_material::free_energy::{Entry, FormRows, Material};

/// See the module; with one damping or none.
#[derive(Clone, Copy, Debug)]
pub(crate) struct EemTemperature<const DAMPINGS: usize>;

impl<M: Material, const DAMPINGS: usize> ElementScheme<M> for EemTemperature<DAMPINGS> {
    const EXACT: bool = true;
    const ROWS: Option<FormRows<f64, M, Self::Old, Self::Memory>> = match M::ROWS {
        Some(rows) => Some(rows.temperature_form),
        None => None,
    };

    type Old = M::TemperatureFormOld;
    type Memory = ();
    type AtPoint<T: Entry> = [T; 0];
    type Damping<T: Entry> = [T; DAMPINGS];

    #[inline]
    fn placement(self) -> Placement {
        Placement::Ends
    }

    #[inline]
    fn old(model: &M, x0: &M::Variables, _: f64) -> Self::Old {
        model.temperature_form_old(x0)
    }

    fn memory(_: f64) -> Self::Memory {}

    #[inline]
    fn form(
        self,
        model: &M,
        start: &Start<M, Self::Old>,
        x: &M::Variables,
        (): &Self::Memory,
    ) -> Form<f64, M> {
        model.temperature_form(&start.old, x)
    }

    #[inline]
    fn response(
        self,
        model: &M,
        start: &Start<M, Self::Old>,
        x: &M::Variables,
        (): &Self::Memory,
    ) -> M::Response {
        model.temperature_form_response(&start.old, x)
    }

    #[cfg(feature = "gradients")]
    fn form_adjoint(
        self,
        model: &M,
        [x0, x1]: [&M::Variables; 2],
        (): &Self::Memory,
        weights: &M::Response,
    ) -> M::Parameters {
        model.temperature_form_adjoint(x0, x1, weights)
    }

    #[cfg(feature = "gradients")]
    fn form_tangent(
        self,
        model: &M,
        [x0, x1]: [&M::Variables; 2],
        (): &Self::Memory,
        direction: &M::Parameters,
    ) -> M::Response {
        model.temperature_form_tangent(x0, x1, direction)
    }
}
