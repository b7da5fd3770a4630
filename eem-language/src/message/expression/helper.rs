//! Messages about helpers: `let f = |x| …;`.

use proc_macro2::Ident;

use crate::ast;
use crate::message::Message;

const FORM: &str = "write `let name = |x, y| …;`";

pub(crate) fn modifier(modifier: &str) -> Message {
    Message::new(
        format!("a helper is not `{modifier}`"),
        format!("remove `{modifier}`"),
    )
}

pub(crate) fn types() -> Message {
    Message::new(
        "a helper has no types: all values are numbers of one kind",
        FORM,
    )
}

pub(crate) fn pattern() -> Message {
    Message::new("this argument of a helper is not a plain name", FORM)
}

pub(crate) fn without_arguments() -> Message {
    Message::new(
        "a helper without arguments is a value",
        "write `let name = …;`, and the name without parentheses",
    )
}

pub(crate) fn calls_itself(helper: &Ident) -> Message {
    let name = ast::name(helper);
    Message::new(
        format!("`{name}` calls itself, and a formula with it would never end"),
        "a helper can call those before it; write a sum or a product out",
    )
}

pub(crate) fn too_many_calls(helper: &Ident) -> Message {
    let name = ast::name(helper);
    Message::new(
        format!("with this call of `{name}` the calls inside of one another are too many"),
        "bind what is the same in several calls with `let`",
    )
}
