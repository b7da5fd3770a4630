//! The units of the names in a formula: fields by their `#[unit("…")]`, constants by one on the struct,
//! arguments by their role.

use syn::{Attribute, Data, DeriveInput, LitStr};

use super::constants::{self, Annotation};
use super::declaration::{ATTRIBUTE, Declaration, unit_of};
use crate::checked::{Checked, Origin};
use crate::ctxt::Ctxt;
use crate::message::unit as message;

/// The units of the fields and of the constants.
#[derive(Debug, Default)]
pub(crate) struct Units {
    fields: Vec<Declaration>,
    constants: Vec<Annotation>,
    /// Whether some parameter has a unit, so that the formulas are checked.
    some: bool,
}

impl Units {
    /// The declarations of all named fields, in their order, and of the constants of the formulas.
    pub(super) fn read(cx: &Ctxt, checked: &Checked<'_>) -> Self {
        let mut units = Self {
            fields: fields(cx, checked.original),
            constants: constants::read(cx, checked),
            some: false,
        };
        let mut used = checked.parameters.iter();
        units.some = used.any(|parameter| units.is_declared(parameter.origin));
        units
    }

    /// Whether some parameter has a unit.
    pub(super) fn are_checked(&self) -> bool {
        self.some
    }

    /// The declaration of the unit of a parameter.
    pub(super) fn declaration(&self, origin: Origin) -> Option<&Declaration> {
        match origin {
            Origin::Field(field) | Origin::Entry(field, _) => self.fields.get(field),
            Origin::Constant(index) => {
                let mut annotations = self.constants.iter();
                let annotation = annotations.find(|annotation| annotation.constant == index);
                annotation.map(|annotation| &annotation.declaration)
            }
        }
    }

    /// The unit of a parameter as it was written; a constant without one is dimensionless, if units are
    /// checked at all.
    pub(crate) fn of(&self, origin: Origin) -> Option<&str> {
        match (self.declaration(origin), origin) {
            (Some(Declaration::Unit(_, text)), _) => Some(text),
            (None, Origin::Constant(_)) => self.some.then_some("1"),
            _ => None,
        }
    }

    /// Whether the unit of a parameter is declared.
    fn is_declared(&self, origin: Origin) -> bool {
        let declaration = self.declaration(origin);
        declaration.is_some_and(|declaration| !matches!(declaration, Declaration::Missing))
    }

    /// Whether a field should have a unit and has none.
    pub(super) fn is_missing(&self, origin: Origin) -> bool {
        matches!(self.declaration(origin), Some(Declaration::Missing))
    }
}

fn fields(cx: &Ctxt, input: &DeriveInput) -> Vec<Declaration> {
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
    unit_of(cx, &text)
}
