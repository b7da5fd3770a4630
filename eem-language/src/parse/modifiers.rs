//! Modifiers of a closure, such as `move`: Rust allows them, a formula does not.

use proc_macro2::TokenStream;
use quote::ToTokens;
use syn::ExprClosure;

use crate::ctxt::Ctxt;
use crate::message::expression::syntax::not_allowed;

/// Reports whatever stands before the arguments.
pub(super) fn check_modifiers(cx: &Ctxt, closure: &ExprClosure) {
    let refuse = |token: Option<TokenStream>, modifier: &str| {
        if let Some(token) = token {
            cx.error(token, &not_allowed(modifier));
        }
    };
    let tokens = |token: &dyn ToTokens| token.to_token_stream();
    refuse(closure.lifetimes.as_ref().map(|t| tokens(t)), "for<…>");
    refuse(closure.constness.as_ref().map(|t| tokens(t)), "const");
    refuse(closure.asyncness.as_ref().map(|t| tokens(t)), "async");
    refuse(closure.capture.as_ref().map(|t| tokens(t)), "move");
}
