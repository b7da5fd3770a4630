//! The input of scheduling besides the outputs of the program, and the operands of expressions in it.

use super::locals::Locals;
use crate::graph::Graph;
use crate::node::ExprId;

/// The expressions of a program: a graph and its locals.
pub(crate) struct Schedule<'g> {
    pub(crate) graph: &'g Graph,
    pub(crate) locals: &'g Locals,
    /// Number of inputs, the first ones, that are parameters or, like parameters, known before all others.
    pub(crate) parameters: usize,
}

impl Schedule<'_> {
    /// The operands of an expression; of a local, its definition.
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
