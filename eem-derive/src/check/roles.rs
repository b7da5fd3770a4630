//! The arguments of the free energy: how many of each role, and in which order they are stored.

use std::collections::BTreeSet;

use crate::ast::{self, Argument, Input, Role};
use crate::checked::Variable;
use crate::ctxt::Ctxt;
use crate::message::attribute as message;

/// The arguments in the order of the state, which is independent of the order of the closure:
/// measures, dashpots, temperature.
pub(super) fn variables<'a>(input: &Input<'a>) -> Vec<Variable<'a>> {
    let by_role = Role::ALL.into_iter().flat_map(|role| of_role(input, role));
    by_role
        .filter_map(|&Argument { ident, role }| Some(Variable { ident, role: role? }))
        .collect()
}

/// Without a length there is no spring.
pub(super) fn check_stretch(cx: &Ctxt, input: &Input<'_>) {
    let closure = input.closure;
    if of_role(input, Role::Stretch).next().is_some() || !input.arguments_complete {
        return;
    }
    if closure.inputs.is_empty() {
        cx.error(closure.inputs_begin, &message::no_stretch());
    } else {
        cx.error(&closure.inputs, &message::no_stretch());
    }
}

/// A spring has one length and one temperature.
pub(super) fn check_counts(cx: &Ctxt, input: &Input<'_>) {
    for role in [Role::Stretch, Role::Temperature] {
        let mut arguments = of_role(input, role);
        if let Some(first) = arguments.next() {
            for second in arguments {
                let message = message::second_role(role, second.ident, first.ident);
                cx.error(second.ident, &message);
            }
        }
    }
}

/// One stretch, at most one temperature, and all names differ.
pub(super) fn are_sound(input: &Input<'_>) -> bool {
    let count = |role| of_role(input, role).count();
    let names = input.arguments.iter().map(|argument| argument.ident);
    let names: BTreeSet<String> = names.map(ast::name).collect();
    input.arguments_complete
        && count(Role::Stretch) == 1
        && count(Role::Temperature) <= 1
        && names.len() == input.arguments.len()
}

fn of_role<'i, 'a>(input: &'i Input<'a>, role: Role) -> impl Iterator<Item = &'i Argument<'a>> {
    let arguments = input.arguments.iter();
    arguments.filter(move |argument| argument.role == Some(role))
}
