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
            cx.error(e.eq_token, &message::assignment("="));
            vec![&e.right]
        }
        Expr::Cast(e) => {
            cx.error(e.as_token, &message::cast());
            vec![&e.expr]
        }
        Expr::Reference(e) => {
            cx.error(e.and_token, &message::reference());
            vec![&e.expr]
        }
        Expr::RawAddr(e) => {
            cx.error(e.and_token, &message::reference());
            vec![&e.expr]
        }
        Expr::Try(e) => {
            cx.error(e.question_token, &message::question_mark());
            vec![&e.expr]
        }
        Expr::Await(e) => {
            cx.error(e.await_token, &message::waiting());
            vec![&e.base]
        }
        Expr::Array(e) => {
            cx.error(e, &message::aggregate("an array"));
            e.elems.iter().collect()
        }
        Expr::Tuple(e) => {
            cx.error(e, &message::aggregate("a tuple"));
            e.elems.iter().collect()
        }
        Expr::Range(e) => {
            cx.error(e.limits, &message::range());
            e.start.iter().chain(&e.end).map(|end| &**end).collect()
        }
        other => {
            report_opaque(cx, other);
            Vec::new()
        }
    }
}

/// The kinds that contain no formula, or none worth reading before they are gone.
fn report_opaque(cx: &Ctxt, expr: &Expr) {
    match expr {
        Expr::If(e) => cx.error(e.if_token, &message::control_flow("if")),
        Expr::Match(e) => cx.error(e.match_token, &message::control_flow("match")),
        Expr::Let(e) => cx.error(e.let_token, &message::let_without_block()),
        Expr::ForLoop(e) => cx.error(e.for_token, &message::repetition("for")),
        Expr::While(e) => cx.error(e.while_token, &message::repetition("while")),
        Expr::Loop(e) => cx.error(e.loop_token, &message::repetition("loop")),
        Expr::Return(e) => cx.error(e.return_token, &message::jump("return")),
        Expr::Break(e) => cx.error(e.break_token, &message::jump("break")),
        Expr::Continue(e) => cx.error(e.continue_token, &message::jump("continue")),
        Expr::Closure(e) => cx.error(e, &message::closure()),
        Expr::Macro(e) => cx.error(&e.mac.path, &message::invocation()),
        Expr::Repeat(e) => cx.error(e, &message::aggregate("an array")),
        Expr::Struct(e) => cx.error(&e.path, &message::aggregate("a struct")),
        Expr::Unsafe(e) => cx.error(e.unsafe_token, &message::label_or_modifier()),
        Expr::Async(e) => cx.error(e.async_token, &message::label_or_modifier()),
        Expr::Const(e) => cx.error(e.const_token, &message::label_or_modifier()),
        Expr::TryBlock(e) => cx.error(e.try_token, &message::label_or_modifier()),
        Expr::Infer(e) => cx.error(e, &message::placeholder()),
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
    let last = last.map_or_else(String::new, |segment| ast::name(&segment.ident));
    let message = if path.path.segments.len() == 1 && path.qself.is_none() {
        message::generic_arguments()
    } else {
        let text = path.to_token_stream().to_string().replace(' ', "");
        message::path(&text, &last)
    };
    cx.error(path, &message);
}
