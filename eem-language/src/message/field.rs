//! Messages about fields.

use proc_macro2::Ident;

use super::{Message, said};
use crate::ast;

pub(crate) fn not_a_parameter(field: &Ident) -> Message {
    let name = ast::name(field);
    Message::new(
        format!("the free energy uses `{name}`, but a field of this type cannot be a parameter"),
        "parameters are `f64`, `f32` or a type parameter of the struct, under these names, or arrays of them: an alias is not seen through",
    )
}

pub(crate) fn array_without_length(field: &Ident) -> Message {
    let name = ast::name(field);
    Message::new(
        format!(
            "the free energy uses `{name}`, but the length of this array is not a number that is written out"
        ),
        "every entry is a parameter: write the length as in `[f64; 3]`",
    )
}

pub(crate) fn array_without_index(field: &Ident) -> Message {
    let name = ast::name(field);
    Message::new(
        format!("`{name}` is an array of parameters"),
        format!("name one of them: `{name}[0]`"),
    )
}

pub(crate) fn index_of_number(name: &Ident, what: &str) -> Message {
    let name = ast::name(name);
    Message::new(
        format!("`{name}` is {what} and has no entries"),
        said(|d| {
            let (field, array) = (d.field(), d.choose("[f64; 3]", "stiffness[3]"));
            format!("write `{name}` without an index; a {field} can be an array, `{array}`")
        }),
    )
}

pub(crate) fn index_out_of_range(field: &Ident, index: usize, length: usize) -> Message {
    let name = ast::name(field);
    let help = match length.checked_sub(1) {
        Some(last) => format!("its entries are `{name}[0]` to `{name}[{last}]`"),
        None => "it has no entries".to_owned(),
    };
    Message::new(format!("`{name}` has no entry {index}"), help)
}

pub(crate) fn second_scalar(parameter: &Ident, first: &Ident) -> Message {
    Message::new(
        format!(
            "the free energy uses fields of type `{first}` and of type `{parameter}`, but a model has one scalar"
        ),
        format!("write `{first}` here, or `f64` for a parameter that is an ordinary number"),
    )
}

/// `name` is a field or an entry of one.
pub(crate) fn unused(name: &str) -> Message {
    Message::new(
        format!("neither the free energy nor a viscosity uses `{name}`"),
        said(|d| {
            let (field, unused) = (d.field(), d.unused(name));
            format!("add the term that is missing, remove the {field}, or {unused}")
        }),
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
