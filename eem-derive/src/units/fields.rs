//! Reads `#[unit("…")]` on the fields of the struct.

use syn::{Attribute, Data, DeriveInput, LitStr};

use super::grammar;
use super::unit::Unit;
use crate::ctxt::Ctxt;
use crate::message::unit as message;

/// The name of the attribute.
const ATTRIBUTE: &str = "unit";

/// What is said about the unit of a field.
#[derive(Debug)]
pub(super) enum Declaration {
    /// Nothing.
    Missing,
    /// Something that has been reported.
    Unreadable,
    /// A unit, and how it was written.
    Unit(Unit, String),
}

/// The declarations of all named fields, in their order.
pub(super) fn read(cx: &Ctxt, input: &DeriveInput) -> Vec<Declaration> {
    for attribute in input.attrs.iter().filter(|a| a.path().is_ident(ATTRIBUTE)) {
        cx.error(attribute.path(), &message::not_on_a_field());
    }
    let Data::Struct(data) = &input.data else {
        return Vec::new();
    };
    let fields = data.fields.iter();
    fields.map(|field| declaration(cx, &field.attrs)).collect()
}

fn declaration(cx: &Ctxt, attributes: &[Attribute]) -> Declaration {
    let mut declared = Declaration::Missing;
    for attribute in attributes.iter().filter(|a| a.path().is_ident(ATTRIBUTE)) {
        if !matches!(declared, Declaration::Missing) {
            cx.error(attribute.path(), &message::second());
            return Declaration::Unreadable;
        }
        declared = read_one(cx, attribute);
    }
    declared
}

fn read_one(cx: &Ctxt, attribute: &Attribute) -> Declaration {
    let Ok(text) = attribute.parse_args::<LitStr>() else {
        cx.error(&attribute.meta, &message::not_a_string());
        return Declaration::Unreadable;
    };
    match grammar::parse(&text.value()) {
        Ok(unit) => Declaration::Unit(unit, text.value().trim().to_owned()),
        Err(message) => {
            cx.error(&text, &message);
            Declaration::Unreadable
        }
    }
}
