//! Values of a free energy that are more than numbers.

use crate::array::Array;
use crate::number::scalar::Scalar;

/// Entropy and heat capacity of an element at one temperature.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Caloric<S> {
    /// `S(θ)`, J/K.
    pub entropy: S,
    /// `C = θ ∂S/∂θ`, J/K.
    pub heat_capacity: S,
    /// The sum of the absolute values of the terms of `S`, J/K; times ε it bounds the rounding of `entropy`.
    pub magnitude: S,
}

/// Forces and slopes that determine the rates of a state. `V` is an array with an entry per variable of `x = (π₁ …
/// π_M, γ₁ … γ_K, θ)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rates<V> {
    /// `(f₁ … f_M, g₁ … g_K, c)` with `f = ∂ψ/∂π`, `g = −∂ψ/∂γ` and `c = θ ∂s/∂θ`, J/K; without c if there is no
    /// temperature.
    pub forces: V,
    /// `(∂s/∂π₁ … ∂s/∂π_M, ∂s/∂γ₁ … ∂s/∂γ_K, 0)`; all zero without temperature.
    pub slopes: V,
}

/// NaN, for derivatives that have not been generated.
pub(crate) fn absent<S: Scalar, A: Array<S>>() -> A {
    A::filled(S::from_f64(f64::NAN))
}
