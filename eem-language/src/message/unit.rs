//! Messages about units.

use proc_macro2::Ident;

use super::{Message, Said, list, said};
use crate::ast;
use crate::unit::Unit;

const EXAMPLE: &str = "`#[unit(\"J/K\")]`";

pub(crate) fn not_on_a_field() -> Message {
    Message::new(
        "`#[unit]` is not expected on a struct",
        format!(
            "write {EXAMPLE} above a field; the unit of a constant is `#[unit(R = \"J/(mol K)\")]`"
        ),
    )
}

pub(crate) fn not_a_string() -> Message {
    Message::new(
        "`#[unit]` takes one string",
        format!("write {EXAMPLE}, or `#[unit(\"1\")]` if it is dimensionless"),
    )
}

pub(crate) fn second() -> Message {
    Message::new("a second unit", "a field has one unit; remove one of them")
}

pub(crate) fn unreadable_constants() -> Message {
    Message::new(
        "`#[unit]` on a struct takes constants and their units",
        "write `#[unit(R = \"J/(mol K)\")]` with the path of the constant as it stands in the formula",
    )
}

pub(crate) fn second_of_constant(name: &str) -> Message {
    Message::new(
        format!("a second unit of the constant `{name}`"),
        "a constant has one unit; remove one of them",
    )
}

pub(crate) fn of_pure_number(name: &str) -> Message {
    Message::new(
        format!("`{name}` is dimensionless"),
        "remove its unit; only fields and constants of your own have one",
    )
}

pub(crate) fn of_field(name: &str) -> Message {
    Message::new(
        format!("`{name}` is a field, and not a constant"),
        format!("its unit stands above it, as in {EXAMPLE}"),
    )
}

pub(crate) fn of_no_constant<'n>(
    name: &str,
    nearest: Option<&str>,
    constants: impl IntoIterator<Item = &'n str>,
) -> Message {
    let mut constants = constants.into_iter().peekable();
    let help = match nearest {
        Some(nearest) => format!("did you mean `{nearest}`?"),
        None if constants.peek().is_none() => "remove its unit".to_owned(),
        None => format!(
            "the constants of the formulas are {}, spelt like this",
            list(constants)
        ),
    };
    Message::new(format!("no formula mentions the constant `{name}`"), help)
}

pub(crate) fn empty() -> Message {
    Message::new(
        "a unit without a symbol",
        said(|d| format!("write {} if it is dimensionless", d.unit("1"))),
    )
}

pub(crate) fn unknown(symbol: &str, advice: String) -> Message {
    Message::new(format!("unknown unit `{symbol}`"), advice)
}

#[cfg_attr(test, track_caller)]
fn unreadable(text: &str, help: impl Into<Said>) -> Message {
    Message::new(format!("cannot read the unit `{text}`"), help)
}

pub(crate) fn unexpected(text: &str, character: char) -> Message {
    unreadable(
        text,
        format!("`{character}` is not expected; write for example `kg m^2/(s^2 K)`"),
    )
}

pub(crate) fn unfinished(text: &str) -> Message {
    unreadable(text, "a symbol is missing at the end")
}

pub(crate) fn parenthesis(text: &str) -> Message {
    unreadable(text, "the parentheses do not match")
}

pub(crate) fn power_stars(text: &str) -> Message {
    unreadable(text, "a power is written with `^`, as in `m^2`")
}

pub(crate) fn minus(text: &str, symbol: &str) -> Message {
    unreadable(
        text,
        format!("a negative power is written `{symbol}^-1` or `1/{symbol}`"),
    )
}

pub(crate) fn number(text: &str, number: &str) -> Message {
    unreadable(
        text,
        format!("`{number}` belongs to the value; a unit may have a prefix, as in `kN/m`"),
    )
}

pub(crate) fn ambiguous_quotient(text: &str) -> Message {
    unreadable(
        text,
        "say what is divided by: `J/(kg K)` or `J K/kg`, not `J/kg K`",
    )
}

pub(crate) fn exponent(text: &str, largest: i64) -> Message {
    unreadable(
        text,
        format!(
            "an exponent is an integer or a fraction, `m^2` or `m^(1/2)`, of at most {largest}"
        ),
    )
}

pub(crate) fn missing(field: &Ident, unit: Option<&Unit>) -> Message {
    let name = ast::name(field);
    let help = said(|d| {
        let (one, above) = (d.unit("1"), d.above());
        let Some(unit) = unit else {
            let unit = d.the_unit("…");
            return format!("write {unit}{above}, {one} if it is dimensionless");
        };
        let unit = d.the_unit(&unit.to_string());
        format!("the formula needs {unit}{above}")
    });
    Message::new(
        said(|d| {
            let field = d.field();
            format!("`{name}` has no unit, but other {field}s of the formula have one")
        }),
        help,
    )
}

