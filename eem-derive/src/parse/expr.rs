//! Expressions: everything that is a formula becomes an [`ast::Expr`](crate::ast::Expr).

use syn::{BinOp, Expr as Syntax, UnOp};

use super::{block, number, unsupported};
use crate::ast::{Expr, ExprKind, Operator};
use crate::ctxt::Ctxt;
use crate::message::expression::syntax as message;

/// Reads an expression. Both sides of an operator and all arguments of a function are read before
/// giving up, so that no mistake hides another.
pub(super) fn expr<'a>(cx: &Ctxt, original: &'a Syntax) -> Option<Expr<'a>> {
    let (attrs, kind) = match original {
        Syntax::Group(group) => return expr(cx, &group.expr),
        Syntax::Paren(paren) => (&paren.attrs, expr(cx, &paren.expr).map(|inner| inner.kind)),
        Syntax::Lit(literal) => (&literal.attrs, number::literal(cx, &literal.lit)),
        Syntax::Path(path) => (&path.attrs, name(cx, path)),
        Syntax::Unary(unary) => (&unary.attrs, negation(cx, unary)),
        Syntax::Binary(binary) => (&binary.attrs, operation(cx, binary)),
        Syntax::Call(call) => (&call.attrs, function_call(cx, call)),
        Syntax::MethodCall(call) => (&call.attrs, method_call(cx, call)),
        Syntax::Block(block) => {
            let block = block::block(cx, block)?;
            return Some(Expr {
                original,
                kind: ExprKind::Block(block),
            });
        }
        other => {
            unsupported::report(cx, other);
            return None;
        }
    };
    if let Some(attribute) = attrs.first() {
        cx.error(attribute, &message::attribute());
    }
    Some(Expr {
        original,
        kind: kind?,
    })
}

fn name<'a>(cx: &Ctxt, path: &'a syn::ExprPath) -> Option<ExprKind<'a>> {
    let ident = path.path.get_ident().filter(|_| path.qself.is_none());
    if ident.is_none() {
        unsupported::report_path(cx, path);
    }
    ident.map(ExprKind::Name)
}

fn negation<'a>(cx: &Ctxt, unary: &'a syn::ExprUnary) -> Option<ExprKind<'a>> {
    let inner = expr(cx, &unary.expr);
    match unary.op {
        UnOp::Neg(_) => return Some(ExprKind::Negate(Box::new(inner?))),
        UnOp::Not(token) => cx.error(token, &message::not_operator()),
        UnOp::Deref(token) => cx.error(token, &message::dereference()),
        other => cx.error(other, &message::unsupported()),
    }
    None
}

fn operation<'a>(cx: &Ctxt, binary: &'a syn::ExprBinary) -> Option<ExprKind<'a>> {
    let left = expr(cx, &binary.left);
    let operator = match binary.op {
        BinOp::Add(_) => Some(Operator::Add),
        BinOp::Sub(_) => Some(Operator::Subtract),
        BinOp::Mul(_) => Some(Operator::Multiply),
        BinOp::Div(_) => Some(Operator::Divide),
        other => {
            unsupported::report_operator(cx, other);
            None
        }
    };
    let right = expr(cx, &binary.right);
    Some(ExprKind::Binary(
        operator?,
        Box::new(left?),
        Box::new(right?),
    ))
}

fn function_call<'a>(cx: &Ctxt, call: &'a syn::ExprCall) -> Option<ExprKind<'a>> {
    let arguments = arguments(cx, None, &call.args);
    let Syntax::Path(path) = &*call.func else {
        cx.error(&call.func, &message::callee());
        return None;
    };
    let ident = path.path.get_ident();
    if ident.is_none() {
        unsupported::report_path(cx, path);
    }
    Some(ExprKind::Call(ident?, arguments?))
}

fn method_call<'a>(cx: &Ctxt, call: &'a syn::ExprMethodCall) -> Option<ExprKind<'a>> {
    let arguments = arguments(cx, Some(&call.receiver), &call.args);
    if let Some(generics) = &call.turbofish {
        cx.error(generics, &message::generic_arguments());
        return None;
    }
    Some(ExprKind::Call(&call.method, arguments?))
}

/// All arguments, or nothing if one of them is wrong.
fn arguments<'a>(
    cx: &Ctxt,
    receiver: Option<&'a Syntax>,
    arguments: impl IntoIterator<Item = &'a Syntax>,
) -> Option<Vec<Expr<'a>>> {
    let all = receiver.into_iter().chain(arguments);
    let parsed: Vec<Option<Expr<'a>>> = all.map(|argument| expr(cx, argument)).collect();
    parsed.into_iter().collect()
}
