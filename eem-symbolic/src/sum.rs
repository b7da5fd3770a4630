//! Sums in canonical form: flat, one coefficient per term, terms in structural order.

use std::collections::BTreeMap;

use crate::graph::Graph;
use crate::node::{ExprId, Node};
use crate::number::Number;
use crate::order::compare;
use crate::product::WIDTH;

impl Graph {
    /// `constant + Σ coefficient · term`.
    ///
    /// Laws, none of which changes the domain:
    /// * `c·t + d·t = (c + d)·t` and `0·t = 0` (t finite);
    /// * sums inside sums are flattened under coefficients ±1. Under another coefficient they stay:
    ///   `c·(θ − θ_r)` loses digits when it is distributed. So do sums of more than 8 terms;
    /// * `c·(d·t) = (c·d)·t`.
    pub fn weighted_sum(&mut self, constant: Number, terms: &[(Number, ExprId)]) -> ExprId {
        let mut collected = Collected {
            constant,
            coefficients: BTreeMap::new(),
        };
        let mut pending = terms.to_vec();
        while !pending.is_empty() {
            pending
                .drain(..)
                .for_each(|(coefficient, term)| collected.add(self, coefficient, term));
            pending = collected.take_flattenable(self);
        }
        let Collected {
            constant,
            coefficients,
        } = collected;
        let mut terms: Vec<_> = coefficients
            .into_iter()
            .map(|(term, c)| (c, term))
            .collect();
        match terms[..] {
            [] => self.number(constant),
            [(c, term)] if c == Number::ONE && constant.is_zero() => term,
            _ => {
                terms.sort_by(|p, q| compare(self, p.1, q.1));
                self.intern(Node::Sum { constant, terms })
            }
        }
    }

    /// `a + b` as one addition that surrounding sums do not take apart.
    ///
    /// Addition of two floats commutes and a longer sum does not. Averages over both ends of a step
    /// are built with this constructor, so that exchanging the ends does not change a bit.
    pub fn pair_sum(&mut self, a: ExprId, b: ExprId) -> ExprId {
        if a == b {
            return self.scale(Number::from(2_i64), a);
        }
        if self.as_number(a).is_some() || self.as_number(b).is_some() {
            return self.add(a, b);
        }
        let (first, second) = if compare(self, a, b).is_le() {
            (a, b)
        } else {
            (b, a)
        };
        self.intern(Node::PairSum(first, second))
    }

    /// `a + b`.
    pub fn add(&mut self, a: ExprId, b: ExprId) -> ExprId {
        self.sum(&[a, b])
    }

    /// `a − b`.
    pub fn sub(&mut self, a: ExprId, b: ExprId) -> ExprId {
        self.weighted_sum(Number::ZERO, &[(Number::ONE, a), (Number::MINUS_ONE, b)])
    }

    /// `−a`.
    pub fn neg(&mut self, a: ExprId) -> ExprId {
        self.scale(Number::MINUS_ONE, a)
    }

    /// `coefficient · a`.
    pub fn scale(&mut self, coefficient: Number, a: ExprId) -> ExprId {
        self.weighted_sum(Number::ZERO, &[(coefficient, a)])
    }

    /// `Σ terms`.
    pub fn sum(&mut self, terms: &[ExprId]) -> ExprId {
        let terms: Vec<_> = terms.iter().map(|&term| (Number::ONE, term)).collect();
        self.weighted_sum(Number::ZERO, &terms)
    }
}

/// A sum that is being collected; coefficients are never 0.
struct Collected {
    constant: Number,
    coefficients: BTreeMap<ExprId, Number>,
}

impl Collected {
    fn add(&mut self, graph: &Graph, coefficient: Number, term: ExprId) {
        if coefficient.is_zero() {
            return;
        }
        if let Some(number) = graph.as_number(term) {
            self.constant = self.constant + coefficient * number;
            return;
        }
        let scaled = graph.as_scaled(term).and_then(|(inner, inner_term)| {
            Some((coefficient.product_in_range(inner)?, inner_term))
        });
        let (coefficient, term) = scaled.unwrap_or((coefficient, term));
        self.add_term(coefficient, term);
    }

    fn add_term(&mut self, coefficient: Number, term: ExprId) {
        let sum = self
            .coefficients
            .get(&term)
            .map_or(coefficient, |&c| c + coefficient);
        if sum.is_zero() {
            self.coefficients.remove(&term);
        } else {
            self.coefficients.insert(term, sum);
        }
    }

    /// Removes the terms that are sums with coefficient ±1, adds their constants, and returns their terms.
    fn take_flattenable(&mut self, graph: &Graph) -> Vec<(Number, ExprId)> {
        let mut parts = Vec::new();
        let constant = &mut self.constant;
        self.coefficients.retain(|&term, &mut coefficient| {
            let Node::Sum {
                constant: inner,
                terms,
            } = graph.node(term)
            else {
                return true;
            };
            let plain = coefficient == Number::ONE || coefficient == Number::MINUS_ONE;
            if !plain || terms.len() > WIDTH {
                return true;
            }
            *constant = *constant + coefficient * *inner;
            parts.extend(
                terms
                    .iter()
                    .map(|&(c, inner_term)| (coefficient * c, inner_term)),
            );
            false
        });
        parts
    }
}
