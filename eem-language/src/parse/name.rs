//! Patterns that are a plain name.

use syn::{Ident, Pat, PatIdent};

use crate::ctxt::Ctxt;
use crate::message::Message;
use crate::message::expression::syntax::not_allowed;

/// The name of a pattern that is a plain name; reports `other` for any other pattern.
pub(super) fn plain_name<'a>(
    cx: &Ctxt,
    pat: &'a Pat,
    other: impl FnOnce() -> Message,
) -> Option<&'a Ident> {
    let Pat::Ident(PatIdent {
        by_ref: None,
        mutability,
        subpat: None,
        ident,
        ..
    }) = pat
    else {
        cx.error(pat, &other());
        return None;
    };
    if let Some(token) = mutability {
        cx.error(token, &not_allowed("mut"));
    }
    Some(ident)
}
