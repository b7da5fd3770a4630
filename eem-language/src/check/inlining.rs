//! Helpers, and how far the call that is inlined has been expanded.

use proc_macro2::Ident;

use super::scope::Scope;
use crate::ast;

/// A helper that is defined.
pub(super) struct Helper<'a> {
    pub(super) ident: &'a Ident,
    pub(super) used: bool,
    pub(super) definition: &'a ast::Helper<'a>,
    /// The names that its body can use.
    pub(super) scope: Scope,
}

/// The expansion of the outermost call and the calls inside it.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Inlining {
    /// Depth of the expression that is being resolved; a call counts as several levels.
    pub(super) level: usize,
    /// The level of the outermost call.
    pub(super) start: usize,
    /// Calls expanded so far.
    pub(super) calls: usize,
    /// Whether there are too many calls or levels.
    pub(super) exhausted: bool,
}
