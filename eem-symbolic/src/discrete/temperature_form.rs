//! The discrete derivatives of e(λ, γ, θ) and s(λ, γ, θ): temperature is the variable.
//!
//! ```text
//! θ* = D_θ e / D_θ s
//! f* = D_λ e − θ* D_λ s = ½ Σ ( ψ[λ⁰, λ¹; θ] + (θ − θ*) S[λ⁰, λ¹; θ] ),  θ = θ¹, θ⁰
//! g* = −(D_γ e − θ* D_γ s)
//! ```
//!
//! (Conde Martín, Betsch & García Orden 2016, eqs. 37–39.) Energy is expressed by ψ and S, so that
//! D e − θ* D s loses no digits except in the difference θ − θ* of temperatures, see `latent`.

use super::latent::Latent;
use super::step::{Form, Step, mixed};
use crate::node::ExprId;

/// `[f*_a …, g*_k …, θ*, Δs]` and their tangent by rows.
pub(crate) fn temperature_form(step: &mut Step) -> Form {
    let star = mean(step);
    let (mut response, mut tangent) = (Vec::new(), Vec::new());
    let mut jump = Vec::new();
    for i in 0..step.mechanical {
        let pair = Pair::new(step, i, star.value);
        let derivative = pair.value(step);
        response.push(step.conjugate(i, derivative));
        for (j, &change) in star.partials.iter().enumerate() {
            let partial = pair.partial(step, j, change);
            tangent.push(step.conjugate(i, partial));
        }
        let increment = step.increment(i);
        jump.push(step.graph.mul(pair.entropies, increment));
    }
    let last = step.mechanical;
    let increment = step.increment(last);
    jump.push(step.graph.mul(star.entropy, increment));
    response.extend([star.value, step.half(&jump)]);
    tangent.extend(star.partials);
    let new = step.new.clone();
    tangent.extend((0..=last).map(|j| step.slope_at(step.entropy, j, &new)));
    Form { response, tangent }
}

/// θ*, `2 D_θ s`, and the derivatives of θ* with respect to x¹.
struct Star {
    value: ExprId,
    entropy: ExprId,
    partials: Vec<ExprId>,
}

fn mean(step: &mut Step) -> Star {
    let last = step.mechanical;
    let ends = [step.old[last], step.new[last]];
    let states = [step.old.clone(), step.new.clone()];
    let energies = states
        .each_ref()
        .map(|y| step.along(step.energy, last, ends, y));
    let entropies = states
        .each_ref()
        .map(|y| step.along(step.entropy, last, ends, y));
    let entropy = step.sum_of(&entropies);
    // Where neither difference depends on the other variables, a constant heat capacity drops out.
    if energies[0] == energies[1] && entropies[0] == entropies[1] {
        let value = step.quotient(energies[0], entropies[0]);
        let partials = step.new.clone().into_iter().map(|symbol| {
            let partial = step.partial(value, symbol);
            step.name(partial)
        });
        return Star {
            partials: partials.collect(),
            value,
            entropy,
        };
    }
    let energy = step.sum_of(&energies);
    let value = step.quotient(energy, entropy);
    let reciprocal = step.reciprocal(entropy);
    let mut partials = Vec::new();
    for symbol in step.new.clone() {
        let energy = energies.map(|energy| step.partial(energy, symbol));
        let energy = step.graph.sum(&energy);
        let entropy = entropies.map(|entropy| step.partial(entropy, symbol));
        let entropy = step.graph.sum(&entropy);
        let heat = step.graph.mul(value, entropy);
        let change = step.graph.sub(energy, heat);
        let partial = step.graph.mul(reciprocal, change);
        partials.push(step.name(partial));
    }
    Star {
        value,
        entropy,
        partials,
    }
}

/// The two edges in `y_i`, one at θ¹ and one at θ⁰.
struct Pair {
    edges: [Latent; 2],
    /// The sum of both entropy differences.
    entropies: ExprId,
}

impl Pair {
    fn new(step: &mut Step, i: usize, star: ExprId) -> Self {
        let (old, new) = (step.old.clone(), step.new.clone());
        let ends = [old[i], new[i]];
        let states = [mixed(i, &old, &new), mixed(i, &new, &old)];
        let edges = states.map(|state| Latent::new(step, i, ends, &state, star));
        let entropies = edges.each_ref().map(|edge| edge.entropy);
        let entropies = step.sum_of(&entropies);
        Self { edges, entropies }
    }

    fn value(&self, step: &mut Step) -> ExprId {
        let [first, second] = self.edges.each_ref().map(|edge| edge.value(step));
        step.half(&[first, second].concat())
    }

    /// The derivative with respect to `x_j¹`, where θ* changes by `change`.
    fn partial(&self, step: &mut Step, j: usize, change: ExprId) -> ExprId {
        let mut terms = Vec::new();
        for edge in &self.edges {
            terms.extend(edge.partials(step, step.new[j]));
        }
        let shift = step.graph.mul(self.entropies, change);
        terms.push(step.graph.neg(shift));
        step.half(&terms)
    }
}
