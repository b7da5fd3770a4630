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

use crate::element::conjugates::corners::find_corners_of_each;
use crate::element::conjugates::family::{ExactForm, OneSet};
use crate::element::conjugates::infeasible::Infeasible;
use crate::element::conjugates::start::{Form, Kept, KeptOf, Start};
use eem_material::free_energy::{Array, Each, FormRows, FreeEnergy, Material, Rows};

/// The elements that are evaluated in one call.
const TOGETHER: usize = 32;

/// [`Start::keep`], [`Start::form`] and [`Start::response`] of several elements in one call, where the model has them. The
/// elements of a call have no thermostats.
pub(crate) fn rows<M: Material>(scheme: OneSet) -> Option<FormRows<f64, M, KeptOf<M>, M::Corners>> {
    M::ROWS?;
    match scheme {
        OneSet::Exact(ExactForm::Entropy) => Some(FormRows {
            old: entropy_old::<M>,
            form: entropy_form::<M>,
            response: entropy_response::<M>,
        }),
        OneSet::Exact(ExactForm::Temperature) | OneSet::Damped => Some(FormRows {
            old: temperature_old::<M>,
            form: temperature_form::<M>,
            response: temperature_response::<M>,
        }),
        OneSet::Point(_) => None,
    }
}

/// [`Start::prepare`] of several elements, with [rows].
pub(crate) fn prepare_rows<'a, M: Material>(
    each: impl Fn(usize) -> (&'a M, &'a Start<M>, &'a M::Variables),
    corners: &mut [M::Corners],
) -> Result<(), Infeasible> {
    let is_entropy = |index: usize| matches!(each(index).1.old, Kept::Entropy(_));
    if !M::THERMAL || corners.is_empty() || !is_entropy(0) {
        return Ok(());
    }
    let step = |index: usize| {
        let (model, start, x) = each(index);
        (model, [&start.x0, x], entropy_of::<M>(&start.old))
    };
    find_corners_of_each(step, corners)
}

/// The temperatures of mixed states for the step back from the new state to the old one: with the states exchanged, the ascending chain
/// is the descending one.
#[cfg(feature = "gradients")]
#[inline]
pub(crate) fn exchanged<M: FreeEnergy<f64>>(corners: &M::Corners) -> M::Corners {
    let mut exchanged = *corners;
    exchanged.as_mut().rotate_left(M::Corners::LEN / 2);
    exchanged
}

/// Rejects an unstable trial of an exact scheme, by `∂Δs/∂θ¹ = C/θ¹` in its form.
#[inline]
pub(crate) fn check_stable<M: FreeEnergy<f64>>(
    x: &M::Variables,
    form: &Form<f64, M>,
) -> Result<(), Infeasible> {
    if !M::THERMAL {
        return Ok(());
    }
    let last = M::Variables::LEN - 1;
    Infeasible::unless_stable(x[last] * form.1[last + 1][last], x[last])
}

/// What the elements of a call in entropy form keep.
fn entropy_of<M: FreeEnergy<f64>>(old: &KeptOf<M>) -> &M::EntropyFormOld {
    match old {
        Kept::Entropy(old) => old,
        Kept::Temperature(_) | Kept::State(_) => not_together(),
    }
}

/// The same in temperature form.
fn temperature_of<M: FreeEnergy<f64>>(old: &KeptOf<M>) -> &M::TemperatureFormOld {
    match old {
        Kept::Temperature(old) => old,
        Kept::Entropy(_) | Kept::State(_) => not_together(),
    }
}

#[cold]
fn not_together() -> ! {
    unreachable!("the elements of a call have one form")
}

/// An element of a call: its model, what it keeps of the old state, its new variables and its temperatures of mixed states.
type Step<'a, M> = (
    &'a M,
    &'a KeptOf<M>,
    &'a <M as FreeEnergy<f64>>::Variables,
    &'a <M as FreeEnergy<f64>>::Corners,
);

/// The functions of a model for several elements; only called if it has them.
fn rows_of<M: Material>() -> Rows<f64, M> {
    M::ROWS.unwrap_or_else(|| unreachable!("only models with rows are called"))
}

fn entropy_old<'a, M: Material>(
    each: &Each<'_, (&'a M, &'a M::Variables)>,
    found: &mut [KeptOf<M>],
) {
    let mut old = [M::EntropyFormOld::filled(0.0); TOGETHER];
    for (part, found) in found.chunks_mut(TOGETHER).enumerate() {
        let old = &mut old[..found.len()];
        (rows_of::<M>().entropy_form.old)(&|index| each(part * TOGETHER + index), old);
        for (found, &old) in found.iter_mut().zip(&*old) {
            *found = Kept::Entropy(old);
        }
    }
}

fn entropy_form<M: Material>(each: &Each<'_, Step<'_, M>>, found: &mut [Form<f64, M>]) {
    let each = |index: usize| {
        let (model, old, x, corners) = each(index);
        (model, entropy_of::<M>(old), x, corners)
    };
    (rows_of::<M>().entropy_form.form)(&each, found);
}

fn entropy_response<M: Material>(each: &Each<'_, Step<'_, M>>, found: &mut [M::Response]) {
    let each = |index: usize| {
        let (model, old, x, corners) = each(index);
        (model, entropy_of::<M>(old), x, corners)
    };
    (rows_of::<M>().entropy_form.response)(&each, found);
}

fn temperature_old<'a, M: Material>(
    each: &Each<'_, (&'a M, &'a M::Variables)>,
    found: &mut [KeptOf<M>],
) {
    let mut old = [M::TemperatureFormOld::filled(0.0); TOGETHER];
    for (part, found) in found.chunks_mut(TOGETHER).enumerate() {
        let old = &mut old[..found.len()];
        (rows_of::<M>().temperature_form.old)(&|index| each(part * TOGETHER + index), old);
        for (found, &old) in found.iter_mut().zip(&*old) {
            *found = Kept::Temperature(old);
        }
    }
}

fn temperature_form<M: Material>(each: &Each<'_, Step<'_, M>>, found: &mut [Form<f64, M>]) {
    let each = |index: usize| {
        let (model, old, x, _) = each(index);
        (model, temperature_of::<M>(old), x, &())
    };
    (rows_of::<M>().temperature_form.form)(&each, found);
}

fn temperature_response<M: Material>(each: &Each<'_, Step<'_, M>>, found: &mut [M::Response]) {
    let each = |index: usize| {
        let (model, old, x, _) = each(index);
        (model, temperature_of::<M>(old), x, &())
    };
    (rows_of::<M>().temperature_form.response)(&each, found);
}
