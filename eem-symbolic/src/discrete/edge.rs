//! Divided differences of e(y, s) along one edge of a staircase, from E(y, θ) and S(y, θ) and without inverting S.
//!
//! ```text
//! θ̄ = e[s_a, s_b] = E[θ_a, θ_b] / S[θ_a, θ_b]                                       at fixed y
//! e[y_i⁰, y_i¹]  = ψ[y_i⁰, y_i¹; θ_b] + (θ_b − θ̄) S[y_i⁰, y_i¹; θ_b],  θ̄ at y_i⁰      at fixed s
//! ```
//!
//! The second identity splits `E(y¹, θ_b) − E(y⁰, θ_a)` at `(y⁰, θ_b)` and eliminates `θ_b − θ_a`
//! with `S(y¹, θ_b) = S(y⁰, θ_a)`. It contains no difference of energies, and θ̄ lies between `θ_a`
//! and `θ_b` wherever the heat capacity is positive.

use std::collections::BTreeSet;

use super::latent::Latent;
use super::step::{Point, Step};
use crate::node::{ExprId, Symbol};

/// A divided difference along an edge and its partial derivatives.
pub(super) struct Edge {
    pub(super) value: ExprId,
    /// With respect to the symbols of the edge that depend on the new state, in order of the symbols.
    pub(super) partials: Vec<(Symbol, ExprId)>,
}

/// The mean temperature between two states that differ in temperature only.
struct Mean {
    /// `E[θ_a, θ_b]` and `S[θ_a, θ_b]`.
    energy: ExprId,
    entropy: ExprId,
    value: ExprId,
}

/// Edge in entropy at fixed y: θ̄.
pub(super) fn thermal(step: &mut Step, a: &Point, b: &Point) -> Edge {
    let mean = mean(step, a, b);
    let reciprocal = step.reciprocal(mean.entropy);
    let mut partials = Vec::new();
    for symbol in step.moving(a, b) {
        let change = mean.change(step, symbol);
        let partial = step.graph.mul(reciprocal, change);
        partials.push((symbol, step.name(partial)));
    }
    Edge {
        value: mean.value,
        partials,
    }
}

/// Edge in `y_i` at fixed entropy, from `a` with the old `y_i` to `b` with the new.
pub(super) fn mechanical(step: &mut Step, i: usize, a: &Point, b: &Point) -> Edge {
    let mean = mean(step, a, b);
    let ends = [step.old[i], step.new[i]];
    let latent = Latent::new(step, i, ends, b, mean.value);
    let value = latent.value(step);
    let value = step.graph.sum(&value);
    let weight = step.quotient(latent.entropy, mean.entropy);
    let mut partials = Vec::new();
    for symbol in step.moving(a, b) {
        let change = mean.change(step, symbol);
        let change = step.graph.mul(weight, change);
        let mut terms = latent.partials(step, symbol);
        terms.push(step.graph.neg(change));
        let partial = step.graph.sum(&terms);
        partials.push((symbol, step.name(partial)));
    }
    Edge {
        value: step.name(value),
        partials,
    }
}

fn mean(step: &mut Step, a: &Point, b: &Point) -> Mean {
    let last = step.mechanical;
    let ends = [a[last], b[last]];
    let energy = step.along(step.energy, last, ends, a);
    let entropy = step.along(step.entropy, last, ends, a);
    let value = step.quotient(energy, entropy);
    Mean {
        energy,
        entropy,
        value,
    }
}

impl Mean {
    /// `S[θ_a, θ_b] ∂θ̄ = ∂E[θ_a, θ_b] − θ̄ ∂S[θ_a, θ_b]`.
    fn change(&self, step: &mut Step, symbol: Symbol) -> ExprId {
        let energy = step.partial(self.energy, symbol);
        let entropy = step.partial(self.entropy, symbol);
        let heat = step.graph.mul(self.value, entropy);
        let change = step.graph.sub(energy, heat);
        step.name(change)
    }
}

impl Step {
    /// The symbols of two states that depend on the new state.
    fn moving(&self, a: &Point, b: &Point) -> BTreeSet<Symbol> {
        let symbols = a.iter().chain(b).copied();
        symbols
            .filter(|symbol| !self.old.contains(symbol))
            .collect()
    }
}
