//! Messages about expressions.

use proc_macro2::Ident;

use super::{Message, list, said};
use crate::ast::{self, Role};
use crate::dialect::Dialect;

pub(crate) mod digits;
pub(crate) mod helper;
pub(crate) mod rest;
pub(crate) mod syntax;

pub(crate) fn misspelt_name(name: &str, nearest: &str) -> Message {
    Message::new(
        format!("unknown name `{name}`"),
        format!("did you mean `{nearest}`?"),
    )
}

/// `role` is the usual role of the name.
pub(crate) fn missing_argument(name: &str, role: Role) -> Message {
    let role = role.name();
    Message::new(
        format!("unknown name `{name}`"),
        said(|d| {
            let field = d.field_named(name);
            format!("declare it as an argument, `{name}: {role}`, or as a {field}")
        }),
    )
}

pub(crate) fn unknown_name(name: &str) -> Message {
    Message::new(
        format!("unknown name `{name}`"),
        said(|d| {
            let (field, declaration) = (d.a_field(), d.declaration(name));
            format!("use an argument of the closure, {field} or an earlier `let`; {declaration}")
        }),
    )
}

/// `theta` is the name of the temperature, if the model has one.
pub(crate) fn unknown_name_in_law(name: &str, theta: Option<&str>) -> Message {
    let theta = theta.map_or_else(String::new, |name| format!("the temperature `{name}`, "));
    Message::new(
        format!("unknown name `{name}`"),
        said(|d| {
            let (field, declaration) = (d.field(), d.declaration(name));
            format!(
                "a viscosity law may use {theta}{field}s and its own `let` bindings; {declaration}"
            )
        }),
    )
}

/// `what` is the noun for what has the name, `instead` how to write it with a free name.
pub(crate) fn binding_hides(
    binding: &Ident,
    what: fn(Dialect) -> &'static str,
    instead: &str,
) -> Message {
    let name = ast::name(binding);
    Message::new(
        said(|d| format!("`{name}` is already the name of {}", what(d))),
        format!("choose another name: `{instead}`"),
    )
}

pub(crate) fn unused_binding(binding: &Ident) -> Message {
    let name = ast::name(binding);
    Message::new(
        format!("nothing uses `{name}`"),
        format!("use it, remove it, or call it `_{name}` to keep it"),
    )
}

pub(crate) fn unknown_function(name: &str, advice: String) -> Message {
    Message::new(format!("unknown function `{name}`"), advice)
}

/// What to write for a function that is known elsewhere, if there is a good answer.
fn function_advice(name: &str) -> Option<&'static str> {
    Some(match name {
        "log" => "the natural logarithm is `ln(x)`; there are `log2(x)` and `log10(x)` too",
        "lg" => "write `log10(x)`",
        "log1p" => "write `ln_1p(x)`",
        "expm1" => "write `exp_m1(x)`",
        "exp2" => "write `powf(2, x)`",
        "pow" | "power" => "write `powi(x, 2)` for an integer power and `powf(x, y)` for any other",
        "sq" | "sqr" | "square" => "write `powi(x, 2)`",
        "cube" => "write `powi(x, 3)`",
        "inv" | "reciprocal" => "write `recip(x)` or `1 / x`",
        "asin" | "arcsin" => "write `atan(x / sqrt(1 - x * x))`",
        "acos" | "arccos" => "write `2 * atan(sqrt((1 - x) / (1 + x)))`",
        "arctan" => "write `atan(x)`",
        "arsinh" | "arcsinh" => "write `asinh(x)`",
        "artanh" | "arctanh" => "write `atanh(x)`",
        "atan2" => "write `atan(y / x)` where `x` is positive",
        "acosh" | "arcosh" | "arccosh" => "write `ln(x + sqrt(x * x - 1))`",
        "sec" => "write `1 / cos(x)`",
        "csc" => "write `1 / sin(x)`",
        "cot" => "write `1 / tan(x)`",
        "sech" => "write `1 / cosh(x)`",
        "csch" => "write `1 / sinh(x)`",
        "coth" => "write `1 / tanh(x)`",
        "sin_cos" => "write `sin(x)` and `cos(x)`",
        "hypot" => "write `sqrt(x * x + y * y)`",
        "mul_add" => "write `a * b + c`",
        "d" | "D" | "grad" | "gradient" | "derivative" | "partial" | "derive" => {
            "a derivative is `diff(expression, lambda)`"
        }
        "from" | "into" | "clone" | "to_owned" => "remove it: all values are numbers of one kind",
        "sum" | "map" | "fold" | "iter" => "write the terms out",
        "min" | "max" | "clamp" | "sign" | "sgn" | "signum" | "copysign" | "heaviside" | "step"
        | "floor" | "ceil" | "round" | "trunc" | "fract" | "rem_euclid" => {
            "it has no derivative at its kinks, and forces are derivatives: use a smooth function such as `tanh`"
        }
        _ => return None,
    })
}

/// What to write for a function that is known nowhere.
pub(crate) fn function_help<'n>(
    name: &str,
    nearest: Option<&str>,
    functions: impl IntoIterator<Item = &'n str>,
) -> String {
    match (function_advice(name), nearest) {
        (Some(advice), _) => advice.to_owned(),
        (None, Some(nearest)) => format!("did you mean `{nearest}`?"),
        (None, None) => format!("the functions are {}", list(functions)),
    }
}

pub(crate) fn argument_count(function: &str, form: &str, expected: usize, found: usize) -> Message {
    let plural = if expected == 1 { "" } else { "s" };
    Message::new(
        format!("`{function}` takes {expected} argument{plural}, not {found}"),
        format!("write `{form}`"),
    )
}

