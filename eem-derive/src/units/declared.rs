//! The units of what a formula names: fields by their `#[unit("…")]`, arguments by their role.

use syn::{Attribute, Data, DeriveInput, LitStr};

use super::grammar;
use crate::ctxt::Ctxt;
use crate::message::unit as message;
use crate::unit::Unit;

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

/// The units of the fields.
#[derive(Debug, Default)]
pub(crate) struct Units {
    declarations: Vec<Declaration>,
}

impl Units {
    /// The declarations of all named fields, in their order.
    pub(super) fn read(cx: &Ctxt, input: &DeriveInput) -> Self {
        for attribute in input.attrs.iter().filter(|a| a.path().is_ident(ATTRIBUTE)) {
            cx.error(attribute.path(), &message::not_on_a_field());
        }
        let Data::Struct(data) = &input.data else {
            return Self::default();
        };
        let fields = data.fields.iter();
        let declarations = fields.map(|field| declaration(cx, &field.attrs));
        Self {
            declarations: declarations.collect(),
        }
    }

    /// What is said about the unit of a field.
    pub(super) fn declaration(&self, index: usize) -> Option<&Declaration> {
        self.declarations.get(index)
    }

    /// The unit of a field as it was written, by the index of the field in the struct.
    pub(crate) fn of_field(&self, index: usize) -> Option<&str> {
        match self.declarations.get(index)? {
            Declaration::Unit(_, text) => Some(text),
            Declaration::Missing | Declaration::Unreadable => None,
        }
    }

    /// Whether a field says anything about its unit.
    pub(super) fn is_declared(&self, index: usize) -> bool {
        let declaration = self.declarations.get(index);
        declaration.is_some_and(|declaration| !matches!(declaration, Declaration::Missing))
    }
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
