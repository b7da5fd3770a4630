//! Pieces of formulas that know when they need parentheses, and numbers as such pieces.

use crate::number::{Number, Rational};

/// A piece of a formula and how tightly it binds.
#[derive(Clone)]
pub(super) struct Text {
    pub(super) text: String,
    pub(super) binding: Binding,
}

#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Binding {
    Sum,
    Product,
    Power,
    Atom,
}

impl Text {
    pub(super) fn atom(text: String) -> Text {
        Text {
            text,
            binding: Binding::Atom,
        }
    }

    /// The text, in parentheses if it binds less tightly than `binding`.
    pub(super) fn within(&self, binding: Binding) -> String {
        if self.binding < binding {
            format!("({})", self.text)
        } else {
            self.text.clone()
        }
    }
}

/// Integers and decimals as such, other rationals as fractions, floats so that they round-trip.
pub(super) fn render_number(number: Number) -> Text {
    let text = match number {
        Number::Exact(exact) => decimal(exact).unwrap_or_else(|| exact.to_string()),
        Number::Float(_) => number.to_string(),
    };
    let binding = match number {
        _ if number.is_negative() => Binding::Sum,
        Number::Exact(_) if text.contains('/') => Binding::Product,
        Number::Exact(_) | Number::Float(_) => Binding::Atom,
    };
    Text { text, binding }
}

/// The number as a decimal, as its literal was typed, if it is a short one.
pub(super) fn decimal(exact: Rational) -> Option<String> {
    let text = format!("{:?}", exact.to_f64());
    let text = text.strip_suffix(".0").unwrap_or(&text);
    (Rational::parse_decimal(text) == Some(exact)).then(|| text.to_owned())
}
