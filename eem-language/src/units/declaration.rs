//! A unit as it was written.

use syn::LitStr;

use super::grammar;
use crate::ctxt::Ctxt;
use crate::unit::Unit;

/// The name of the attribute.
pub(super) const ATTRIBUTE: &str = "unit";

/// What is said about the unit of a field or of a constant.
#[derive(Clone, Debug)]
pub(super) enum Declaration {
    /// Nothing.
    Missing,
    /// Something that has been reported.
    Unreadable,
    /// A unit, and how it was written.
    Unit(Unit, String),
}

/// The unit that a string says.
pub(super) fn unit_of(cx: &Ctxt, text: &LitStr) -> Declaration {
    match grammar::parse(&text.value()) {
        Ok(unit) => Declaration::Unit(unit, text.value().trim().to_owned()),
        Err(message) => {
            cx.error(text, &message);
            Declaration::Unreadable
        }
    }
}
