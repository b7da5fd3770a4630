//! Named intermediate results: symbols that stand for an expression and hide its terms and factors.
//!
//! The canonical form of the graph merges sums into sums and products into products. That is right
//! for a formula, and wrong for a number that several formulas share: a mean temperature θ̄ = E/S
//! would be divided out again in every product it meets. A local keeps it one value.

use std::collections::BTreeMap;

use crate::graph::Graph;
use crate::node::{ExprId, Node, Symbol};

/// Definitions of symbols, each by an expression of inputs and other locals.
#[derive(Clone, Debug, Default)]
pub(crate) struct Locals {
    definitions: BTreeMap<Symbol, ExprId>,
    /// The local of each value: equal values have one name.
    names: BTreeMap<ExprId, ExprId>,
}

impl Locals {
    /// A variable that stands for `value`; `value` itself where naming it would hide that it is a
    /// number or a variable.
    pub(crate) fn name(&mut self, graph: &mut Graph, value: ExprId) -> ExprId {
        match graph.node(value) {
            Node::Number(_) | Node::Variable(_) => value,
            Node::Sum { .. }
            | Node::Product(_)
            | Node::Power(..)
            | Node::Apply(..)
            | Node::PairSum(..)
            | Node::PowerDifference { .. }
            | Node::DividedDifference(..)
            | Node::SecondDividedDifference(..) => {
                if let Some(&local) = self.names.get(&value) {
                    return local;
                }
                // No identifier of a formula contains `#`.
                let name = format!("#{}", self.definitions.len());
                let symbol = graph.symbol(&name);
                self.definitions.insert(symbol, value);
                let local = graph.variable(symbol);
                self.names.insert(value, local);
                local
            }
        }
    }

    /// Replaces every definition by an equal expression.
    pub(crate) fn redefine(&mut self, mut image: impl FnMut(ExprId) -> ExprId) {
        for definition in self.definitions.values_mut() {
            *definition = image(*definition);
        }
    }

    /// The definition of a local, anything else as it is.
    pub(crate) fn resolve(&self, graph: &Graph, value: ExprId) -> ExprId {
        match graph.node(value) {
            Node::Variable(symbol) => self.definitions.get(symbol).copied().unwrap_or(value),
            Node::Number(_)
            | Node::Sum { .. }
            | Node::Product(_)
            | Node::Power(..)
            | Node::Apply(..)
            | Node::PairSum(..)
            | Node::PowerDifference { .. }
            | Node::DividedDifference(..)
            | Node::SecondDividedDifference(..) => value,
        }
    }
}
