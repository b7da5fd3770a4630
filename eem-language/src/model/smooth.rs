//! Derivatives: expressions of the state must have one everywhere, and `diff` must not be zero identically.

use eem_symbolic::{ExprId, Function, Node};

use super::Lowering;
use crate::ast;
use crate::checked::Expr;
use crate::message::expression as message;

impl Lowering<'_> {
    /// |x| has no derivative at zero, so that only parameters may be inside.
    pub(super) fn abs(&mut self, token: &syn::Ident, inner: &Expr<'_>) -> Option<ExprId> {
        let inner = self.expr(inner)?;
        if let Some(name) = self.argument_in(inner) {
            self.cx.error(token, &message::abs_of_state(&name));
            return None;
        }
        Some(self.graph.apply(Function::Abs, inner))
    }

    /// Reports √(x²) where x depends on the state and can have both signs: it is |x|.
    pub(super) fn check_square(&self, expr: &Expr<'_>, value: ExprId) -> Option<()> {
        let Some(base) = self.squared(value) else {
            return Some(());
        };
        let sign = self.sign(base);
        match self.argument_in(base) {
            Some(name) if sign.negative && sign.positive => {
                let message = message::root_of_square(&name);
                self.cx.error(expr.original, &message);
                None
            }
            _ => Some(()),
        }
    }

    /// x, if the expression is c·x² or a product with such a factor.
    fn squared(&self, value: ExprId) -> Option<ExprId> {
        let product = match self.graph.node(value) {
            Node::Sum { constant, terms } if constant.is_zero() && terms.len() == 1 => terms[0].1,
            _ => value,
        };
        let Node::Product(factors) = self.graph.node(product) else {
            return None;
        };
        let square = factors.iter().find(|(_, power)| power.to_i32() == Some(2));
        square.map(|&(base, _)| base)
    }

    /// Reports the derivative of an expression without arguments: it is zero, which was hardly meant.
    pub(super) fn check_derivative(&self, expr: &Expr<'_>, value: ExprId) -> Option<()> {
        if self.argument_in(value).is_none() {
            self.cx.error(expr.original, &message::diff_of_number());
            return None;
        }
        Some(())
    }

    /// An argument of the free energy that the expression depends on.
    pub(super) fn argument_in(&self, value: ExprId) -> Option<String> {
        let mut variables = self.checked.variables.iter().zip(&self.variables);
        let found = variables.find(|&(_, &symbol)| self.graph.depends_on(value, symbol));
        found.map(|(variable, _)| ast::name(variable.ident))
    }
}
