//! Check phase: [`ast`](crate::ast) → [`checked`](crate::checked).
//!
//! One function per rule, one file per subject. This file is the table of contents.

mod callee;
pub(crate) mod constants;
mod helpers;
mod inlining;
mod laws;
mod names;
mod parameters;
mod resolve;
mod resolver;
mod roles;
mod scope;

use crate::ast::Input;
use crate::checked::Checked;
use crate::ctxt::Ctxt;

/// Resolves all names and checks that the roles and the laws are complete.
///
/// What is wrong has been reported and is a hole in the result, so that the phases after this one
/// can look at the rest.
pub(crate) fn check<'a>(cx: &Ctxt, input: &'a Input<'a>) -> Checked<'a> {
    let variables = roles::variables(input);
    roles::check_measures(cx, input);
    roles::check_flow(cx, input);
    roles::check_counts(cx, input);
    names::check_arguments(cx, input);
    let mut used = parameters::Used::none(input);
    let energy = resolve::energy(cx, input, &variables, &mut used);
    let laws = laws::laws(cx, input, &variables, &mut used);
    laws::check_names(cx, input);
    laws::check_complete(cx, input);
    let sound = used.is_complete() && roles::are_sound(input);
    let scalar = parameters::scalar(cx, input, &used);
    parameters::check_used(cx, input, &used, scalar);
    Checked {
        original: input.original,
        krate: input.krate,
        scalar,
        parameters: parameters::parameters(cx, input, &used),
        variables,
        energy,
        viscosities: laws.viscosities,
        drag: laws.drag,
        sound,
    }
}
