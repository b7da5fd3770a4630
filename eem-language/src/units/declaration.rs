//! A unit as it was written.

use syn::LitStr;

use super::grammar;
use crate::ctxt::Ctxt;
use crate::unit::Unit;

/// The name of the attribute.
pub(super) const ATTRIBUTE: &str = "unit";

/// The declaration of the unit of a field or of a constant.
#[derive(Clone, Debug)]
pub(super) enum Declaration {
    /// There is none.
    Missing,
    /// It has an error, which has been reported.
    Unreadable,
    /// A unit, and how it was written.
    Unit(Unit, String),
}

/// Reads the text of a unit; reports an error in it.
pub(super) fn unit_of(cx: &Ctxt, text: &LitStr) -> Declaration {
    match grammar::parse(&text.value()) {
        Ok(unit) => Declaration::Unit(unit, text.value().trim().to_owned()),
        Err(message) => {
            cx.error(text, &message);
            Declaration::Unreadable
        }
    }
}
