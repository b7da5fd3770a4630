//! The text of one node, given the texts of its operands.

use std::collections::HashMap;

use crate::graph::Graph;
use crate::node::{ExprId, Kernel, Node};
use crate::number::Number;

use super::fraction::Fraction;
use super::text::{Binding, Text, render_number};

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
    let text = &texts[&term];
    // A product that is an atom has a name, or is a single root.
    if let (Node::Product(factors), true) = (graph.node(term), text.binding < Binding::Atom) {
        fraction.multiply(factors, texts);
    } else {
        fraction.push(text);
    }
    fraction.render()
}
