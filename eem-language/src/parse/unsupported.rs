//! Rust syntax that is not a formula: what it is and what to write instead.

use quote::ToTokens;
use syn::{BinOp, Expr, ExprPath, Member};

use crate::ast;
use crate::ctxt::Ctxt;
use crate::message::expression::syntax as message;

/// Reports an expression of a kind that a free energy does not have. Returns the formulas in it
/// that stand for numbers all the same, so that they are read as well.
pub(super) fn report<'a>(cx: &Ctxt, expr: &'a Expr) -> Vec<&'a Expr> {
    match expr {
        Expr::Assign(e) => {
            cx.error(e.eq_token, &message::not_allowed("="));
            vec![&e.right]
        }
        Expr::Cast(e) => {
            cx.error(e.as_token, &message::not_allowed("as"));
            vec![&e.expr]
        }
        Expr::Reference(e) => {
            cx.error(e.and_token, &message::not_allowed("a reference"));
            vec![&e.expr]
        }
        Expr::RawAddr(e) => {
            cx.error(e.and_token, &message::not_allowed("a reference"));
            vec![&e.expr]
        }
        Expr::Try(e) => {
            cx.error(e.question_token, &message::not_allowed("?"));
            vec![&e.expr]
        }
        Expr::Await(e) => {
            cx.error(e.await_token, &message::not_allowed(".await"));
            vec![&e.base]
        }
        Expr::Array(e) => {
            cx.error(e, &message::not_allowed("an array"));
            e.elems.iter().collect()
        }
        Expr::Tuple(e) => {
            cx.error(e, &message::not_allowed("a tuple"));
            e.elems.iter().collect()
        }
        Expr::Range(e) => {
            cx.error(e.limits, &message::not_allowed("a range"));
            e.start.iter().chain(&e.end).map(|end| &**end).collect()
        }
        other => {
            report_opaque(cx, other);
            Vec::new()
        }
    }
}

/// Reports the kinds of expressions that contain no formula, or none that is read as long as they are there.
fn report_opaque(cx: &Ctxt, expr: &Expr) {
    match expr {
        Expr::If(e) => cx.error(e.if_token, &message::not_allowed("if")),
        Expr::Match(e) => cx.error(e.match_token, &message::not_allowed("match")),
        Expr::Let(e) => cx.error(
            e.let_token,
            &message::not_allowed("a `let` without a block"),
        ),
        Expr::ForLoop(e) => cx.error(e.for_token, &message::not_allowed("for")),
        Expr::While(e) => cx.error(e.while_token, &message::not_allowed("while")),
        Expr::Loop(e) => cx.error(e.loop_token, &message::not_allowed("loop")),
        Expr::Return(e) => cx.error(e.return_token, &message::not_allowed("return")),
        Expr::Break(e) => cx.error(e.break_token, &message::not_allowed("break")),
        Expr::Continue(e) => cx.error(e.continue_token, &message::not_allowed("continue")),
        Expr::Closure(e) => cx.error(e, &message::not_allowed("an unnamed closure")),
        Expr::Macro(e) => cx.error(&e.mac.path, &message::not_allowed("a macro")),
        Expr::Repeat(e) => cx.error(e, &message::not_allowed("an array")),
        Expr::Struct(e) => cx.error(&e.path, &message::not_allowed("a struct")),
        Expr::Unsafe(e) => cx.error(e.unsafe_token, &message::not_allowed("an `unsafe` block")),
        Expr::Async(e) => cx.error(e.async_token, &message::not_allowed("an `async` block")),
        Expr::Const(e) => cx.error(e.const_token, &message::not_allowed("a `const` block")),
        Expr::TryBlock(e) => cx.error(e.try_token, &message::not_allowed("a `try` block")),
        Expr::Infer(e) => cx.error(e, &message::not_allowed("_")),
        Expr::Field(e) => report_field(cx, e),
        other => cx.error(other, &message::unsupported()),
    }
}

fn report_field(cx: &Ctxt, field: &syn::ExprField) {
    let of_self = matches!(&*field.base, Expr::Path(path) if path.path.is_ident("self"));
    match &field.member {
        Member::Named(name) if of_self => {
            cx.error(field, &message::field_access(Some(&ast::name(name))));
        }
        _ => cx.error(field.dot_token, &message::field_access(None)),
    }
}

/// Reports an operator that is not one of the four.
pub(super) fn report_operator(cx: &Ctxt, operator: BinOp) {
    let message = match operator {
        BinOp::BitXor(_) => message::caret(),
        _ => message::not_allowed(&operator.to_token_stream().to_string()),
    };
    cx.error(operator, &message);
}

/// Reports `a::b`, `a::<T>` and `<T>::a` where a bare name is expected.
pub(super) fn report_path(cx: &Ctxt, path: &ExprPath) {
    let mut segments = path.path.segments.iter();
    let plain = segments.all(|segment| segment.arguments.is_none());
    let message = match path.path.segments.last() {
        Some(last) if plain && path.qself.is_none() => {
            let text = path.to_token_stream().to_string().replace(' ', "");
            message::path(&text, &ast::name(&last.ident))
        }
        _ if path.qself.is_some() || path.path.segments.len() > 1 => {
            message::not_allowed("a path with `<…>`")
        }
        _ => message::not_allowed("a type argument"),
    };
    cx.error(path, &message);
}