pub(crate) fn name_is_a_function(name: &str) -> Message {
    Message::new(
        format!("the function `{name}` is used without an argument"),
        format!("write `{name}(…)`"),
    )
}

pub(crate) fn name_is_not_a_function(name: &str) -> Message {
    Message::new(
        format!("`{name}` is a number, not a function"),
        format!("for a product write `{name} * (…)`"),
    )
}

pub(crate) fn exponent_is_not_an_integer() -> Message {
    Message::new(
        "the exponent of `powi` must be an integer known at compile time",
        "write `powf(x, y)` for any other exponent",
    )
}

pub(crate) fn exponent_is_too_large() -> Message {
    Message::new(
        "the exponent of `powi` does not fit an `i32`",
        "write `powf(x, y)`",
    )
}

pub(crate) fn diff_variable_is_not_a_name() -> Message {
    Message::new(
        "the second argument of `diff` is not the name of an argument of the free energy",
        "write `diff(expression, lambda)`",
    )
}

pub(crate) fn diff_variable<'n>(
    name: &Ident,
    kind: &str,
    arguments: impl IntoIterator<Item = &'n str>,
) -> Message {
    let name = ast::name(name);
    Message::new(
        format!(
            "`diff` differentiates with respect to an argument of the free energy, but `{name}` is a {kind}"
        ),
        format!("the arguments are {}", list(arguments)),
    )
}

pub(crate) fn abs_of_state(argument: &str) -> Message {
    Message::new(
        format!("`abs` has no derivative at zero, and its argument depends on `{argument}`"),
        "write `sqrt(x * x + c * c)` with a small parameter `c`, or `x.powi(2)`",
    )
}

pub(crate) fn root_of_square(argument: &str) -> Message {
    Message::new(
        format!(
            "the root of a square is an absolute value, which has no derivative at zero, and this one depends on `{argument}`"
        ),
        "write the square without the root, or add a small constant under it: `sqrt(x * x + c * c)`",
    )
}

pub(crate) fn diff_of_number() -> Message {
    Message::new(
        "this expression depends on no argument of the free energy: its derivative is zero",
        "differentiate an expression of the arguments, such as a part of the energy",
    )
}

pub(crate) fn law_of_state(name: &Ident, role: Role) -> Message {
    let name = ast::name(name);
    Message::new(
        said(|d| {
            let (field, role) = (d.field(), role.name());
            format!(
                "a viscosity may depend on the temperature and the {field}s, but `{name}` is a `{role}`"
            )
        }),
        format!("remove `{name}` from the law"),
    )
}

pub(crate) fn law_of_binding(name: &Ident) -> Message {
    let name = ast::name(name);
    Message::new(
        format!("`{name}` is a `let` of the free energy, which a viscosity cannot use"),
        "repeat it: a law may be a block, `gamma = { let x = …; … }`",
    )
}

pub(crate) fn number_out_of_range() -> Message {
    Message::new(
        "this number does not fit an `f64`",
        "an `f64` reaches from about `2.3e-308` to `1.8e308`; choose other units",
    )
}

pub(crate) fn constant_too_large() -> Message {
    Message::new(
        "this constant does not fit an `f64`",
        "an `f64` reaches to about `1.8e308`; choose other units",
    )
}

pub(crate) fn outside_domain(function: &str, what: &str, domain: &str) -> Message {
    Message::new(
        format!("`{function}` has no value here: its argument is {what}"),
        format!("`{function}(x)` is defined for `{domain}`"),
    )
}

pub(crate) fn negative_base() -> Message {
    Message::new(
        "`powf` has no value here: its base is negative",
        "`powf(x, y)` is defined for `x > 0`; an integer power is `powi(x, n)`",
    )
}

/// `base` is as quoted. `exponent` is given if it is a constant; `smooth` says that the power of x² has two derivatives.
pub(crate) fn base_can_be_negative(base: &str, exponent: Option<f64>, smooth: bool) -> Message {
    // An exponent of many digits, such as 5/3, is shown as `y`.
    let short = exponent.filter(|y| (1000.0 * y).fract() == 0.0);
    let (y, half) = short.map_or_else(
        || ("y".to_owned(), "y / 2".to_owned()),
        |y| (y.to_string(), (0.5 * y).to_string()),
    );
    let narrow = format!("`exp({y} * ln(x))` if `x` is positive in every state");
    let help = match exponent {
        // |x|^y has a kink or a pole at zero.
        Some(y) if y <= 1.0 => format!("write {narrow}"),
        _ if !smooth => format!(
            "for a power of `|x|` write `(x.powi(2) + c.powi(2)).powf({half})` with a small parameter `c`; for an integer power `x.powi(n)`"
        ),
        _ => format!(
            "for a power of `|x|` write `x.powi(2).powf({half})`; for an integer power `x.powi(n)`; or {narrow}"
        ),
    };
    Message::new(
        format!("`{base}` can be negative, where `x.powf({y})` has no value"),
        help,
    )
}

pub(crate) fn divisor_is_zero() -> Message {
    Message::new(
        "this divisor is always zero",
        "check the constants in it: they are computed exactly",
    )
}

pub(crate) fn number_suffix(suffix: &str) -> Message {
    Message::new(
        format!("the suffix `{suffix}` is not allowed in a formula"),
        "write the number without suffix: all numbers are exact",
    )
}

pub(crate) fn number_and_name(digits: &str, name: &str) -> Message {
    Message::new(
        format!("`{digits}{name}` is not a number"),
        format!("for a product write `{digits} * {name}`"),
    )
}
