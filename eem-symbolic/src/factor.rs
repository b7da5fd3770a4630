//! Common factors of the terms of a sum, taken out: `a·x + a·y` costs one product as `a·(x + y)`.

use std::collections::BTreeMap;

use crate::graph::Graph;
use crate::node::{ExprId, Node};
use crate::number::{Number, Rational};
use crate::substitute::rebuild;

/// Expressions, and equal ones whose sums are factored; each expression is visited once.
#[derive(Debug, Default)]
pub(crate) struct Factoring {
    images: BTreeMap<ExprId, ExprId>,
}

impl Factoring {
    /// Puts `image` wherever `e` occurs.
    pub(crate) fn replace(&mut self, e: ExprId, image: ExprId) {
        self.images.insert(e, image);
    }

    /// An equal expression in which no two terms of a sum have a factor in common.
    pub(crate) fn of(&mut self, graph: &mut Graph, e: ExprId) -> ExprId {
        let mut pending = vec![(e, false)];
        while let Some((id, operands_done)) = pending.pop() {
            if self.images.contains_key(&id) {
                continue;
            }
            if !operands_done {
                pending.push((id, true));
                let node = graph.node(id);
                node.for_each_operand(|operand| pending.push((operand, false)));
                continue;
            }
            let node = graph.node(id).clone();
            let mapped = node.map(|symbol| symbol, |operand| self.image(operand));
            let image = match mapped {
                Node::Sum { constant, terms } => {
                    let sum = graph.weighted_sum(constant, &terms);
                    factored(graph, sum)
                }
                Node::Number(_) | Node::Variable(_) => id,
                Node::Product(_)
                | Node::Power(..)
                | Node::Apply(..)
                | Node::PairSum(..)
                | Node::DividedDifference(..)
                | Node::SecondDividedDifference(..)
                | Node::PowerDifference { .. } => rebuild(graph, mapped),
            };
            self.images.insert(id, image);
        }
        self.image(e)
    }

    fn image(&self, e: ExprId) -> ExprId {
        self.images.get(&e).copied().unwrap_or(e)
    }
}

type Term = (Number, ExprId);

/// Takes out factors, the most frequent first, until no two terms have one in common.
fn factored(graph: &mut Graph, sum: ExprId) -> ExprId {
    let Node::Sum { constant, terms } = graph.node(sum).clone() else {
        return sum;
    };
    let Some(factor) = most_frequent(graph, &terms) else {
        return sum;
    };
    let (mut with, mut without) = (Vec::new(), Vec::new());
    for (coefficient, term) in terms {
        let factors = factors(graph, term);
        if factors.contains(&factor) {
            let rest: Vec<_> = factors.into_iter().filter(|f| *f != factor).collect();
            with.push((coefficient, graph.power_product(&rest)));
        } else {
            without.push((coefficient, term));
        }
    }
    let inner = graph.weighted_sum(Number::ZERO, &with);
    let inner = factored(graph, inner);
    let product = graph.power_product(&[factor, (inner, Rational::ONE)]);
    without.push((Number::ONE, product));
    let sum = graph.weighted_sum(constant, &without);
    factored(graph, sum)
}

/// The factor of most terms, at least two; among equals the first in structural order.
fn most_frequent(graph: &Graph, terms: &[Term]) -> Option<(ExprId, Rational)> {
    let mut counts: Vec<((ExprId, Rational), usize)> = Vec::new();
    let mut positions = BTreeMap::new();
    for &(_, term) in terms {
        for factor in factors(graph, term) {
            let position = *positions.entry(factor).or_insert(counts.len());
            if position == counts.len() {
                counts.push((factor, 0));
            }
            counts[position].1 += 1;
        }
    }
    let best = counts.iter().map(|&(_, count)| count).max().unwrap_or(0);
    let found = counts
        .iter()
        .find(|&&(_, count)| count == best && count > 1);
    found.map(|&(factor, _)| factor)
}

fn factors(graph: &Graph, term: ExprId) -> Vec<(ExprId, Rational)> {
    if let Node::Product(factors) = graph.node(term) {
        factors.clone()
    } else {
        vec![(term, Rational::ONE)]
    }
}
