//! Substitution of expressions for symbols, simultaneous and in canonical form again.

use std::collections::HashMap;

use crate::graph::Graph;
use crate::node::{ExprId, Node, Symbol};

/// The expression with every symbol of the list replaced, all at once.
///
/// Takes time linear in the size of the expression; shared subexpressions stay shared.
///
/// ```
/// use eem_symbolic::{Graph, format, substitute};
///
/// let mut graph = Graph::new();
/// let (x, y) = (graph.symbol("x"), graph.symbol("y"));
/// let (at_x, at_y) = (graph.variable(x), graph.variable(y));
/// let quotient = graph.div(at_x, at_y);
/// let swapped = substitute(&mut graph, quotient, &[(x, at_y), (y, at_x)]);
/// assert_eq!(format(&graph, swapped), "y/x");
/// ```
pub fn substitute(graph: &mut Graph, e: ExprId, replacements: &[(Symbol, ExprId)]) -> ExprId {
    image(&substitute_all(graph, e, replacements), e)
}

/// The images of all subexpressions that contain a replaced symbol; the others are their own.
pub(crate) fn substitute_all(
    graph: &mut Graph,
    e: ExprId,
    replacements: &[(Symbol, ExprId)],
) -> HashMap<ExprId, ExprId> {
    let symbols: Vec<_> = replacements.iter().map(|&(symbol, _)| symbol).collect();
    let mut images = HashMap::new();
    for id in graph.dependents(e, &symbols) {
        let new = if let Node::Variable(name) = graph.node(id) {
            let entry = replacements.iter().find(|(symbol, _)| symbol == name);
            entry.map_or(id, |&(_, replacement)| replacement)
        } else {
            let mapped = graph
                .node(id)
                .map(|symbol| symbol, |operand| image(&images, operand));
            rebuild(graph, mapped)
        };
        images.insert(id, new);
    }
    images
}

/// The image of an expression; the expression itself if the map has none.
pub(crate) fn image(images: &HashMap<ExprId, ExprId>, e: ExprId) -> ExprId {
    images.get(&e).copied().unwrap_or(e)
}

/// Passes a node with new operands through its constructor.
pub(crate) fn rebuild(graph: &mut Graph, node: Node) -> ExprId {
    match node {
        Node::Number(number) => graph.number(number),
        Node::Variable(symbol) => graph.variable(symbol),
        Node::Sum { constant, terms } => graph.weighted_sum(constant, &terms),
        Node::Product(factors) => graph.power_product(&factors),
        Node::Power(base, exponent) => graph.power(base, exponent),
        Node::Apply(function, argument) => graph.apply(function, argument),
        Node::PairSum(a, b) => graph.pair_sum(a, b),
        Node::DividedDifference(kernel, a, b) => graph.kernel_difference(kernel, a, b),
        Node::SecondDividedDifference(kernel, a, b) => graph.second_kernel_difference(kernel, a, b),
        Node::PowerDifference { values, logarithms } => graph.power_difference(values, logarithms),
    }
}
