//! The text of one node, given the texts of its operands.

use std::collections::HashMap;

use crate::graph::Graph;
use crate::node::{ExprId, Kernel, Node};
use crate::number::{Number, Rational};

/// A piece of formula and how tightly it holds together.
#[derive(Clone)]
pub(super) struct Text {
    pub(super) text: String,
    binding: Binding,
}

#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Binding {
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

    /// The text where at least `binding` is needed.
    fn within(&self, binding: Binding) -> String {
        if self.binding < binding {
            format!("({})", self.text)
        } else {
            self.text.clone()
        }
    }
}

pub(super) fn render(graph: &Graph, id: ExprId, texts: &HashMap<ExprId, Text>) -> Text {
    let list = |operands: &[ExprId]| {
        let texts: Vec<_> = operands
            .iter()
            .map(|operand| texts[operand].text.as_str())
            .collect();
        texts.join(", ")
    };
    match graph.node(id) {
        Node::Number(number) => render_number(*number),
        Node::Variable(symbol) => Text::atom(graph.name(*symbol).to_owned()),
        Node::Sum { constant, terms } => render_sum(graph, *constant, terms, texts),
        Node::Product(factors) => {
            let mut fraction = Fraction::default();
            fraction.multiply(factors, texts);
            fraction.render()
        }
        Node::Power(base, exponent) => {
            let (base, exponent) = (&texts[base], &texts[exponent]);
            let exponent = exponent.within(Binding::Atom);
            Text {
                text: format!("{}^{exponent}", base.within(Binding::Atom)),
                binding: Binding::Power,
            }
        }
        Node::Apply(function, argument) => {
            Text::atom(format!("{}({})", function.name(), texts[argument].text))
        }
        Node::PairSum(a, b) => {
            let terms = [(Number::ONE, *a), (Number::ONE, *b)];
            render_sum(graph, Number::ZERO, &terms, texts)
        }
        Node::DividedDifference(kernel, a, b) => Text::atom(format!(
            "{}[{}]",
            kernel_name(*kernel, texts),
            list(&[*a, *b])
        )),
        Node::SecondDividedDifference(kernel, a, b) => Text::atom(format!(
            "{}[{}]",
            kernel_name(*kernel, texts),
            list(&[*a, *b, *b])
        )),
        Node::PowerDifference { logarithms, .. } => {
            Text::atom(format!("exp[{}]", list(logarithms)))
        }
    }
}

fn kernel_name(kernel: Kernel, texts: &HashMap<ExprId, Text>) -> String {
    match kernel {
        Kernel::Function(function) => function.name().to_owned(),
        Kernel::Sqrt => "sqrt".to_owned(),
        Kernel::Recip => "recip".to_owned(),
        Kernel::Powi(exponent) if exponent < 0 => format!("pow({exponent})"),
        Kernel::Powi(exponent) => format!("pow{exponent}"),
        Kernel::Powf(exponent) => format!("pow({})", texts[&exponent].text),
    }
}

/// Integers and decimals as such, other rationals as fractions, floats so that they round-trip.
fn render_number(number: Number) -> Text {
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

/// The number as it would be typed, if it is a short decimal: what a literal was before it became
/// a fraction.
fn decimal(exact: Rational) -> Option<String> {
    let text = format!("{:?}", exact.to_f64());
    let text = text.strip_suffix(".0").unwrap_or(&text);
    (Rational::parse_decimal(text) == Some(exact)).then(|| text.to_owned())
}

/// Terms with their signs, a positive one in front if there is one.
fn render_sum(
    graph: &Graph,
    constant: Number,
    terms: &[(Number, ExprId)],
    texts: &HashMap<ExprId, Text>,
) -> Text {
    let mut parts: Vec<_> = terms
        .iter()
        .map(|&(coefficient, term)| {
            (
                coefficient.is_negative(),
                render_term(graph, coefficient.abs(), term, texts),
            )
        })
        .collect();
    if !constant.is_zero() {
        parts.push((constant.is_negative(), render_number(constant.abs())));
    }
    if let Some(first) = parts.iter().position(|(negative, _)| !negative) {
        parts[..=first].rotate_right(1);
    }
    let mut text = String::new();
    for (index, (negative, part)) in parts.iter().enumerate() {
        text.push_str(match (index, negative) {
            (0, false) => "",
            (0, true) => "-",
            (_, false) => " + ",
            (_, true) => " - ",
        });
        text.push_str(&part.within(if *negative {
            Binding::Product
        } else {
            Binding::Sum
        }));
    }
    let binding = match &parts[..] {
        [(false, only)] => only.binding,
        _ => Binding::Sum,
    };
    Text { text, binding }
}

/// `coefficient · term` for a coefficient that is not negative.
fn render_term(
    graph: &Graph,
    coefficient: Number,
    term: ExprId,
    texts: &HashMap<ExprId, Text>,
) -> Text {
    if coefficient == Number::ONE {
        return texts[&term].clone();
    }
    let mut fraction = Fraction::default();
    fraction.scale(coefficient);
    match graph.node(term) {
        Node::Product(factors) if texts[&term].binding < Binding::Atom => {
            fraction.multiply(factors, texts);
        }
        _ => fraction
            .numerators
            .push(texts[&term].within(Binding::Power)),
    }
    fraction.render()
}

/// Factors above and below a fraction bar.
#[derive(Default)]
struct Fraction {
    numerators: Vec<String>,
    denominators: Vec<String>,
    /// How a single numerator binds, if it is known to be an atom or a power.
    single: Option<Binding>,
}

impl Fraction {
    /// A decimal stays in front; the denominator of a fraction goes below the bar.
    fn scale(&mut self, coefficient: Number) {
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

    fn multiply(&mut self, factors: &[(ExprId, Rational)], texts: &HashMap<ExprId, Text>) {
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

    fn render(&self) -> Text {
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
