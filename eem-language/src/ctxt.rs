//! Collects the errors and warnings of all phases, so that a user sees them at once.

use std::cell::{Cell, RefCell};

use proc_macro2::{Span, TokenStream};
use quote::ToTokens;

use crate::dialect::Dialect;
use crate::message::Message;

/// The errors found so far.
///
/// Every phase takes a `&Ctxt`, reports what is wrong and goes on as far as it can; the end of
/// the last phase is a [`Ctxt::barrier`].
#[derive(Debug, Default)]
pub(crate) struct Ctxt {
    dialect: Dialect,
    reports: RefCell<Vec<Report>>,
    /// The warnings, with their places.
    warnings: RefCell<Vec<(Span, Message)>>,
    /// The calls of helpers whose bodies are being visited, outermost first, as quoted.
    calls: RefCell<Vec<String>>,
    /// Number of calls of [`mute`](Self::mute) that have not ended.
    muted: Cell<usize>,
}

/// One error.
#[derive(Debug)]
pub(crate) struct Report {
    /// The message at its place.
    error: syn::Error,
    /// The tokens there, if there are any.
    tokens: TokenStream,
    pub(crate) message: Message,
    /// The calls of helpers in which it was found: it is reported once for all of them.
    pub(crate) calls: Vec<String>,
}

impl Ctxt {
    /// A collector without errors.
    pub(crate) fn new(dialect: Dialect) -> Self {
        let mut cx = Self::default();
        cx.dialect = dialect;
        cx
    }

    /// How the model is written.
    pub(crate) fn dialect(&self) -> Dialect {
        self.dialect
    }

    /// Reports `message` at the given tokens, which should be as few as show the mistake.
    pub(crate) fn error(&self, tokens: impl ToTokens, message: &Message) {
        let tokens = tokens.into_token_stream();
        let words = message.whole(self.dialect, &[]);
        self.push(syn::Error::new_spanned(&tokens, words), tokens, message);
    }

    /// Warns at the first of the given tokens; once, if it is about the body of a helper.
    pub(crate) fn warn(&self, tokens: impl ToTokens, message: &Message) {
        if self.is_muted() {
            return;
        }
        let warning = (syn::spanned::Spanned::span(&tokens), message.clone());
        let mut warnings = self.warnings.borrow_mut();
        let place = format!("{:?}", warning.0);
        let is_same =
            |(span, same): &(Span, Message)| *same == warning.1 && format!("{span:?}") == place;
        if !warnings.iter().any(is_same) {
            warnings.push(warning);
        }
    }

    /// All warnings.
    pub(crate) fn take_warnings(&self) -> Vec<(Span, Message)> {
        self.warnings.take()
    }

    /// Reports `message` at a single span, for delimiters and other places without tokens.
    pub(crate) fn error_at(&self, span: Span, message: &Message) {
        let words = message.whole(self.dialect, &[]);
        self.push(syn::Error::new(span, words), TokenStream::new(), message);
    }

    /// From here on, reports are about the body of a helper in this call.
    pub(crate) fn enter(&self, call: String) {
        self.calls.borrow_mut().push(call);
    }

    /// The end of what [`enter`](Self::enter) began.
    pub(crate) fn leave(&self) {
        self.calls.borrow_mut().pop();
    }

    /// From here on nothing is reported, because all has been reported before.
    pub(crate) fn mute(&self) {
        self.muted.set(self.muted.get() + 1);
    }

    /// The end of what [`mute`](Self::mute) began.
    pub(crate) fn unmute(&self) {
        self.muted.set(self.muted.get() - 1);
    }

    /// Whether nothing is reported.
    pub(crate) fn is_muted(&self) -> bool {
        self.muted.get() > 0
    }

    fn push(&self, error: syn::Error, tokens: TokenStream, message: &Message) {
        if self.is_muted() {
            return;
        }
        let mut reports = self.reports.borrow_mut();
        let calls = self.calls.borrow();
        // From the innermost call to the one in the formula.
        let calls: Vec<String> = calls.iter().rev().map(|call| format!("`{call}`")).collect();
        let calls = (!calls.is_empty()).then(|| calls.join(", called in "));
        let place = format!("{:?}", error.span());
        let same = reports.iter_mut().find(|report| {
            let same_place = || format!("{:?}", report.error.span()) == place;
            !report.calls.is_empty() && report.message == *message && same_place()
        });
        match (same, calls) {
            (Some(report), Some(calls)) => {
                if !report.calls.contains(&calls) {
                    report.calls.push(calls);
                }
            }
            (_, calls) => reports.push(Report {
                error,
                tokens,
                message: message.clone(),
                calls: calls.into_iter().collect(),
            }),
        }
    }

    /// All errors, in the order of the phases.
    pub(crate) fn take_reports(&self) -> Vec<Report> {
        self.reports.take()
    }

    /// The value if nothing was reported, otherwise all errors in one, in the order of the source.
    pub(crate) fn barrier<T>(&self, value: Option<T>) -> syn::Result<T> {
        let mut reports = self.take_reports();
        // Stable: errors at one place stay in the order of the phases.
        reports.sort_by_cached_key(|report| position(report.span()));
        let errors = reports.into_iter();
        let errors = errors.map(|report| report.into_error(self.dialect));
        match errors.reduce(combined) {
            Some(error) => Err(error),
            None => Ok(value.unwrap_or_else(|| unreachable!("a phase without a value says why"))),
        }
    }
}

impl Report {
    /// The place from the first to the last of its tokens.
    pub(crate) fn span(&self) -> Span {
        self.error.span()
    }

    fn into_error(self, dialect: Dialect) -> syn::Error {
        if self.calls.is_empty() {
            return self.error;
        }
        syn::Error::new_spanned(self.tokens, self.message.whole(dialect, &self.calls))
    }
}

/// Whether a token stands before another one.
pub(crate) fn precedes(first: Span, second: Span) -> bool {
    position(first) < position(second)
}

/// Line and column.
fn position(span: Span) -> (usize, usize) {
    let start = span.start();
    (start.line, start.column)
}

fn combined(mut first: syn::Error, second: syn::Error) -> syn::Error {
    first.combine(second);
    first
}

impl Drop for Ctxt {
    fn drop(&mut self) {
        if !std::thread::panicking() {
            assert!(
                self.reports.borrow().is_empty(),
                "errors were reported and not shown"
            );
        }
    }
}
