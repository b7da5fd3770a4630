//! The structural order of expressions: independent of the order of creation and of versions of symbols.
//!
//! Operands of sums and products are stored in this order. Versions of a symbol are compared only
//! between expressions that agree in everything else. Replacing λ⁰ by λ¹ therefore permutes
//! nothing, and an expression is evaluated by the same operations at both ends of a step.

use std::cmp::Ordering;

use crate::graph::Graph;
use crate::node::{ExprId, Kernel, Node};
use crate::number::Number;

/// Compares two expressions by kind (numbers, variables, products, sums, pair sums, powers, functions,
/// differences), by function and number of operands, by height, then operand by operand.
///
/// Descends along one path, because operands of equal shape are skipped: the first pair of operands
/// that differ decides. The time is bounded by the height of the expressions times their width.
pub(crate) fn compare(graph: &Graph, a: ExprId, b: ExprId) -> Ordering {
    let (mut a, mut b) = (a, b);
    while a != b {
        let heads = compare_heads(graph, graph.node(a), graph.node(b));
        let heads = heads.then(graph.height(a).cmp(&graph.height(b)));
        if heads.is_ne() {
            return heads;
        }
        let same_shape = graph.shape(a) == graph.shape(b);
        let difference = operands(graph, a)
            .into_iter()
            .zip(operands(graph, b))
            .find(|&(p, q)| {
                if same_shape {
                    p != q
                } else {
                    graph.shape(p) != graph.shape(q)
                }
            });
        match difference {
            Some((p, q)) => (a, b) = (p, q),
            None => return compare_details(graph, a, b),
        }
    }
    Ordering::Equal
}

/// Compares kinds, functions, and numbers of operands.
fn compare_heads(graph: &Graph, a: &Node, b: &Node) -> Ordering {
    let head = |node: &Node| match node {
        Node::Number(_) => (0, (0, 0), 0),
        Node::Variable(symbol) => (1, (0, 0), graph.rank(*symbol).0.index()),
        Node::Product(factors) => (2, (0, 0), factors.len()),
        Node::Sum { terms, .. } => (3, (0, 0), terms.len()),
        Node::PairSum(..) => (4, (0, 0), 0),
        Node::Power(..) => (5, (0, 0), 0),
        Node::Apply(function, _) => (6, (0, *function as i32), 0),
        Node::DividedDifference(kernel, ..) => (7, rank_of(*kernel), 0),
        Node::SecondDividedDifference(kernel, ..) => (8, rank_of(*kernel), 0),
        Node::PowerDifference { .. } => (9, (0, 0), 0),
    };
    head(a).cmp(&head(b))
}

fn rank_of(kernel: Kernel) -> (i32, i32) {
    match kernel {
        Kernel::Function(function) => (0, function as i32),
        Kernel::Sqrt => (1, 0),
        Kernel::Recip => (2, 0),
        Kernel::Powi(exponent) => (3, exponent),
        Kernel::Powf(_) => (4, 0),
    }
}

/// Compares what is left when heads and operands agree.
fn compare_details(graph: &Graph, a: ExprId, b: ExprId) -> Ordering {
    let (left, right) = (details(graph, a), details(graph, b));
    let orders = left
        .iter()
        .zip(&right)
        .map(|(&p, &q)| compare_numbers(p, q));
    orders.fold(Ordering::Equal, Ordering::then).then(a.cmp(&b))
}

/// Version, coefficients and exponents of a node as numbers.
fn details(graph: &Graph, e: ExprId) -> Vec<Number> {
    match graph.node(e) {
        Node::Number(number) => vec![*number],
        Node::Variable(symbol) => vec![Number::from(i64::from(graph.rank(*symbol).1))],
        Node::Sum { constant, terms } => {
            terms.iter().map(|term| term.0).chain([*constant]).collect()
        }
        Node::Product(factors) => factors
            .iter()
            .map(|&(_, exponent)| Number::Exact(exponent))
            .collect(),
        Node::Power(..)
        | Node::Apply(..)
        | Node::PairSum(..)
        | Node::DividedDifference(..)
        | Node::SecondDividedDifference(..)
        | Node::PowerDifference { .. } => Vec::new(),
    }
}

fn compare_numbers(a: Number, b: Number) -> Ordering {
    match (a, b) {
        (Number::Exact(a), Number::Exact(b)) => a.cmp(&b),
        (Number::Float(a), Number::Float(b)) => a.total_cmp(&b),
        (Number::Exact(_), Number::Float(_)) => Ordering::Less,
        (Number::Float(_), Number::Exact(_)) => Ordering::Greater,
    }
}

fn operands(graph: &Graph, e: ExprId) -> Vec<ExprId> {
    let mut operands = Vec::new();
    graph
        .node(e)
        .for_each_operand(|operand| operands.push(operand));
    operands
}
