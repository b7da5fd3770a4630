//! The struct and its fields.

use syn::{Data, DeriveInput, Fields};

use crate::ast::Field;
use crate::ctxt::Ctxt;
use crate::message::{field, item};

/// The named fields of the struct; reports every other kind of item.
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
        Fields::Named(fields) => Some(
            fields
                .named
                .iter()
                .inspect(|field| check_attributes(cx, field))
                .filter_map(|field| {
                    let ident = field.ident.as_ref()?;
                    Some(Field {
                        ident,
                        ty: &field.ty,
                    })
                })
                .collect(),
        ),
        Fields::Unnamed(fields) => {
            cx.error_at(fields.paren_token.span.join(), &item::tuple_struct());
            None
        }
        Fields::Unit => {
            cx.error(&input.ident, &item::unit_struct());
            None
        }
    }
}

/// `#[viscosity]` on a field would otherwise be ignored: the compiler accepts it there.
fn check_attributes(cx: &Ctxt, field: &syn::Field) {
    for attribute in &field.attrs {
        for name in ["free_energy", "viscosity"] {
            if attribute.path().is_ident(name) {
                cx.error(attribute.path(), &field::attribute_on_field(name));
            }
        }
    }
}
