//! Collects the errors of all phases, so that a user sees them at once.

use std::cell::RefCell;

use proc_macro2::Span;
use quote::ToTokens;

use crate::message::Message;

/// The errors found so far.
///
/// Every phase takes a `&Ctxt`, reports what is wrong and goes on as far as it can; the end of
/// the last phase is a [`Ctxt::barrier`].
#[derive(Debug, Default)]
pub(crate) struct Ctxt {
    errors: RefCell<Vec<syn::Error>>,
}

impl Ctxt {
    /// A collector without errors.
    pub(crate) fn new() -> Self {
        Self::default()
    }

    /// Reports `message` at the given tokens, which should be as few as show the mistake.
    pub(crate) fn error(&self, tokens: impl ToTokens, message: &Message) {
        self.push(syn::Error::new_spanned(tokens, message));
    }

    /// Reports `message` at a single span, for delimiters and other places without tokens.
    pub(crate) fn error_at(&self, span: Span, message: &Message) {
        self.push(syn::Error::new(span, message));
    }

    fn push(&self, error: syn::Error) {
        self.errors.borrow_mut().push(error);
    }

    /// The value if nothing was reported, otherwise all errors in one, in the order of the source.
    pub(crate) fn barrier<T>(&self, value: Option<T>) -> syn::Result<T> {
        let mut errors = self.errors.take();
        // Stable: errors at one place stay in the order of the phases.
        errors.sort_by_cached_key(|error| position(error.span()));
        match errors.into_iter().reduce(combined) {
            Some(error) => Err(error),
            None => Ok(value.unwrap_or_else(|| unreachable!("a phase without a value says why"))),
        }
    }
}

/// Whether a token stands before another one; unknown without a compiler.
pub(crate) fn precedes(first: Span, second: Span) -> bool {
    position(first) < position(second)
}

/// Line and column, where there is a compiler that knows them.
fn position(span: Span) -> (usize, usize) {
    if proc_macro::is_available() {
        let span = span.unwrap();
        return (span.line(), span.column());
    }
    (0, 0)
}

fn combined(mut first: syn::Error, second: syn::Error) -> syn::Error {
    first.combine(second);
    first
}

impl Drop for Ctxt {
    fn drop(&mut self) {
        if !std::thread::panicking() {
            assert!(
                self.errors.borrow().is_empty(),
                "errors were reported and not shown"
            );
        }
    }
}
