//! Expressions: everything that is a formula becomes an [`ast::Expr`](crate::ast::Expr).

use syn::{BinOp, Expr as Syntax, UnOp};

use super::{block, number, unsupported};
use crate::ast::{Entry, Expr, ExprKind, Operator, is_upper_case};
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
        Syntax::Index(index) => (&*index.attrs, entry(cx, index)),
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
        cx.error(attribute, &message::not_allowed("an attribute"));
    }
    Expr { original, kind }
}

fn name<'a>(cx: &Ctxt, path: &'a syn::ExprPath) -> ExprKind<'a> {
    match path.path.get_ident().filter(|_| path.qself.is_none()) {
        Some(ident) => ExprKind::Name(ident),
        None if is_constant(path) => ExprKind::Constant(&path.path),
        None => {
            unsupported::report_path(cx, path);
            ExprKind::Wrong(Vec::new())
        }
    }
}

/// Whether a path of several names ends like that of a constant: `crate::gas::R`, or leads into `consts`.
fn is_constant(path: &syn::ExprPath) -> bool {
    let mut segments = path.path.segments.iter();
    let plain = segments.all(|segment| segment.arguments.is_none());
    let mut from_last = path
        .path
        .segments
        .iter()
        .rev()
        .map(|segment| &segment.ident);
    let upper = from_last.next().is_some_and(is_upper_case);
    let module = from_last.next();
    let named = module.is_some_and(|module| upper || module == "consts");
    plain && named && path.qself.is_none()
}

/// `name[2]`
fn entry<'a>(cx: &Ctxt, original: &'a syn::ExprIndex) -> ExprKind<'a> {
    let array = match &*original.expr {
        Syntax::Path(path) if path.qself.is_none() => path.path.get_ident(),
        _ => None,
    };
    let literal = match &*original.index {
        Syntax::Lit(syn::ExprLit {
            lit: syn::Lit::Int(literal),
            ..
        }) => Some(literal),
        _ => None,
    };
    if array.is_none() {
        let brackets = original.bracket_token.span.join();
        cx.error_at(brackets, &message::index_of_value());
    }
    let Some(literal) = literal else {
        cx.error(&original.index, &message::index_is_not_a_literal());
        return wrong(cx, array.is_none().then_some(&*original.expr));
    };
    let index = literal.base10_parse();
    match array.zip(index.ok()) {
        Some((array, index)) => ExprKind::Entry(Entry {
            array,
            index,
            literal,
        }),
        None if array.is_some() => {
            cx.error(literal, &message::index_is_not_a_literal());
            wrong(cx, [])
        }
        None => wrong(cx, [&*original.expr]),
    }
}

/// A hole with everything in it that can be read.
fn wrong<'a>(cx: &Ctxt, parts: impl IntoIterator<Item = &'a Syntax>) -> ExprKind<'a> {
    ExprKind::Wrong(parts.into_iter().map(|part| expr(cx, part)).collect())
}

fn negation<'a>(cx: &Ctxt, unary: &'a syn::ExprUnary) -> ExprKind<'a> {
    match unary.op {
        UnOp::Neg(_) => return ExprKind::Negate(Box::new(expr(cx, &unary.expr))),
        UnOp::Not(token) => cx.error(token, &message::not_allowed("!")),
        UnOp::Deref(token) => cx.error(token, &message::not_allowed("a `*` without a left factor")),
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
        cx.error(generics, &message::not_allowed("a type argument"));
    }
    ExprKind::Call(&call.method, arguments)
}
