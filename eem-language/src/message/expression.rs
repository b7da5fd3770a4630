//! Messages about expressions.

use proc_macro2::Ident;

use super::{Message, list};
use crate::ast::{self, Role};

pub(crate) mod digits;
pub(crate) mod helper;
pub(crate) mod rest;
pub(crate) mod syntax;

/// `role` is what the literature means by the name.
pub(crate) fn unknown_name(name: &Ident, nearest: Option<&str>, role: Option<Role>) -> Message {
    let name = ast::name(name);
    let help = match (nearest, role) {
        (Some(nearest), _) => format!("did you mean `{nearest}`?"),
        (None, Some(role)) => format!(
            "declare it as an argument, `{name}: {}`, or as a field, `{name}: f64`",
            role.name()
        ),
        (None, None) if name.len() > 1 && !name.contains(char::is_lowercase) => {
            "constants of the program are not seen: write the value, or make it a field".to_owned()
        }
        (None, None) => format!(
            "known are the arguments of the closure, the fields and earlier `let` bindings; a parameter is a field, `{name}: f64`"
        ),
    };
    Message::new(format!("unknown name `{name}`"), help)
}

/// `instead` is how to write it with a free name.
pub(crate) fn binding_hides(binding: &Ident, what: &str, instead: &str) -> Message {
    let name = ast::name(binding);
    Message::new(
        format!("`{name}` is the name of {what} already"),
        format!("a name means one thing in a formula: write `{instead}`"),
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
            "forces are derivatives of the free energy, and this one has none at its kinks: use a smooth function such as `tanh`"
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
        format!("`{name}` is a function without its argument"),
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
        "the exponent of `powi` is not an integer known at compile time",
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
            "`{name}` is a {kind}, and `diff` is with respect to an argument of the free energy"
        ),
        format!("the arguments are {}", list(arguments)),
    )
}

pub(crate) fn abs_of_state(argument: &str) -> Message {
    Message::new(
        format!("`abs` of something that depends on `{argument}` has no derivative at zero"),
        "write `sqrt(x * x + c * c)` with a small parameter `c`, or `x.powi(2)`",
    )
}

pub(crate) fn root_of_square(argument: &str) -> Message {
    Message::new(
        format!(
            "the root of a square is an absolute value, and it depends on `{argument}`: there is no derivative at zero"
        ),
        "write the square without the root, or add a small constant under it: `sqrt(x * x + c * c)`",
    )
}

pub(crate) fn diff_of_number() -> Message {
    Message::new(
        "this depends on no argument of the free energy, and its derivative is zero",
        "the first argument of `diff` is an expression of the state, such as a part of the energy",
    )
}

pub(crate) fn law_of_state(name: &Ident, role: Role) -> Message {
    let name = ast::name(name);
    Message::new(
        format!(
            "a viscosity depends on the temperature and the fields, and `{name}` is a `{}`",
            role.name()
        ),
        format!("remove `{name}` from the law"),
    )
}

pub(crate) fn law_of_binding(name: &Ident) -> Message {
    let name = ast::name(name);
    Message::new(
        format!("`{name}` is a `let` of the free energy, which a viscosity does not see"),
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

/// The exponent is given if it is a constant; `smooth` means that a power of the square is.
pub(crate) fn base_can_be_negative(argument: &str, exponent: Option<f64>, smooth: bool) -> Message {
    // An exponent of many digits, such as 5/3, is shown as `y`.
    let short = exponent.filter(|y| (1000.0 * y).fract() == 0.0);
    let (y, half) = short.map_or_else(
        || ("y".to_owned(), "y / 2".to_owned()),
        |y| (y.to_string(), (0.5 * y).to_string()),
    );
    let narrow = format!("`exp({y} * ln(x))` if no state comes to `x <= 0`");
    let help = match exponent {
        // |x|^y has a kink or a pole at zero.
        Some(y) if y <= 1.0 => format!("write {narrow}"),
        _ if !smooth => format!(
            "write `(x.powi(2) + c.powi(2)).powf({half})` with a small parameter `c` for the power of `|x|`, or `x.powi(n)` for an integer power"
        ),
        _ => format!(
            "write `x.powi(2).powf({half})` for the power of `|x|`, `x.powi(n)` for an integer power, or {narrow}"
        ),
    };
    Message::new(
        format!(
            "the base of this `powf` depends on `{argument}` and can be negative, where the power has no value"
        ),
        help,
    )
}

pub(crate) fn divisor_is_zero() -> Message {
    Message::new(
        "this divisor is zero",
        "check the constants in it; numbers are exact, `2 - 2` is nothing but zero",
    )
}

pub(crate) fn number_suffix(suffix: &str) -> Message {
    Message::new(
        format!("a number in a free energy has no type `{suffix}`"),
        "write it without suffix: all numbers are exact",
    )
}

pub(crate) fn number_and_name(digits: &str, name: &str) -> Message {
    Message::new(
        format!("`{digits}{name}` is not a number"),
        format!("for a product write `{digits} * {name}`"),
    )
}
