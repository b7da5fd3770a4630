//! The forms of the energy–entropy–momentum schemes: discrete derivatives, with `f*Δλ − g*Δγ + θ*Δs = Δe` exactly, hence the
//! first law. `θ*` is a mean of temperatures, hence positive, hence the second law. The local unknown is the new temperature.
//!
//! **Entropy form**, of `e(λ, γ, s) = ψ + θ̂ s` with `θ̂(λ, γ, s)`: `S(λ, γ, θ̂) = s`,
//!
//! ```text
//! f* = D_λ e,  g* = −D_γ e,  θ* = D_s e
//! ```
//!
//! with the symmetrised partitioned discrete derivatives of García Orden & Romero (2012), eq. (28). It needs the
//! [temperatures of mixed states](super::corners).
//!
//! **Temperature form**, with partitioned discrete derivatives of `e(λ, γ, θ)` and `s(λ, γ, θ)` (Conde Martín, Betsch & García
//! Orden 2016, eqs. 37–39),
//!
//! ```text
//! θ* = D_θ e / D_θ s,   f* = D_λ e − θ* D_λ s,   g* = −(D_γ e − θ* D_γ s)
//! ```
//!
//! It also serves elements in entropy form while a thermostat prescribes their temperature: mixed states have temperatures of
//! their own even where both ends are at T, and θ* of the entropy form is not T then. Here it is, and heat is T times the entropy
//! given.

use crate::element::conjugates::infeasible::Infeasible;
use crate::element::conjugates::start::Form;
use eem_material::arrays::Arrays;
use eem_material::free_energy::Array;
use eem_material::tabled::Tabled;

/// The temperatures of mixed states for the step back from the new state to the old one: with the states exchanged, the ascending chain
/// is the descending one.
#[cfg(feature = "gradients")]
#[inline]
pub(crate) fn exchanged<A: Arrays>(corners: &A::Corners) -> A::Corners {
    let mut exchanged = *corners;
    exchanged.as_mut().rotate_left(A::Corners::LEN / 2);
    exchanged
}

/// Rejects an unstable trial of an exact scheme, by `∂Δs/∂θ¹ = C/θ¹` in its form.
#[inline]
pub(crate) fn check_stable<A: Arrays>(
    model: &Tabled<A>,
    x: &A::Variables,
    form: &Form<A>,
) -> Result<(), Infeasible> {
    if !model.is_thermal() {
        return Ok(());
    }
    let last = A::Variables::LEN - 1;
    Infeasible::unless_stable(x[last] * form.1[last + 1][last], x[last])
}
