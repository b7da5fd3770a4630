//! Expressions: everything that is a formula becomes an [`ast::Expr`](crate::ast::Expr).

use syn::{BinOp, Expr as Syntax, UnOp};

use super::{block, number, unsupported};
use crate::ast::{Expr, ExprKind, Operator};
use crate::ctxt::Ctxt;
use crate::message::expression::syntax as message;

/// Reads an expression. What is no formula is reported and becomes [`ExprKind::Wrong`]; everything
/// around it and inside of it is read all the same, so that no mistake hides another.
pub(super) fn expr<'a>(cx: &Ctxt, original: &'a Syntax) -> Expr<'a> {
    let (attrs, kind) = match original {
        Syntax::Group(group) => return expr(cx, &group.expr),
        Syntax::Paren(paren) => (&*paren.attrs, expr(cx, &paren.expr).kind),
        Syntax::Lit(literal) => (&*literal.attrs, number::literal(cx, &literal.lit)),
        Syntax::Path(path) => (&*path.attrs, name(cx, path)),
        Syntax::Unary(unary) => (&*unary.attrs, negation(cx, unary)),
        Syntax::Binary(binary) => (&*binary.attrs, operation(cx, binary)),
        Syntax::Call(call) => (&*call.attrs, function_call(cx, call)),
        Syntax::MethodCall(call) => (&*call.attrs, method_call(cx, call)),
        Syntax::Block(block) => {
            let block = block::block(cx, original, block);
            (&[][..], ExprKind::Block(block))
        }
        other => {
            let parts = unsupported::report(cx, other);
            (&[][..], wrong(cx, parts))
        }
    };
    if let Some(attribute) = attrs.first() {
        cx.error(attribute, &message::attribute());
    }
    Expr { original, kind }
}

fn name<'a>(cx: &Ctxt, path: &'a syn::ExprPath) -> ExprKind<'a> {
    let ident = path.path.get_ident().filter(|_| path.qself.is_none());
    if ident.is_none() {
        unsupported::report_path(cx, path);
    }
    ident.map_or(ExprKind::Wrong(Vec::new()), ExprKind::Name)
}

/// A hole with everything in it that can be read.
fn wrong<'a>(cx: &Ctxt, parts: impl IntoIterator<Item = &'a Syntax>) -> ExprKind<'a> {
    ExprKind::Wrong(parts.into_iter().map(|part| expr(cx, part)).collect())
}

fn negation<'a>(cx: &Ctxt, unary: &'a syn::ExprUnary) -> ExprKind<'a> {
    match unary.op {
        UnOp::Neg(_) => return ExprKind::Negate(Box::new(expr(cx, &unary.expr))),
        UnOp::Not(token) => cx.error(token, &message::not_operator()),
        UnOp::Deref(token) => cx.error(token, &message::dereference()),
        other => cx.error(other, &message::unsupported()),
    }
    wrong(cx, [&*unary.expr])
}

fn operation<'a>(cx: &Ctxt, binary: &'a syn::ExprBinary) -> ExprKind<'a> {
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
    match operator {
        Some(operator) => ExprKind::Binary(operator, Box::new(left), Box::new(right)),
        None => ExprKind::Wrong(vec![left, right]),
    }
}

fn function_call<'a>(cx: &Ctxt, call: &'a syn::ExprCall) -> ExprKind<'a> {
    let arguments = call.args.iter().map(|argument| expr(cx, argument));
    let arguments = arguments.collect();
    let Syntax::Path(path) = &*call.func else {
        cx.error(&call.func, &message::callee());
        return ExprKind::Wrong(arguments);
    };
    let Some(ident) = path.path.get_ident() else {
        unsupported::report_path(cx, path);
        return ExprKind::Wrong(arguments);
    };
    ExprKind::Call(ident, arguments)
}

fn method_call<'a>(cx: &Ctxt, call: &'a syn::ExprMethodCall) -> ExprKind<'a> {
    let mut arguments = vec![expr(cx, &call.receiver)];
    arguments.extend(call.args.iter().map(|argument| expr(cx, argument)));
    if let Some(generics) = &call.turbofish {
        cx.error(generics, &message::generic_arguments());
    }
    ExprKind::Call(&call.method, arguments)
}
