//! The contribution of an edge in `y_i` at a temperature θ to a force at another temperature θ̄.
//!
//! ```text
//! ψ[y_i⁰, y_i¹; θ] + (θ − θ̄) S[y_i⁰, y_i¹; θ]
//! ```
//!
//! Where `S[y_i⁰, y_i¹]` does not depend on θ, `ψ[y_i⁰, y_i¹]` is linear in θ and the sum is
//! `ψ[y_i⁰, y_i¹; θ̄]`: one evaluation, without a temperature gap θ − θ̄.

use super::step::Step;
use crate::node::{ExprId, Node, Symbol};
use crate::number::Number;

/// The contribution of one edge.
pub(super) struct Latent {
    /// `ψ[y_i⁰, y_i¹]` at θ, or at θ̄ if `gap` is `None`.
    psi: ExprId,
    /// `S[y_i⁰, y_i¹; θ]`.
    pub(super) entropy: ExprId,
    gap: Option<Gap>,
}

struct Gap {
    theta: Symbol,
    /// `θ − θ̄`.
    value: ExprId,
}

impl Latent {
    /// The edge from `ends[0]` to `ends[1]` at the other variables of `state`; `mean` is θ̄.
    pub(super) fn new(
        step: &mut Step,
        i: usize,
        ends: [Symbol; 2],
        state: &[Symbol],
        mean: ExprId,
    ) -> Self {
        let entropy = step.along(step.entropy, i, ends, state);
        if !step.feels_temperature(entropy, state) {
            return Self {
                psi: step.along_at(step.psi, i, ends, state, mean),
                entropy,
                gap: None,
            };
        }
        let theta = state[step.mechanical];
        let top = step.graph.variable(theta);
        let value = step.graph.sub(top, mean);
        let value = step.name(value);
        Self {
            psi: step.along(step.psi, i, ends, state),
            entropy,
            gap: Some(Gap { theta, value }),
        }
    }

    /// `ψ[…]` and `(θ − θ̄) S[…]`, with definitions in place of locals: they have most factors in common.
    pub(super) fn value(&self, step: &mut Step) -> [ExprId; 2] {
        let psi = step.locals.resolve(&step.graph, self.psi);
        let latent = match &self.gap {
            Some(gap) => {
                let entropy = step.locals.resolve(&step.graph, self.entropy);
                distribute(step, gap.value, entropy)
            }
            None => step.graph.number(Number::ZERO),
        };
        [psi, latent]
    }

    /// The derivative of the sum with respect to a symbol at constant θ̄, as a list of terms.
    pub(super) fn partials(&self, step: &mut Step, symbol: Symbol) -> Vec<ExprId> {
        let Some(gap) = &self.gap else {
            return vec![step.partial(self.psi, symbol)];
        };
        let entropy = step.partial(self.entropy, symbol);
        let latent = distribute(step, gap.value, entropy);
        // ∂ψ[y_i⁰, y_i¹; θ]/∂θ = −S[y_i⁰, y_i¹; θ] cancels the derivative of θ itself.
        if symbol == gap.theta {
            return vec![latent];
        }
        vec![latent, step.partial(self.psi, symbol)]
    }
}

/// `factor · sum`, multiplied out: response and tangent have factors of the terms in common, but not
/// the sum.
fn distribute(step: &mut Step, factor: ExprId, sum: ExprId) -> ExprId {
    let Node::Sum { constant, terms } = step.graph.node(sum).clone() else {
        return step.graph.mul(factor, sum);
    };
    let mut products = vec![(constant, factor)];
    for (coefficient, term) in terms {
        products.push((coefficient, step.graph.mul(factor, term)));
    }
    step.graph.weighted_sum(Number::ZERO, &products)
}
