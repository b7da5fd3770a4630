//! Entropy residuals of the mixed states (corners) at trial temperatures, and their heat capacities.
//!
//! ```text
//! S(A_k) − s⁰ = S(A_k−1) − s⁰ + (θ_k − θ_k−1) S[θ_k−1, θ_k](A_k−1) + (y_k¹ − y_k⁰) S[y_k⁰, y_k¹](A_k)
//! ```
//!
//! along the staircase of [`entropy_form`](super::entropy_form), and for `S(B_k) − s¹` with the other sign of the last
//! term. Divided differences keep the digits of a small change, and call no function of the new state.

use super::step::{Form, Step};
use crate::model::heat_capacity;
use crate::node::{ExprId, Symbol};

/// `[S(c) − s_c …, θ_c S_θ(c) …]` of the states `A_1 … A_n, B_1 … B_n`.
pub(crate) fn mixed_states(step: &mut Step, theta: Symbol) -> Form {
    let capacity = heat_capacity(&mut step.graph, step.entropy, theta);
    let (old, new) = (step.old.clone(), step.new.clone());
    let up = step.staircase(0, &new, &old);
    let down = step.staircase(step.mechanical, &old, &new);
    let (mut response, mut tangent) = (Vec::new(), Vec::new());
    for (stairs, is_up) in [(up, true), (down, false)] {
        let mut excess: Option<ExprId> = None;
        for (i, pair) in stairs.windows(2).enumerate() {
            let [before, point] = pair else { continue };
            let last = step.mechanical;
            let ends = [before[last], point[last]];
            let slope = step.along(step.entropy, last, ends, before);
            let [from, to] = ends.map(|theta| step.graph.variable(theta));
            let change = step.graph.sub(to, from);
            let by_temperature = step.graph.mul(slope, change);
            let slope = step.along(step.entropy, i, [old[i], new[i]], point);
            let increment = step.increment(i);
            let by_variable = step.graph.mul(slope, increment);
            let by_variable = if is_up {
                by_variable
            } else {
                step.graph.neg(by_variable)
            };
            let terms: Vec<_> = excess
                .into_iter()
                .chain([by_temperature, by_variable])
                .collect();
            let sum = step.graph.sum(&terms);
            excess = Some(step.name(sum));
            response.extend(excess);
            tangent.push(step.at(capacity, point));
        }
    }
    Form { response, tangent }
}
