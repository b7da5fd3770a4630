//! Check phase: [`ast`](crate::ast) → [`checked`](crate::checked).
//!
//! One function per rule, one file per subject. This file is the table of contents.

mod call;
mod laws;
mod parameters;
mod resolve;
mod roles;
mod scope;

use crate::ast::Input;
use crate::checked::Checked;
use crate::ctxt::Ctxt;

/// Resolves all names and checks that the roles and the laws are complete. Nothing only if
/// something was reported.
pub(crate) fn check<'a>(cx: &Ctxt, input: &'a Input<'a>) -> Option<Checked<'a>> {
    let variables = roles::variables(input);
    roles::check_stretch(cx, input);
    roles::check_counts(cx, input);
    roles::check_distinct(cx, input);
    let mut used = parameters::Used::none(&input.fields);
    let energy = resolve::energy(cx, input, &variables, &mut used);
    let viscosities = laws::viscosities(cx, input, &variables, &mut used);
    laws::check_names(cx, input);
    laws::check_complete(cx, input);
    let parameters = parameters::parameters(cx, input, &used);
    let scalar = parameters::scalar(cx, input, &used);
    Some(Checked {
        original: input.original,
        krate: input.krate,
        scalar,
        parameters,
        variables,
        energy: energy?,
        viscosities: viscosities?,
    })
}
