//! The struct and its fields.

use syn::{Attribute, Data, DeriveInput, Fields, Ident, Meta};

use crate::ast::Field;
use crate::ctxt::Ctxt;
use crate::message::{field, item};

/// The named fields of the struct; reports every item that cannot have any. A struct without
/// fields is a material without parameters, with braces or without.
pub(super) fn fields<'a>(cx: &Ctxt, input: &'a DeriveInput) -> Option<Vec<Field<'a>>> {
    let data = match &input.data {
        Data::Struct(data) => data,
        Data::Enum(data) => {
            cx.error(data.enum_token, &item::enumeration());
            return None;
        }
        Data::Union(data) => {
            cx.error(data.union_token, &item::union());
            return None;
        }
    };
    match &data.fields {
        Fields::Named(fields) => {
            let named = fields.named.iter();
            let named = named.filter_map(|field| {
                let mut read = Field {
                    ident: field.ident.as_ref()?,
                    ty: &field.ty,
                    unused: false,
                    wrong: false,
                };
                read_marks(cx, &field.attrs, &mut read);
                Some(read)
            });
            Some(named.collect())
        }
        Fields::Unnamed(fields) => {
            cx.error_at(fields.paren_token.span.join(), &item::tuple_struct());
            None
        }
        Fields::Unit => Some(Vec::new()),
    }
}

/// Reads `#[free_energy(unused)]`. Reports other `free_energy` and `viscosity` attributes of fields, which
/// the compiler would accept and nothing would read.
fn read_marks(cx: &Ctxt, attributes: &[Attribute], field: &mut Field<'_>) {
    for attribute in attributes {
        let path = attribute.path();
        if path.is_ident("free_energy") && is_unused(attribute) {
            field.unused = true;
        } else if path.is_ident("free_energy") {
            field.wrong = true;
            cx.error(path, &field::free_energy());
        } else if path.is_ident("viscosity") {
            field.wrong = true;
            cx.error(path, &field::viscosity());
        }
    }
}

fn is_unused(attribute: &Attribute) -> bool {
    let word = match &attribute.meta {
        Meta::List(_) => attribute.parse_args::<Ident>(),
        Meta::Path(_) | Meta::NameValue(_) => return false,
    };
    word.is_ok_and(|word| word == "unused")
}
