//! Messages about Rust syntax that a formula does not have.

use crate::message::{Message, Said, said};

const SMOOTH: &str =
    "use one smooth expression; for a transition, a smooth function such as `tanh`";
const CONSTANT: &str = "values do not change: bind another name, `let y = x + …;`";
const NUMBER: &str = "numbers are written `2`, `2.0` or `1e-3`";
const BLOCK: &str = "write a plain block, `{ let …; value }`";
const UNTYPED: &str = "remove it: all values are numbers of one kind";
const OPERATORS: &str = "use `+`, `-`, `*`, `/`, functions and `let`";
const EACH: &str = "bind each number with its own `let`";
const REMOVE: &str = "remove it";

/// Syntax that formulas do not have, and what to write instead. Names with an article are printed as they are; all others
/// are tokens, which are quoted.
const TABLE: &[(&[&str], &str)] = &[
    (
        &["if", "match", "==", "!=", "<", "<=", ">", ">=", "&&", "||"],
        SMOOTH,
    ),
    (&["for", "while", "loop"], "write the terms out"),
    (
        &["return", "break", "continue"],
        "the value of a block is its last expression, without `;`",
    ),
    (
        &["%"],
        "it jumps; for something periodic use `sin` or `cos`",
    ),
    (
        &["&", "|", "<<", ">>"],
        "the operators are `+`, `-`, `*` and `/`",
    ),
    (
        &[
            "=", "+=", "-=", "*=", "/=", "%=", "^=", "&=", "|=", "<<=", ">>=",
        ],
        CONSTANT,
    ),
    (&["mut"], "remove it: values do not change"),
    (&["!"], "for a negative write `-x`"),
    (
        &["a `*` without a left factor"],
        "for a power write `x.powi(2)`; otherwise remove `*`",
    ),
    (&["a reference"], "remove `&`"),
    (
        &["as"],
        "remove `as …`: all numbers are real, `1 / 2` is one half",
    ),
    (&["a type"], UNTYPED),
    (&["a return type"], "remove `-> …`"),
    (&["a type argument"], "remove `::<…>`"),
    (&["an array", "a tuple", "a struct"], EACH),
    (&["a truth value", "a character", "a string"], NUMBER),
    (
        &["a path with `<…>`"],
        "a constant has a plain path, `crate::gas::R`; all else has a bare name",
    ),
    (
        &["a range"],
        "one `.` is a decimal point; a sum over a range is written out",
    ),
    (&["a macro"], "write its result"),
    (&["_"], "write the expression that belongs here"),
    (&["?", ".await", "async", "const", "move", "for<…>"], REMOVE),
    (
        &[
            "an `async` block",
            "a `const` block",
            "a `try` block",
            "an `unsafe` block",
            "a label",
        ],
        BLOCK,
    ),
    (
        &["an unnamed closure"],
        "give it a name, `let f = |x| …;`, and call it; a derivative is `diff(expression, argument)`",
    ),
    (
        &["a `let` without a block"],
        "write `{ let name = value; … }`",
    ),
    (&["let … else"], "remove `else { … }`"),
    (
        &["an item"],
        "use `let` for an intermediate value and a field for a parameter",
    ),
    (
        &["an attribute"],
        "remove it; to choose between two energies put `#[cfg_attr(…, free_energy(…))]` on the struct",
    ),
];

/// What to write in a text, where this differs from the table.
const IN_TEXT: [(&str, &str); 3] = [
    ("a path with `<…>`", "write a bare name"),
    (
        "an item",
        "use `let` for an intermediate value and declare parameters",
    ),
    ("an attribute", REMOVE),
];

/// Rust syntax that is no formula, by a name from the table.
pub(crate) fn not_allowed(what: &str) -> Message {
    let row = TABLE.iter().find(|(names, _)| names.contains(&what));
    #[cfg(test)]
    assert!(row.is_some(), "`{what}` is not in the table");
    let help = row.map_or(OPERATORS, |(_, help)| help);
    let in_text = IN_TEXT.iter().find(|&&(name, _)| name == what);
    let in_text = in_text.map_or(help, |&(_, help)| help);
    Message::new(text(what), said(|d| d.choose(help, in_text).to_owned()))
}

