//! Partitioned discrete derivatives of the internal energy, and their tangents.
//!
//! ```text
//! D_i F = ½ ( F[x_i⁰, x_i¹ | x_j¹ (j < i), x_j⁰ (j > i)] + F[x_i⁰, x_i¹ | x_j⁰ (j < i), x_j¹ (j > i)] )
//! Σ_i D_i F (x_i¹ − x_i⁰) = F(x¹) − F(x⁰)
//! ```
//!
//! (García Orden & Romero 2012, eq. 28): divided differences along the edges of two staircases from
//! x⁰ to x¹, one that renews the variables in order and one that renews them in reverse order.
//! Every form returns the algorithmic quantities followed by their derivatives with respect to x¹.

mod edge;
mod elastic;
mod entropy_form;
mod latent;
mod logarithm;
mod mixed_states;
mod step;
mod temperature_form;

pub(crate) use elastic::elastic_form;
pub(crate) use entropy_form::{entropy_form, entropy_form_with_corners};
pub(crate) use mixed_states::mixed_states;
pub(crate) use step::Step;
pub(crate) use temperature_form::temperature_form;
