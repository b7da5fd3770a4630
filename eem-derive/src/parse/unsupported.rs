//! Rust syntax that is not a formula: what it is and what to write instead.

use quote::ToTokens;
use syn::{BinOp, Expr, ExprPath, Member};

use crate::ast;
use crate::ctxt::Ctxt;
use crate::message::expression::syntax as message;

/// Reports an expression of a kind that a free energy does not have.
pub(super) fn report(cx: &Ctxt, expr: &Expr) {
    match expr {
        Expr::If(e) => cx.error(e.if_token, &message::control_flow("if")),
        Expr::Match(e) => cx.error(e.match_token, &message::control_flow("match")),
        Expr::Let(e) => cx.error(e.let_token, &message::control_flow("let")),
        Expr::ForLoop(e) => cx.error(e.for_token, &message::repetition("for")),
        Expr::While(e) => cx.error(e.while_token, &message::repetition("while")),
        Expr::Loop(e) => cx.error(e.loop_token, &message::repetition("loop")),
        Expr::Return(e) => cx.error(e.return_token, &message::jump("return")),
        Expr::Break(e) => cx.error(e.break_token, &message::jump("break")),
        Expr::Continue(e) => cx.error(e.continue_token, &message::jump("continue")),
        Expr::Assign(e) => cx.error(e.eq_token, &message::assignment("=")),
        Expr::Cast(e) => cx.error(e.as_token, &message::cast()),
        Expr::Closure(e) => cx.error(e, &message::closure()),
        Expr::Index(e) => cx.error_at(e.bracket_token.span.join(), &message::index()),
        Expr::Macro(e) => cx.error(&e.mac.path, &message::invocation()),
        Expr::Reference(e) => cx.error(e.and_token, &message::reference()),
        Expr::Try(e) => cx.error(e.question_token, &message::question_mark()),
        Expr::Array(e) => cx.error(e, &message::aggregate("an array")),
        Expr::Repeat(e) => cx.error(e, &message::aggregate("an array")),
        Expr::Tuple(e) => cx.error(e, &message::aggregate("a tuple")),
        Expr::Struct(e) => cx.error(&e.path, &message::aggregate("a struct")),
        Expr::Range(e) => cx.error(e.limits, &message::aggregate("a range")),
        Expr::Unsafe(e) => cx.error(e.unsafe_token, &message::label_or_modifier()),
        Expr::Async(e) => cx.error(e.async_token, &message::label_or_modifier()),
        Expr::Const(e) => cx.error(e.const_token, &message::label_or_modifier()),
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
    let text = operator.to_token_stream().to_string();
    let message = match operator {
        BinOp::BitXor(_) => message::caret(),
        BinOp::Rem(_) => message::remainder(),
        BinOp::Eq(_)
        | BinOp::Lt(_)
        | BinOp::Le(_)
        | BinOp::Ne(_)
        | BinOp::Ge(_)
        | BinOp::Gt(_)
        | BinOp::And(_)
        | BinOp::Or(_) => message::comparison(&text),
        BinOp::BitAnd(_) | BinOp::BitOr(_) | BinOp::Shl(_) | BinOp::Shr(_) => {
            message::bit_operator(&text)
        }
        // The rest are `+=` and its relatives.
        _ => message::assignment(&text),
    };
    cx.error(operator, &message);
}

/// Reports `a::b`, `a::<T>` and `<T>::a` where a bare name is expected.
pub(super) fn report_path(cx: &Ctxt, path: &ExprPath) {
    let last = path.path.segments.last();
    let last = last.map(|segment| ast::name(&segment.ident));
    match last {
        Some(_) if path.path.segments.len() == 1 && path.qself.is_none() => {
            cx.error(path, &message::generic_arguments());
        }
        last => {
            let text = path.to_token_stream().to_string().replace(' ', "");
            cx.error(path, &message::path(&text, &last.unwrap_or_default()));
        }
    }
}
