//! A name means one thing: no argument and no `let` hides another name.
//!
//! Rust would allow it. In a formula that is checked against paper it is a trap, and `diff` would
//! not see an argument behind a `let`.

use proc_macro2::Ident;

use super::callee::is_function;
use super::scope::{Meaning, Scope};
use crate::ast::{self, Input};
use crate::ctxt::Ctxt;
use crate::dialect::Dialect;
use crate::message::attribute;
use crate::message::expression as message;

/// Reports an argument that has the name of a field or of another argument.
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

/// Reports a `let` that hides a visible name.
pub(super) fn check_binding(cx: &Ctxt, scope: &Scope, ident: &Ident) {
    check(cx, scope, ident, |free| format!("let {free} = …;"));
}

/// Reports a helper that hides a visible name or has the name of a function.
pub(super) fn check_helper(cx: &Ctxt, scope: &Scope, ident: &Ident) {
    if is_function(ident) {
        let free = free(scope, ident);
        let message =
            message::binding_hides(ident, |_| "a function", &format!("let {free} = |…| …;"));
        return cx.error(ident, &message);
    }
    check(cx, scope, ident, |free| format!("let {free} = |…| …;"));
}

/// Reports an argument of a helper that hides a visible name.
pub(super) fn check_helper_argument(cx: &Ctxt, scope: &Scope, ident: &Ident) {
    check(cx, scope, ident, |free| format!("|{free}| …"));
}

fn check(cx: &Ctxt, scope: &Scope, ident: &Ident, instead: impl Fn(String) -> String) {
    let what: fn(Dialect) -> &'static str = match scope.resolve(ident) {
        Some(Meaning::Field(_) | Meaning::Array(..)) => Dialect::a_field,
        Some(Meaning::Argument(_) | Meaning::ForeignArgument(_) | Meaning::WrongArgument) => {
            |_| "an argument"
        }
        Some(Meaning::HelperArgument(_)) => |_| "an argument of a helper",
        Some(Meaning::Binding(_) | Meaning::Helper(_) | Meaning::OpenHelper) => {
            |_| "an earlier `let`"
        }
        Some(Meaning::ForeignBinding | Meaning::UnusedField | Meaning::Unreadable) | None => return,
    };
    let message = message::binding_hides(ident, what, &instead(free(scope, ident)));
    cx.error(ident, &message);
}

/// A name like this one that is not taken.
fn free(scope: &Scope, ident: &Ident) -> String {
    let numbered = (1..).map(|n| format!("{}_{n}", ast::name(ident)));
    let mut free = numbered.filter(|name| !scope.contains(name));
    free.next().unwrap_or_default()
}
