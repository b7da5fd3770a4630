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

use crate::element::conjugates::corners::{find_corners, find_corners_of_each};
use crate::element::conjugates::element::{ElementScheme, Form, Infeasible, Placement, Start};
use eem_material::free_energy::{Array, Each, Entry, FormRows, FreeEnergy, Material, Rows};

/// See the module.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ExactForm {
    Entropy,
    Temperature,
}

/// A scheme with such a form, and with one damping or none.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Exact<const DAMPINGS: usize>(pub(crate) ExactForm);

/// What a form keeps of the old state. It tells the form of the step.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Kept<E, T> {
    Entropy(E),
    Temperature(T),
}

type KeptOf<M> =
    Kept<<M as FreeEnergy<f64>>::EntropyFormOld, <M as FreeEnergy<f64>>::TemperatureFormOld>;

/// The elements that are evaluated in one call.
const TOGETHER: usize = 32;

impl<M: Material, const DAMPINGS: usize> ElementScheme<M> for Exact<DAMPINGS> {
    const EXACT: bool = true;

    type Old = KeptOf<M>;
    /// Temperatures of mixed states, only in entropy form.
    type Memory = M::Corners;
    type AtPoint<T: Entry> = [T; 0];
    type Damping<T: Entry> = [T; DAMPINGS];

    #[inline]
    fn placement(self) -> Placement {
        Placement::Ends
    }

    #[inline]
    fn nothing(self) -> Self::Old {
        match self.0 {
            ExactForm::Entropy => Kept::Entropy(M::EntropyFormOld::filled(0.0)),
            ExactForm::Temperature => Kept::Temperature(M::TemperatureFormOld::filled(0.0)),
        }
    }

    // Each in its own place: one value for both forms would be copied as the larger one.
    #[inline]
    fn keep(self, model: &M, x0: &M::Variables, _: f64, is_prescribed: bool, old: &mut Self::Old) {
        if self.0 == ExactForm::Entropy && !is_prescribed {
            *old = Kept::Entropy(model.entropy_form_old(x0));
        } else {
            *old = Kept::Temperature(model.temperature_form_old(x0));
        }
    }

    #[inline]
    fn memory(theta0: f64) -> Self::Memory {
        M::Corners::filled(theta0)
    }

    #[inline]
    fn prepare(
        model: &M,
        start: &Start<M, Self::Old>,
        x: &M::Variables,
        corners: &mut Self::Memory,
    ) -> Result<(), Infeasible> {
        match &start.old {
            Kept::Entropy(old) if M::THERMAL => find_corners((model, [&start.x0, x], old), corners),
            _ => Ok(()),
        }
    }

    fn prepare_rows<'a>(
        each: impl Fn(usize) -> (&'a M, &'a Start<M, Self::Old>, &'a M::Variables),
        memories: &mut [Self::Memory],
    ) -> Result<(), Infeasible> {
        let is_entropy = |index: usize| matches!(each(index).1.old, Kept::Entropy(_));
        if !M::THERMAL || memories.is_empty() || !is_entropy(0) {
            return Ok(());
        }
        let step = |index: usize| {
            let (model, start, x) = each(index);
            (model, [&start.x0, x], entropy_of::<M>(&start.old))
        };
        find_corners_of_each(step, memories)
    }

    #[inline]
    fn form(
        self,
        model: &M,
        start: &Start<M, Self::Old>,
        x: &M::Variables,
        corners: &Self::Memory,
    ) -> Form<f64, M> {
        match &start.old {
            Kept::Entropy(old) => model.entropy_form(old, x, corners),
            Kept::Temperature(old) => model.temperature_form(old, x),
        }
    }

    /// For the entropy form the temperature form, which has no mixed states: with a small heat capacity their temperatures
    /// overflow away from the solution.
    #[cold]
    #[inline(never)]
    fn starting_form(
        model: &M,
        start: &Start<M, Self::Old>,
        x: &M::Variables,
    ) -> Option<Form<f64, M>> {
        match start.old {
            Kept::Entropy(_) => {
                let old = model.temperature_form_old(&start.x0);
                Some(model.temperature_form(&old, x))
            }
            Kept::Temperature(_) => None,
        }
    }

    #[inline]
    fn response(
        self,
        model: &M,
        start: &Start<M, Self::Old>,
        x: &M::Variables,
        corners: &Self::Memory,
    ) -> M::Response {
        match &start.old {
            Kept::Entropy(old) => model.entropy_form_response(old, x, corners),
            Kept::Temperature(old) => model.temperature_form_response(old, x),
        }
    }

    fn rows(self) -> Option<FormRows<f64, M, Self::Old, Self::Memory>> {
        M::ROWS?;
        Some(if self.0 == ExactForm::Entropy {
            FormRows {
                old: entropy_old::<M>,
                form: entropy_form::<M>,
                response: entropy_response::<M>,
            }
        } else {
            FormRows {
                old: temperature_old::<M>,
                form: temperature_form::<M>,
                response: temperature_response::<M>,
            }
        })
    }

    /// With old and new state exchanged, the ascending chain of mixed states is the descending one.
    #[cfg(feature = "gradients")]
    #[inline]
    fn exchanged(corners: &Self::Memory) -> Self::Memory {
        let mut exchanged = *corners;
        exchanged.as_mut().rotate_left(M::Corners::LEN / 2);
        exchanged
    }

    #[cfg(feature = "gradients")]
    fn form_adjoint(
        self,
        model: &M,
        start: &Start<M, Self::Old>,
        x: &M::Variables,
        corners: &Self::Memory,
        weights: &M::Response,
    ) -> M::Parameters {
        match start.old {
            Kept::Entropy(_) => model.entropy_form_adjoint(&start.x0, x, corners, weights),
            Kept::Temperature(_) => model.temperature_form_adjoint(&start.x0, x, weights),
        }
    }

    #[cfg(feature = "gradients")]
    fn form_tangent(
        self,
        model: &M,
        start: &Start<M, Self::Old>,
        x: &M::Variables,
        corners: &Self::Memory,
        direction: &M::Parameters,
    ) -> M::Response {
        match start.old {
            Kept::Entropy(_) => model.entropy_form_tangent(&start.x0, x, corners, direction),
            Kept::Temperature(_) => model.temperature_form_tangent(&start.x0, x, direction),
        }
    }
}

/// What the elements of a call in entropy form keep.
fn entropy_of<M: FreeEnergy<f64>>(old: &KeptOf<M>) -> &M::EntropyFormOld {
    match old {
        Kept::Entropy(old) => old,
        Kept::Temperature(_) => not_together(),
    }
}

/// The same in temperature form.
fn temperature_of<M: FreeEnergy<f64>>(old: &KeptOf<M>) -> &M::TemperatureFormOld {
    match old {
        Kept::Temperature(old) => old,
        Kept::Entropy(_) => not_together(),
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
