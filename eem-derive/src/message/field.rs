//! Messages about fields.

use proc_macro2::Ident;

use super::Message;
use crate::ast;

pub(crate) fn not_a_parameter(field: &Ident) -> Message {
    let name = ast::name(field);
    Message::new(
        format!("the free energy uses `{name}`, but a field of this type cannot be a parameter"),
        "parameters are `f64`, `f32` or a type parameter of the struct",
    )
}

pub(crate) fn second_scalar(parameter: &Ident, first: &Ident) -> Message {
    Message::new(
        format!(
            "the free energy uses fields of type `{first}` and of type `{parameter}`, but a model has one scalar"
        ),
        format!("write `{first}` here, or `f64` for a parameter that is an ordinary number"),
    )
}

pub(crate) fn attribute_on_field(attribute: &str) -> Message {
    Message::new(
        format!("`#[{attribute}]` is not expected on a field"),
        format!("`#[{attribute}(…)]` belongs on top of the struct"),
    )
}