/// A part of an expression as quoted, and its unit.
pub(crate) struct Side<'m> {
    pub(crate) text: &'m str,
    pub(crate) unit: &'m Unit,
}

impl Side<'_> {
    /// `in N/m`, `dimensionless`, `dimensionless with a factor of …`
    fn phrase(&self) -> String {
        match (self.unit.is_one(), self.unit.coherent().is_one()) {
            (true, _) => "dimensionless".to_owned(),
            (false, true) => format!("dimensionless with a factor of {}", self.unit.expanded()),
            (false, false) => format!("in {}", self.unit),
        }
    }

    /// `N/m`, `a dimensionless number`
    fn name(&self) -> String {
        if self.unit.is_one() {
            "a dimensionless number".to_owned()
        } else {
            self.unit.to_string()
        }
    }
}

pub(crate) fn sum(
    difference: bool,
    left: &Side<'_>,
    right: &Side<'_>,
    help: impl Into<Said>,
) -> Message {
    let verb = if difference {
        format!("subtract {} from {}", right.name(), left.name())
    } else {
        format!("add {} and {}", left.name(), right.name())
    };
    Message::new(
        format!(
            "cannot {verb}: the left side `{}` is {}, the right side `{}` is {}",
            left.text,
            left.phrase(),
            right.text,
            right.phrase()
        ),
        help,
    )
}

/// Help for a bare number that is added to or subtracted from a quantity: `theta - 300`.
pub(crate) fn number_with_unit(number: &str, unit: &Unit) -> Said {
    said(|d| {
        let (field, unit) = (d.a_field(), d.the_unit(&unit.to_string()));
        format!("make `{number}` {field} with {unit}: numbers in a formula have no unit")
    })
}

/// Help for units that differ by a factor only, which comes from the unit of `field`.
pub(crate) fn field_with_scale(field: &str, unit: &Unit) -> String {
    let coherent = unit.coherent();
    if coherent.is_one() {
        let scale = unit.expanded();
        return format!("the factor comes with `{field}`, whose unit is {scale}: use it once");
    }
    let scaled = unit.expanded();
    format!("`{field}` is in {unit}, and 1 {unit} is {scaled}: give it in {coherent}")
}

/// Help for units that differ: by what to divide or multiply the expression called `found`, which has this `unit`.
pub(crate) fn factor_is_missing(found: &str, wanted: &Unit, unit: &Unit) -> String {
    let divisor = unit.over(wanted).filter(|u| !u.to_string().contains('/'));
    let help = match divisor {
        Some(divisor) => Some(format!("divide {found} by {}", quantity(&divisor))),
        None => wanted
            .over(unit)
            .map(|factor| format!("multiply {found} by {}", quantity(&factor))),
    };
    help.unwrap_or_default()
}

/// `a length (m)`
fn quantity(unit: &Unit) -> String {
    let unit = unit.to_string();
    let name = match unit.as_str() {
        "m" => "a length",
        "m^2" => "an area",
        "m^3" => "a volume",
        "s" => "a time",
        "K" => "a temperature",
        "kg" => "a mass",
        "N" => "a force",
        "J" => "an energy",
        "Pa" => "a stress",
        _ => return format!("a quantity in {unit}"),
    };
    format!("{name} ({unit})")
}

pub(crate) fn function_of_unit(function: &str, argument: &Side<'_>, help: String) -> Message {
    Message::new(
        format!(
            "`{function}` expects a dimensionless argument, but `{}` is {}",
            argument.text,
            argument.phrase()
        ),
        help,
    )
}

/// Help for the argument of a function.
pub(crate) fn divide_by_reference(argument: &Side<'_>) -> String {
    let Side { text, unit } = argument;
    format!("divide `{text}` by a reference in {unit}")
}

pub(crate) fn exponent_with_unit(exponent: &Side<'_>) -> Message {
    Message::new(
        format!(
            "an exponent must be dimensionless, but `{}` is {}",
            exponent.text,
            exponent.phrase()
        ),
        divide_by_reference(exponent),
    )
}

pub(crate) fn power_of_unit(base: &Side<'_>, exponent: &str) -> Message {
    Message::new(
        format!(
            "`{}` is {}, so that the unit of its power would depend on the value of `{exponent}`",
            base.text,
            base.phrase()
        ),
        divide_by_reference(base),
    )
}

pub(crate) fn wrong_result(what: &str, wanted: &str, found: &Side<'_>, help: String) -> Message {
    Message::new(
        format!("{what} must be in {wanted}, but this is {}", found.phrase()),
        help,
    )
}

pub(crate) fn beyond_measure() -> Message {
    Message::new(
        "the unit of this expression has exponents that do not fit 128 bits",
        "use smaller powers",
    )
}
