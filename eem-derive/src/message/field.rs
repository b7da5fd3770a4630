//! Messages about fields.

use proc_macro2::Ident;

use super::Message;
use crate::ast;

pub(crate) fn not_a_parameter(field: &Ident) -> Message {
    let name = ast::name(field);
    Message::new(
        format!("the free energy uses `{name}`, but a field of this type cannot be a parameter"),
        "parameters are `f64`, `f32` or a type parameter of the struct, under these names: an alias is not seen through",
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

pub(crate) fn unused(field: &Ident) -> Message {
    let name = ast::name(field);
    Message::new(
        format!("neither the free energy nor a viscosity uses `{name}`"),
        "add the term that is missing, remove the field, or mark it: `#[free_energy(unused)]`",
    )
}

pub(crate) fn unused_and_used(field: &Ident) -> Message {
    let name = ast::name(field);
    Message::new(
        format!("the field `{name}` is marked as unused"),
        "to use it as a parameter, remove `#[free_energy(unused)]`",
    )
}

pub(crate) fn free_energy() -> Message {
    Message::new(
        "a field has no free energy",
        "the closure belongs on top of the struct; a field can be marked with `#[free_energy(unused)]`",
    )
}

pub(crate) fn viscosity() -> Message {
    Message::new(
        "a field has no viscosity",
        "`#[viscosity(…)]` belongs on top of the struct",
    )
}
