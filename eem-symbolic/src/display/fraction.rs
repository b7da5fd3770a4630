//! Products and quotients: factors of negative powers below one fraction bar.

use std::collections::HashMap;

use crate::node::ExprId;
use crate::number::{Number, Rational};

use super::text::{Binding, Text, decimal, render_number};

/// Factors above and below a fraction bar.
#[derive(Default)]
pub(super) struct Fraction {
    numerators: Vec<String>,
    denominators: Vec<String>,
    /// How a single numerator binds, if it is known to be an atom or a power.
    single: Option<Binding>,
}

impl Fraction {
    /// A decimal stays in front; the denominator of a fraction goes below the bar.
    pub(super) fn scale(&mut self, coefficient: Number) {
        match coefficient {
            Number::Exact(exact) if decimal(exact).is_none() => {
                if exact.numerator() != 1 {
                    self.numerators.push(exact.numerator().to_string());
                }
                self.denominators.push(exact.denominator().to_string());
            }
            Number::Exact(_) | Number::Float(_) => {
                self.numerators
                    .push(render_number(coefficient).within(Binding::Power));
            }
        }
    }

    /// Multiplies by anything but a product.
    pub(super) fn push(&mut self, factor: &Text) {
        self.numerators.push(factor.within(Binding::Power));
    }

    pub(super) fn multiply(
        &mut self,
        factors: &[(ExprId, Rational)],
        texts: &HashMap<ExprId, Text>,
    ) {
        for &(base, exponent) in factors {
            let list = if exponent.is_negative() {
                &mut self.denominators
            } else {
                &mut self.numerators
            };
            let magnitude = if exponent.is_negative() {
                -exponent
            } else {
                exponent
            };
            let power = render_power(&texts[&base], magnitude);
            list.push(power.within(Binding::Power));
            self.single = Some(power.binding.max(Binding::Power));
        }
    }

    pub(super) fn render(&self) -> Text {
        let numerator = if self.numerators.is_empty() {
            "1".into()
        } else {
            self.numerators.join("*")
        };
        let text = match &self.denominators[..] {
            [] => numerator,
            [only] => format!("{numerator}/{only}"),
            several => format!("{numerator}/({})", several.join("*")),
        };
        let binding = match (self.single, self.numerators.len(), self.denominators.len()) {
            (Some(binding), 1, 0) => binding,
            _ => Binding::Product,
        };
        Text { text, binding }
    }
}

/// `base ^ exponent` for a positive exponent.
fn render_power(base: &Text, exponent: Rational) -> Text {
    if exponent == Rational::ONE {
        return base.clone();
    }
    if exponent == Rational::HALF {
        return Text::atom(format!("sqrt({})", base.text));
    }
    let exponent = render_number(Number::Exact(exponent)).within(Binding::Atom);
    Text {
        text: format!("{}^{exponent}", base.within(Binding::Atom)),
        binding: Binding::Power,
    }
}
