//! Messages that only a text can get; `tests::text` has a case for each.

use super::Message;

pub(crate) fn too_long(bytes: usize, most: usize) -> Message {
    Message::new(
        format!("this text has {bytes} bytes, and may have {most} at most"),
        "shorten it; a formula can bind what is repeated with `let`",
    )
}

/// `bracket` has no counterpart.
pub(crate) fn single_bracket(bracket: char) -> Message {
    let what = if "([{".contains(bracket) {
        format!("this `{bracket}` is not closed")
    } else {
        format!("nothing fits this `{bracket}`")
    };
    Message::new(what, "every `(`, `[` and `{` has its counterpart")
}

/// No token begins with `character`.
pub(crate) fn unexpected_character(character: char) -> Message {
    let help = match character {
        '·' | '⋅' | '×' | '∙' => "write `*`",
        '÷' | '∕' => "write `/`",
        '−' | '–' | '—' => "write `-`",
        '²' => "write `x.powi(2)`",
        '³' => "write `x.powi(3)`",
        '√' => "write `sqrt(x)`",
        '∂' => "write `diff(expression, lambda)`",
        '"' | '\'' => "there are no strings in a formula",
        '/' => "the comment is not closed: write `*/`",
        _ => "remove it: there are names, numbers, `+`, `-`, `*`, `/` and parentheses",
    };
    Message::new(format!("cannot read `{character}` in a formula"), help)
}

pub(crate) fn not_a_name(text: &str) -> Message {
    Message::new(
        format!("`{text}` is not a name"),
        "a name has letters, digits and `_`, begins with no digit and is no keyword of Rust; an array of three parameters is `k[3]`",
    )
}

pub(crate) fn second_parameter(name: &str) -> Message {
    Message::new(
        format!("a second parameter `{name}`"),
        "every parameter is declared once; remove one of them",
    )
}

/// `name` is that of the law behind a comma.
pub(crate) fn second_law(name: &str) -> Message {
    Message::new(
        format!("a law for `{name}` in the text of another"),
        "give every law a text of its own; the decimal point is `.`, not `,`",
    )
}

/// `last` is the name at the end of the path.
pub(crate) fn constant_of_program(path: &str, last: &str) -> Message {
    Message::new(
        format!("`{path}` is a constant of a program, and a text belongs to none"),
        format!("write it as a parameter, `{last}`"),
    )
}
