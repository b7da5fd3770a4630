//! What a schedule is made from, and what expressions are computed from with it.

use super::locals::Locals;
use crate::graph::Graph;
use crate::node::ExprId;

/// What a schedule is made from besides inputs and outputs.
pub(crate) struct Schedule<'g> {
    pub(crate) graph: &'g Graph,
    pub(crate) locals: &'g Locals,
    /// How many of the first inputs are parameters, or like parameters: known before all others.
    pub(crate) parameters: usize,
}

impl Schedule<'_> {
    /// What an expression is computed from.
    pub(super) fn operands(&self, e: ExprId) -> Vec<ExprId> {
        let mut operands = Vec::new();
        match self.definition(e) {
            Some(definition) => operands.push(definition),
            None => self
                .graph
                .node(e)
                .for_each_operand(|operand| operands.push(operand)),
        }
        operands
    }

    /// The expression that a local stands for.
    pub(super) fn definition(&self, e: ExprId) -> Option<ExprId> {
        let resolved = self.locals.resolve(self.graph, e);
        (resolved != e).then_some(resolved)
    }
}
