//! A name means one thing: no argument and no `let` hides another name.
//!
//! Rust would allow it. In a formula that is checked against paper it is a trap, and `diff` would
//! not see an argument behind a `let`.

use proc_macro2::Ident;

use super::scope::{Meaning, Scope};
use crate::ast::{self, Input};
use crate::ctxt::Ctxt;
use crate::message::attribute;
use crate::message::expression as message;

/// No argument has the name of a field or of another argument.
pub(super) fn check_arguments(cx: &Ctxt, input: &Input<'_>) {
    for (i, argument) in input.arguments.iter().enumerate() {
        let ident = argument.ident;
        let same = |other: &Ident| ast::name(other) == ast::name(ident);
        let mut fields = input.fields.iter().flatten();
        if input.arguments[..i].iter().any(|a| same(a.ident)) {
            cx.error(ident, &attribute::second_argument(ident));
        } else if fields.any(|field| !field.unused && same(field.ident)) {
            cx.error(ident, &attribute::argument_hides_field(ident));
        }
    }
}

/// A `let` does not hide what can be seen where it stands.
pub(super) fn check_binding(cx: &Ctxt, scope: &Scope, ident: &Ident) {
    let what = match scope.resolve(ident) {
        Some(Meaning::Field(_) | Meaning::Array(..)) => "a field",
        Some(Meaning::Argument(_) | Meaning::ForeignArgument(_) | Meaning::WrongArgument) => {
            "an argument"
        }
        Some(Meaning::Binding(_)) => "an earlier `let`",
        Some(Meaning::ForeignBinding | Meaning::UnusedField | Meaning::Unreadable) | None => return,
    };
    let free = (1..).map(|n| format!("{}_{n}", ast::name(ident)));
    let free = free.into_iter().find(|name| !scope.contains(name));
    let message = message::binding_hides(ident, what, &free.unwrap_or_default());
    cx.error(ident, &message);
}
