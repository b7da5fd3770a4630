//! Messages about Rust syntax that a free energy does not have.

use crate::message::Message;

const SMOOTH: &str = "a free energy must be one smooth expression; for a transition use a smooth function such as `tanh`";

pub(crate) fn caret() -> Message {
    Message::new(
        "`^` is not a power in Rust",
        "write `x.powi(2)` or `x.powf(y)`",
    )
}

pub(crate) fn remainder() -> Message {
    Message::new(
        "`%` has jumps and so no derivative",
        "use `sin` or `cos` for something periodic",
    )
}

pub(crate) fn comparison(operator: &str) -> Message {
    Message::new(
        format!("`{operator}` compares, and nothing follows from it"),
        SMOOTH,
    )
}

pub(crate) fn bit_operator(operator: &str) -> Message {
    Message::new(
        format!("`{operator}` works on bits"),
        "the operators are `+`, `-`, `*` and `/`",
    )
}

pub(crate) fn assignment(operator: &str) -> Message {
    Message::new(
        format!("`{operator}` changes a value, and values do not change in a formula"),
        "bind another name: `let y = x + …;`",
    )
}

pub(crate) fn not_operator() -> Message {
    Message::new("`!` works on bits", "for a negative write `-x`")
}

pub(crate) fn dereference() -> Message {
    Message::new(
        "`*` needs a factor on its left",
        "for a power write `x.powi(2)`; there are no references to follow",
    )
}

pub(crate) fn reference() -> Message {
    Message::new("there are no references in a free energy", "remove `&`")
}

pub(crate) fn control_flow(keyword: &str) -> Message {
    Message::new(format!("`{keyword}` is not part of a formula"), SMOOTH)
}

pub(crate) fn repetition(keyword: &str) -> Message {
    Message::new(
        format!("`{keyword}` is not part of a formula"),
        "write the terms out",
    )
}

pub(crate) fn jump(keyword: &str) -> Message {
    Message::new(
        format!("`{keyword}` is not part of a formula"),
        "the value of a block is its last expression, without `;`",
    )
}

pub(crate) fn cast() -> Message {
    Message::new(
        "`as` is not needed: all numbers are real",
        "remove `as …`; `1 / 2` is one half",
    )
}

pub(crate) fn closure() -> Message {
    Message::new(
        "a closure is not a value",
        "give it a name, `let f = |x| …;`, and call it; a derivative is `diff(expression, argument)`",
    )
}

pub(crate) fn index_of_value() -> Message {
    Message::new(
        "this has no entries",
        "a field can be an array, `stiffness: [f64; 3]`, with the entries `stiffness[0]` to `stiffness[2]`",
    )
}

pub(crate) fn index_is_not_a_literal() -> Message {
    Message::new(
        "the index of an entry is a number that is written out, such as `2`",
        "every entry is a parameter of its own; a sum over entries is written out",
    )
}

pub(crate) fn aggregate(what: &str) -> Message {
    Message::new(
        format!("{what} is not a number"),
        "bind each number with its own `let`",
    )
}

pub(crate) fn invocation() -> Message {
    Message::new(
        "a macro cannot be expanded inside a free energy",
        "write its result",
    )
}

pub(crate) fn waiting() -> Message {
    Message::new("`.await` is not part of a formula", "remove `.await`")
}

pub(crate) fn range() -> Message {
    Message::new(
        "a range is not a number",
        "one `.` is a decimal point; a sum over a range is written out",
    )
}

pub(crate) fn placeholder() -> Message {
    Message::new("`_` has no value", "write the expression that belongs here")
}

pub(crate) fn mutable() -> Message {
    Message::new("values do not change in a formula", "remove `mut`")
}

pub(crate) fn question_mark() -> Message {
    Message::new("`?` is not part of a formula", "remove `?`")
}

pub(crate) fn field_access(name: Option<&str>) -> Message {
    let help = match name {
        Some(name) => format!("fields are used by bare name: write `{name}`"),
        None => "a parameter is a field of its own, used by bare name; a method has parentheses, `x.sqrt()`".to_owned(),
    };
    Message::new("a field access is not part of a formula", help)
}

pub(crate) fn path(path: &str, last: &str) -> Message {
    Message::new(
        format!("`{path}` is outside of the free energy"),
        format!(
            "names of fields and functions are bare: write `{last}`; a path leads to a constant, whose name is in upper case"
        ),
    )
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
        format!("the constant is `{constant}`; a parameter is a field, `{name}: f64`"),
    )
}

pub(crate) fn generic_arguments() -> Message {
    Message::new(
        "functions of a free energy have no type arguments",
        "remove `::<…>`",
    )
}

pub(crate) fn callee() -> Message {
    Message::new(
        "this is not the name of a function",
        "for a product write `*`",
    )
}

pub(crate) fn literal(what: &str) -> Message {
    Message::new(
        format!("{what} is not a number"),
        "numbers are written `2`, `2.0` or `1e-3`",
    )
}

pub(crate) fn attribute() -> Message {
    Message::new(
        "an attribute inside a free energy would be ignored",
        "remove it; to choose between two energies put `#[cfg_attr(…, free_energy(…))]` on the struct",
    )
}

pub(crate) fn label_or_modifier() -> Message {
    Message::new("this is not a plain block", "write `{ let …; value }`")
}

pub(crate) fn unsupported() -> Message {
    Message::new(
        "this is not an arithmetic expression",
        "use `+`, `-`, `*`, `/`, functions and `let`",
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
        "a `;` after the value of a block throws it away",
        "remove `;`",
    )
}

pub(crate) fn let_without_block() -> Message {
    Message::new(
        "a `let` needs a block around it",
        "write `{ let name = value; … }`",
    )
}

pub(crate) fn statement_without_effect() -> Message {
    Message::new(
        "the value of this expression is not used",
        "bind it with `let`, or add it to the result",
    )
}

pub(crate) fn item_in_block() -> Message {
    Message::new(
        "an item is not part of a formula",
        "use `let` for an intermediate value and a field for a parameter",
    )
}

pub(crate) fn let_pattern() -> Message {
    Message::new(
        "this pattern is not a plain name",
        "write `let name = value;`",
    )
}

pub(crate) fn let_type() -> Message {
    Message::new(
        "a `let` in a formula has no type",
        "write `let name = value;`",
    )
}

pub(crate) fn let_without_value() -> Message {
    Message::new("this `let` has no value", "write `let name = value;`")
}

pub(crate) fn let_else() -> Message {
    Message::new("a formula has no other way out", "remove `else { … }`")
}
