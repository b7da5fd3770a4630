//! The expressions that the outputs of a program are computed from, and which of them depend on given symbols.

use std::collections::{BTreeSet, HashMap};

use super::context::Schedule;
use crate::node::{ExprId, Node, Symbol};

/// All expressions below some roots, through the definitions of locals.
pub(crate) struct Dependence<'s> {
    pub(super) schedule: &'s Schedule<'s>,
    symbols: &'s BTreeSet<Symbol>,
    /// Operands first.
    reached: Vec<ExprId>,
    /// Looked up, never iterated.
    dependent: HashMap<ExprId, bool>,
}

impl<'s> Dependence<'s> {
    /// Visits all expressions that the roots are computed from.
    pub(crate) fn new(
        schedule: &'s Schedule<'s>,
        symbols: &'s BTreeSet<Symbol>,
        roots: &[ExprId],
    ) -> Self {
        let mut dependence = Self {
            schedule,
            symbols,
            reached: Vec::new(),
            dependent: HashMap::new(),
        };
        for &root in roots {
            dependence.visit(root);
        }
        dependence
    }

    /// The roots and all expressions that they are computed from, operands first.
    pub(crate) fn reached(&self) -> &[ExprId] {
        &self.reached
    }

    /// Whether a reached expression depends on one of the symbols.
    pub(crate) fn on(&self, e: ExprId) -> bool {
        self.dependent.get(&e).copied().unwrap_or(false)
    }

    fn visit(&mut self, root: ExprId) {
        let schedule = self.schedule;
        let mut pending = vec![(root, false)];
        while let Some((e, operands_done)) = pending.pop() {
            if self.dependent.contains_key(&e) {
                continue;
            }
            let operands = schedule.operands(e);
            if operands_done {
                let mut dependent = operands.iter().any(|&operand| self.on(operand));
                if let (Node::Variable(symbol), true) =
                    (schedule.graph.node(e), operands.is_empty())
                {
                    dependent = self.symbols.contains(symbol);
                }
                self.dependent.insert(e, dependent);
                self.reached.push(e);
                continue;
            }
            pending.push((e, true));
            pending.extend(operands.into_iter().rev().map(|operand| (operand, false)));
        }
    }
}
