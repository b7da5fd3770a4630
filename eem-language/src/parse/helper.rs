//! Helpers: `let f = |x, y| …;`.

use syn::{Expr as Syntax, ExprClosure, Pat, ReturnType};

use super::modifiers::check_modifiers;
use super::name::plain_name;
use crate::ctxt::Ctxt;
use crate::message::expression::{helper as message, syntax::not_allowed};

/// The closure that a `let` binds, if it binds one.
pub(super) fn closure(syntax: &Syntax) -> Option<&ExprClosure> {
    match syntax {
        Syntax::Group(group) => closure(&group.expr),
        Syntax::Paren(paren) => closure(&paren.expr),
        Syntax::Closure(closure) => Some(closure),
        _ => None,
    }
}

/// The arguments of a helper; `None` where one could not be read. Reports syntax that a helper cannot have.
pub(super) fn arguments<'a>(cx: &Ctxt, closure: &'a ExprClosure) -> Vec<Option<&'a syn::Ident>> {
    check(cx, closure);
    closure.inputs.iter().map(|pat| argument(cx, pat)).collect()
}

fn check(cx: &Ctxt, closure: &ExprClosure) {
    check_modifiers(cx, closure);
    if let ReturnType::Type(_, ty) = &closure.output {
        cx.error(ty, &not_allowed("a return type"));
    }
    if closure.inputs.is_empty() {
        cx.error(closure, &message::without_arguments());
    }
}

fn argument<'a>(cx: &Ctxt, pat: &'a Pat) -> Option<&'a syn::Ident> {
    if let Pat::Type(typed) = pat {
        cx.error(&typed.ty, &not_allowed("a type"));
        return argument(cx, &typed.pat);
    }
    plain_name(cx, pat, message::pattern)
}
