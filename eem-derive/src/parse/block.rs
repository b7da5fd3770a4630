//! Blocks: `let` bindings followed by a value.

use syn::{ExprBlock, Local, Pat, PatIdent, Stmt};

use super::expr::expr;
use crate::ast::{Binding, Block};
use crate::ctxt::Ctxt;
use crate::message::expression::syntax as message;

/// Reads a block; reports every statement that is neither a `let` nor the value at the end.
pub(super) fn block<'a>(cx: &Ctxt, block: &'a ExprBlock) -> Option<Block<'a>> {
    if let Some(label) = &block.label {
        cx.error(label, &message::label_or_modifier());
    }
    if let Some(attribute) = block.attrs.first() {
        cx.error(attribute, &message::attribute());
    }
    let (value, statements) = match block.block.stmts.split_last() {
        Some((value, statements)) if is_value(value) => (Some(value), statements),
        _ => (None, &*block.block.stmts),
    };
    let bindings = statements.iter().filter_map(|stmt| statement(cx, stmt));
    let bindings = bindings.collect();
    let value = match value {
        Some(Stmt::Expr(value, _)) => expr(cx, value),
        Some(other) => {
            statement(cx, other);
            None
        }
        None => {
            let end = block.block.brace_token.span.close();
            cx.error_at(end, &message::block_without_value());
            None
        }
    };
    Some(Block {
        bindings,
        value: Box::new(value?),
    })
}

/// Stands where the value of a block stands.
fn is_value(statement: &Stmt) -> bool {
    match statement {
        Stmt::Expr(_, semicolon) => semicolon.is_none(),
        Stmt::Macro(invocation) => invocation.semi_token.is_none(),
        Stmt::Local(_) | Stmt::Item(_) => false,
    }
}

fn statement<'a>(cx: &Ctxt, statement: &'a Stmt) -> Option<Binding<'a>> {
    match statement {
        Stmt::Local(local) => return binding(cx, local),
        Stmt::Item(item) => cx.error(item, &message::item_in_block()),
        Stmt::Expr(value, _) => {
            // Says what is wrong inside first: an assignment is not merely without effect.
            if expr(cx, value).is_some() {
                cx.error(value, &message::statement_without_effect());
            }
        }
        Stmt::Macro(invocation) => cx.error(&invocation.mac.path, &message::invocation()),
    }
    None
}

fn binding<'a>(cx: &Ctxt, local: &'a Local) -> Option<Binding<'a>> {
    if let Some(attribute) = local.attrs.first() {
        cx.error(attribute, &message::attribute());
    }
    let pat = match &local.pat {
        Pat::Type(typed) => {
            cx.error(&typed.ty, &message::let_type());
            &*typed.pat
        }
        pat => pat,
    };
    let ident = match pat {
        Pat::Ident(PatIdent {
            by_ref: None,
            mutability: None,
            subpat: None,
            ident,
            ..
        }) => Some(ident),
        other => {
            cx.error(other, &message::let_pattern());
            None
        }
    };
    let Some(init) = &local.init else {
        cx.error(local, &message::let_without_value());
        return None;
    };
    if let Some((token, _)) = &init.diverge {
        cx.error(token, &message::let_else());
    }
    let value = expr(cx, &init.expr);
    Some(Binding {
        ident: ident?,
        value: value?,
    })
}
