//! Messages about solids at rest.

use crate::ast::{Joint, Role, Strain};
use crate::message::Message;

const AT_REST: &str = "at rest, where all strains are zero";

pub(crate) fn divisor(name: &str, strain: Role) -> Message {
    Message::new(
        format!("this divisor is zero {AT_REST}"),
        meaning(name, strain),
    )
}

pub(crate) fn value(function: &str, domain: &str, name: &str, strain: Role) -> Message {
    Message::new(
        format!("`{function}` has no value {AT_REST}: it is defined for `{domain}`"),
        meaning(name, strain),
    )
}

/// `argument` is as quoted; `signed` means that it can be negative.
pub(crate) fn power(function: &str, exponent: f64, argument: &str, signed: bool) -> Message {
    let which = if exponent < 1.0 { "" } else { "second " };
    let write = match function {
        "powf" => format!("({argument} + c * c).powf({exponent})"),
        "cbrt" if signed => "x / cbrt(x * x + c * c)".to_owned(),
        _ if signed => "(x * x + c * c).powf(0.25)".to_owned(),
        _ => format!("{function}({argument} + c * c)"),
    };
    Message::new(
        format!("this `{function}` has no {which}derivative {AT_REST}: its argument is zero"),
        format!("write `{write}` with a small parameter `c`"),
    )
}

pub(crate) fn negative(function: &str) -> Message {
    Message::new(
        format!("this `{function}` has no value {AT_REST}: its argument is negative"),
        "check the signs in the argument",
    )
}

/// What the strain is, and what may have been meant.
fn meaning(name: &str, strain: Role) -> String {
    let strain = match strain {
        Role::Strain(strain) => strain,
        Role::Joint(joint) => {
            let what = match joint {
                Joint::Trace => "tr Γ",
                Joint::Square => "Γ:Γ",
                Joint::Strain => "E:Γ",
            };
            return format!("`{name}` is {what} of the viscous strain Γ, which is zero at first");
        }
        Role::Stretch | Role::Viscous | Role::Temperature => unreachable!("it is a strain"),
    };
    match strain {
        Strain::Trace => format!("`{name}` is tr E; tr C is `3 + 2 * {name}`"),
        Strain::Square => format!("`{name}` is E:E, which is zero at rest"),
        Strain::Fibre => format!(
            "`{name}` is a·E a; the square of the fibre's stretch is `1 + 2 * {name}`, and its logarithm `ln_1p(2 * {name})`"
        ),
        Strain::Dilatation => {
            format!("`{name}` is J - 1; J is `1 + {name}`, and its logarithm is `ln_1p({name})`")
        }
    }
}
