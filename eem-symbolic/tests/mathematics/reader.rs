//! Formulas that are, or are not, one expression.

use eem_symbolic::Graph;

pub(crate) use crate::support::laws::reader::read;

/// Whether two formulas are one expression.
pub(crate) fn same(left: &str, right: &str) {
    let mut graph = Graph::new();
    let (a, b) = (read(&mut graph, left), read(&mut graph, right));
    let texts = [a, b].map(|e| eem_symbolic::format(&graph, e));
    assert_eq!(a, b, "{left} is {}, {right} is {}", texts[0], texts[1]);
}

/// Whether two formulas stay two expressions.
pub(crate) fn different(left: &str, right: &str) {
    let mut graph = Graph::new();
    let (a, b) = (read(&mut graph, left), read(&mut graph, right));
    assert_ne!(a, b, "{left} has become {right}");
}
