//! Blocks: `let` bindings followed by a value.

use proc_macro2::TokenTree;
use quote::ToTokens as _;
use syn::{Expr as Syntax, ExprBlock, Local, Pat, Stmt};

use super::expr::expr;
use super::helper;
use super::name::plain_name;
use crate::ast::{Binding, Block, Bound, Expr, ExprKind, Helper};
use crate::ctxt::Ctxt;
use crate::message::expression::syntax as message;

/// The body of a closure, which is a block or a bare expression.
pub(super) fn body<'a>(cx: &Ctxt, original: &'a Syntax) -> Block<'a> {
    if let Syntax::Block(body) = original {
        return block(cx, original, body);
    }
    Block {
        bindings: Vec::new(),
        value: Box::new(expr(cx, original)),
    }
}

/// Reads a block; reports every statement that is neither a `let` nor the value at the end.
pub(super) fn block<'a>(cx: &Ctxt, original: &'a Syntax, block: &'a ExprBlock) -> Block<'a> {
    if let Some(label) = &block.label {
        cx.error(label, &message::not_allowed("a label"));
    }
    if let Some(attribute) = block.attrs.first() {
        cx.error(attribute, &message::not_allowed("an attribute"));
    }
    let (last, statements) = match block.block.stmts.split_last() {
        Some((last, statements)) if stands_for_value(last) => (Some(last), statements),
        _ => (None, &*block.block.stmts),
    };
    let mut bindings = Vec::new();
    let mut before = None;
    for this in statements {
        if !is_rest(before, this) {
            bindings.push(statement(cx, original, this));
        }
        before = Some(this);
    }
    let value = match last {
        Some(rest) if is_rest(before, rest) => Expr::hole(original),
        Some(Stmt::Expr(syntax, semicolon)) => {
            let value = expr(cx, syntax);
            // In `return x;` the keyword has been reported.
            if let (Some(token), false) = (semicolon, matches!(value.kind, ExprKind::Wrong(_))) {
                cx.error(token, &message::semicolon_after_value());
            }
            value
        }
        Some(other) => match statement(cx, original, other).value {
            Bound::Value(value) => value,
            Bound::Helper(_) => Expr::hole(original),
        },
        None => {
            let end = block.block.brace_token.span.close();
            cx.error_at(end, &message::block_without_value());
            Expr::hole(original)
        }
    };
    Block {
        bindings,
        value: Box::new(value),
    }
}

/// Whether a statement begins with the operator behind an `if` or `match`. At the start of a statement,
/// Rust reads `if x > 1 { a } else { b } * c` as two: an `if`, and `*c`. The `if` has been reported.
fn is_rest(before: Option<&Stmt>, statement: &Stmt) -> bool {
    let Some(Stmt::Expr(Syntax::If(_) | Syntax::Match(_), None)) = before else {
        return false;
    };
    let first = statement.to_token_stream().into_iter().next();
    matches!(first, Some(TokenTree::Punct(_)))
}

/// Whether the last statement of a block is its value, perhaps with a `;` by mistake.
fn stands_for_value(statement: &Stmt) -> bool {
    match statement {
        Stmt::Expr(..) => true,
        Stmt::Macro(invocation) => invocation.semi_token.is_none(),
        Stmt::Local(_) | Stmt::Item(_) => false,
    }
}

/// The binding of a `let`. Any other statement is reported and becomes a binding without a name.
fn statement<'a>(cx: &Ctxt, block: &'a Syntax, statement: &'a Stmt) -> Binding<'a> {
    let mut value = Expr::hole(block);
    match statement {
        Stmt::Local(local) => return binding(cx, block, local),
        Stmt::Item(item) => cx.error(item, &message::not_allowed("an item")),
        Stmt::Macro(invocation) => cx.error(&invocation.mac.path, &message::not_allowed("a macro")),
        Stmt::Expr(syntax, _) => {
            value = expr(cx, syntax);
            // What is wrong in itself, such as an assignment, has been reported.
            if !matches!(value.kind, ExprKind::Wrong(_)) {
                cx.error(syntax, &message::statement_without_effect());
            }
        }
    }
    Binding {
        ident: None,
        value: Bound::Value(value),
    }
}

fn binding<'a>(cx: &Ctxt, block: &'a Syntax, local: &'a Local) -> Binding<'a> {
    if let Some(attribute) = local.attrs.first() {
        cx.error(attribute, &message::not_allowed("an attribute"));
    }
    let pat = match &local.pat {
        Pat::Type(typed) => {
            cx.error(&typed.ty, &message::not_allowed("a type"));
            &*typed.pat
        }
        pat => pat,
    };
    let ident = plain_name(cx, pat, message::let_pattern);
    let Some(init) = &local.init else {
        cx.error(local, &message::let_without_value());
        let value = Bound::Value(Expr::hole(block));
        return Binding { ident, value };
    };
    if let Some((token, _)) = &init.diverge {
        cx.error(token, &message::not_allowed("let … else"));
    }
    if let Some(closure) = helper::closure(&init.expr) {
        let helper = Helper {
            arguments: helper::arguments(cx, closure),
            body: body(cx, &closure.body),
        };
        let value = Bound::Helper(helper);
        return Binding { ident, value };
    }
    let value = Bound::Value(expr(cx, &init.expr));
    Binding { ident, value }
}
