//! Materials that evaluate several elements in one call.

use crate::values::Caloric;

/// The most elements of a call.
pub const MOST_TOGETHER: usize = 32;

/// The forms of the discrete derivatives; without a temperature both are the same.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ExactForm {
    /// [`FreeEnergy::entropy_form`](crate::FreeEnergy::entropy_form).
    Entropy,
    /// [`FreeEnergy::temperature_form`](crate::FreeEnergy::temperature_form).
    Temperature,
}

/// Steps of several elements, an entry for each.
#[derive(Clone, Copy, Debug)]
pub struct Steps<'a, X, C> {
    /// What the form keeps of the old state.
    pub kept: &'a [&'a [f64]],
    /// The new variables.
    pub x1: &'a [X],
    /// The temperatures of the mixed states; unused in temperature form.
    pub corners: &'a [C],
}

/// The functions of a [`FreeEnergy`](crate::FreeEnergy) that are evaluated most often, for at most [`MOST_TOGETHER`] elements of one material
/// with the same parameters. The results have the bits of the functions for one element.
pub trait Together<X, V, C, R, T>: Send + Sync {
    /// The smallest number of elements for which one call is worthwhile.
    fn least(&self) -> usize;

    /// Stores what a form keeps of the old state.
    fn keep(&self, form: ExactForm, x0: &[X], kept: &mut [&mut [f64]]);

    /// The responses and their tangents.
    fn form(&self, form: ExactForm, steps: Steps<'_, X, C>, found: &mut [(R, T)]);

    /// The responses alone.
    fn response(&self, form: ExactForm, steps: Steps<'_, X, C>, found: &mut [R]);

    /// [`FreeEnergy::mixed_states`](crate::FreeEnergy::mixed_states).
    fn mixed_states(&self, steps: Steps<'_, X, C>, found: &mut [[C; 2]]);

    /// [`FreeEnergy::viscosity`](crate::FreeEnergy::viscosity) at these temperatures; a material without temperature ignores them.
    fn viscosity(&self, theta: &[f64], found: &mut [(V, V)]);

    /// [`FreeEnergy::caloric_at`](crate::FreeEnergy::caloric_at), at the temperatures of these variables.
    fn caloric_at(&self, x: &[X], found: &mut [(Caloric<f64>, f64)]);
}
