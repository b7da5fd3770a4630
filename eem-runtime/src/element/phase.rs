//! The staggered scheme, a fractional step with mechanics first and heat second; and states at rest.
//!
//! ```text
//! mechanics   q and p move at fixed γ and s:    e(λ, γ⁰, s⁰), forces D_λ e
//! heat        γ and s evolve at fixed q and p:  g* = −D_γ e, θ* = D_s e
//! ```
//!
//! A prescribed temperature is that of both parts.
//!
//! Each part is a step of [`EemEntropy`](crate::element::conjugates::EemEntropy) with the other part switched off, so that
//! each satisfies both laws and conserves the momenta; together they are of first order (Romero 2010, part II; Kern,
//! Romero, Conde Martín & García Orden 2021, §I). Only the solver distinguishes the parts.

/// The part of the physics that is stepped. The order makes each method below a single comparison.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Phase {
    /// Internal variables; positions and momenta stay.
    Heat,
    Whole,
    /// The whole, but at prescribed temperatures and in a step of infinite length: a state at rest.
    Relaxed,
    /// The same with the viscous stretches of the old state.
    Held,
    /// Positions and momenta; internal variables stay.
    Mechanics,
}

impl Phase {
    /// Positions and momenta change.
    pub(crate) const fn moves(self) -> bool {
        !matches!(self, Self::Heat)
    }

    /// Viscous stretches and entropies change with time.
    pub(crate) const fn heats(self) -> bool {
        matches!(self, Self::Whole | Self::Heat | Self::Relaxed)
    }

    /// The new state is at rest.
    pub(crate) const fn is_at_rest(self) -> bool {
        matches!(self, Self::Held | Self::Relaxed)
    }
}
