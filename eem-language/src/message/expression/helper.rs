//! Messages about helpers: `let f = |x| …;`.

use proc_macro2::Ident;

use crate::ast;
use crate::message::Message;

const FORM: &str = "write `let name = |x, y| …;`";

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
        format!("`{name}` calls itself"),
        "a helper can only call helpers that are defined before it; write a recursion out",
    )
}

/// The call expands to more than `calls` calls, or to one that is nested too deeply.
pub(crate) fn too_many_calls(helper: &Ident, calls: usize) -> Message {
    let name = ast::name(helper);
    Message::new(
        format!(
            "this call of `{name}` expands to more than {calls} nested calls, or to calls nested too deeply"
        ),
        "bind what several calls have in common with `let`",
    )
}