fn text(what: &str) -> String {
    let said = ["a ", "an ", "this "]
        .iter()
        .any(|article| what.starts_with(article));
    if said {
        format!("{what} is not allowed in a formula")
    } else {
        format!("`{what}` is not allowed in a formula")
    }
}

/// What the rows of the table can say, for the test that each has a case.
#[cfg(test)]
pub(crate) fn rows() -> impl Iterator<Item = Vec<String>> {
    let texts = |names: &[&str]| names.iter().map(|what| text(what)).collect();
    TABLE.iter().map(move |(names, _)| texts(names))
}

/// An expression of any other kind.
pub(crate) fn unsupported() -> Message {
    Message::new(text("this expression"), OPERATORS)
}

pub(crate) fn caret() -> Message {
    Message::new(
        said(|d| format!("`^` is not a power{}", d.choose(" in Rust", ""))),
        "write `x.powi(2)` or `x.powf(y)`",
    )
}

pub(crate) fn index_of_value() -> Message {
    Message::new(
        "this expression cannot be indexed",
        said(|d| {
            let (field, array) = (d.a_field(), d.array("stiffness"));
            format!(
                "{field} can be an array, {array}, with the entries `stiffness[0]` to `stiffness[2]`"
            )
        }),
    )
}

pub(crate) fn index_is_not_a_literal() -> Message {
    Message::new(
        "an index must be a number that is written out, such as `2`",
        "every entry is a parameter of its own; write a sum over entries out",
    )
}

pub(crate) fn field_access(name: Option<&str>) -> Message {
    let help: Said = match name {
        Some(name) => said(|d| format!("{}s are used by bare name: write `{name}`", d.field())),
        None => said(|d| {
            let own = d.choose("a field of its own, used", "used");
            format!("a parameter is {own} by bare name; a method has parentheses, `x.sqrt()`")
        }),
    };
    Message::new("a field access is not allowed in a formula", help)
}

pub(crate) fn path(path: &str, last: &str) -> Message {
    Message::new(
        format!("`{path}` is not a constant: constants have names in upper case"),
        said(|d| {
            let field = d.a_field();
            format!("for {field}, an argument or a function write the bare name, `{last}`")
        }),
    )
}

/// A path into the constants of the standard library that leads to none.
pub(crate) fn constant_of_std(path: &str, nearest: Option<&str>) -> Message {
    let help = match nearest {
        Some(nearest) => format!("did you mean `{nearest}`?"),
        None => "`PI` is known by its bare name, others by paths such as `core::f64::consts::TAU`"
            .to_owned(),
    };
    Message::new(format!("unknown constant `{path}`"), help)
}

/// What is written for constants that have short names on paper.
pub(crate) fn constant_of_paper(name: &str) -> Option<&'static str> {
    Some(match name {
        "pi" | "π" => "PI",
        "tau" | "τ" => "core::f64::consts::TAU",
        "e" => "core::f64::consts::E",
        _ => return None,
    })
}

pub(crate) fn constant(name: &str, constant: &str) -> Message {
    Message::new(
        format!("unknown name `{name}`"),
        said(|d| format!("the constant is `{constant}`; {}", d.declaration(name))),
    )
}

pub(crate) fn callee() -> Message {
    Message::new(
        "this is not the name of a function",
        "for a product write `*`",
    )
}

pub(crate) fn block_without_value() -> Message {
    Message::new(
        "this block ends without a value",
        "end it with an expression that has no `;`",
    )
}

pub(crate) fn semicolon_after_value() -> Message {
    Message::new(
        "a `;` after the last expression discards the value of the block",
        "remove `;`",
    )
}

pub(crate) fn statement_without_effect() -> Message {
    Message::new(
        "the value of this expression is not used",
        "bind it with `let`, or add it to the result",
    )
}

pub(crate) fn let_pattern() -> Message {
    Message::new(
        "this pattern is not a plain name",
        "write `let name = value;`",
    )
}

pub(crate) fn let_without_value() -> Message {
    Message::new("this `let` has no value", "write `let name = value;`")
}
