//! The staggered scheme: a fractional step, mechanics first and heat second.
//!
//! ```text
//! mechanics   q and p move at fixed γ and s:    e(λ, γ⁰, s⁰), forces D_λ e
//! heat        γ and s evolve at fixed q and p:  g* = −D_γ e, θ* = D_s e
//! ```
//!
//! Each part is a step of [`EemEntropy`](crate::element::conjugates::EemEntropy) with the other part switched off, so that
//! each satisfies both laws and conserves the momenta; together they are of first order (Romero 2010, part II; Kern,
//! Romero, Conde Martín & García Orden 2021, §I). Only the solver distinguishes the parts.

/// The part of the physics that is stepped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Phase {
    Whole,
    /// Positions and momenta; internal variables stay.
    Mechanics,
    /// Internal variables; positions and momenta stay.
    Heat,
}

impl Phase {
    /// Positions and momenta change.
    pub(crate) const fn moves(self) -> bool {
        matches!(self, Self::Whole | Self::Mechanics)
    }

    /// Viscous stretches, entropies and prescribed temperatures change.
    pub(crate) const fn heats(self) -> bool {
        matches!(self, Self::Whole | Self::Heat)
    }
}
