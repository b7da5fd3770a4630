//! The discrete derivative of a free energy without temperature.

use super::step::{Form, Step, mixed};

/// `[f*_a …, g*_k …]` and their tangent by rows.
///
/// ```text
/// f* = D_λ ψ,  g* = −D_γ ψ
/// ```
pub(crate) fn elastic_form(step: &mut Step) -> Form {
    let count = step.mechanical;
    let (old, new) = (step.old.clone(), step.new.clone());
    let (mut response, mut tangent) = (Vec::new(), Vec::new());
    for i in 0..count {
        let ends = [old[i], new[i]];
        let renewed = mixed(i, &new, &old);
        let renewed = step.along(step.psi, i, ends, &renewed);
        let reversed = mixed(i, &old, &new);
        let reversed = step.along(step.psi, i, ends, &reversed);
        let derivative = step.half(&[renewed, reversed]);
        response.push(step.conjugate(i, derivative));
        for &symbol in &new {
            let partials = [
                step.partial(renewed, symbol),
                step.partial(reversed, symbol),
            ];
            let partial = step.half(&partials);
            tangent.push(step.conjugate(i, partial));
        }
    }
    Form { response, tangent }
}
