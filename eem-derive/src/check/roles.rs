//! The arguments of the free energy: how many of each role, and in which order they are stored.

use crate::ast::{self, Argument, Input, Role};
use crate::checked::Variable;
use crate::ctxt::Ctxt;
use crate::message::attribute as message;

/// The arguments in the order of the state, which is independent of the order of the closure:
/// measures, dashpots, temperature.
pub(super) fn variables<'a>(input: &Input<'a>) -> Vec<Variable<'a>> {
    let by_role = Role::ALL.into_iter().flat_map(|role| of_role(input, role));
    by_role
        .map(|&Argument { ident, role }| Variable { ident, role })
        .collect()
}

/// Without a length there is no spring.
pub(super) fn check_stretch(cx: &Ctxt, input: &Input<'_>) {
    let closure = input.closure;
    if of_role(input, Role::Stretch).next().is_some() {
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

/// Two arguments with one name: the second would hide the first, also from `diff`.
pub(super) fn check_distinct(cx: &Ctxt, input: &Input<'_>) {
    for (i, argument) in input.arguments.iter().enumerate() {
        let name = ast::name(argument.ident);
        if input.arguments[..i]
            .iter()
            .any(|a| ast::name(a.ident) == name)
        {
            cx.error(argument.ident, &message::second_argument(argument.ident));
        }
    }
}

fn of_role<'i, 'a>(input: &'i Input<'a>, role: Role) -> impl Iterator<Item = &'i Argument<'a>> {
    let arguments = input.arguments.iter();
    arguments.filter(move |argument| argument.role == role)
}
