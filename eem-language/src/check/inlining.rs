//! What is known of helpers while a body is resolved.

use proc_macro2::Ident;

use super::scope::Scope;
use crate::ast;

/// A helper that is defined.
pub(super) struct Helper<'a> {
    pub(super) ident: &'a Ident,
    pub(super) used: bool,
    pub(super) definition: &'a ast::Helper<'a>,
    /// What its body sees.
    pub(super) scope: Scope,
}

/// The call that is inlined, with those inside of it.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Inlining {
    /// Levels of expressions that are being resolved.
    pub(super) level: usize,
    /// The level of the call in the formula.
    pub(super) start: usize,
    pub(super) calls: usize,
    pub(super) exhausted: bool,
}
