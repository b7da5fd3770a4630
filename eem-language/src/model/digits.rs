//! Warnings of cancellation: differences of values that are nearly equal at rest lose the digits of small strains.

use eem_symbolic::{ExprId, Function};

use super::Lowering;
use crate::ast::Operator;
use crate::checked::{Expr, ExprKind};
use crate::message::expression::digits as message;
use crate::units::excerpt;

impl Lowering<'_> {
    /// Warns of `ln(1 + j)`, whose argument has lost the last digits of j.
    pub(super) fn warn_of_function(&mut self, function: Function, expr: &Expr<'_>, value: ExprId) {
        if function == Function::Ln && self.is_at_rest(value, 1.0) {
            let text = excerpt(expr.original);
            self.cx.warn(expr.original, &message::logarithm(&text));
        }
    }

    /// Warns of `exp(e1) - 1`, and other differences of 1 and a value that is 1 at rest.
    pub(super) fn warn_of_difference(
        &mut self,
        operator: Operator,
        expr: &Expr<'_>,
        [left, right]: [&Expr<'_>; 2],
        values: [ExprId; 2],
    ) {
        if operator != Operator::Subtract {
            return;
        }
        let is_one = |lowering: &Self, value| lowering.constant(value) == Some(1.0);
        let near = if is_one(self, values[1]) && self.is_at_rest(values[0], 1.0) {
            left
        } else if is_one(self, values[0]) && self.is_at_rest(values[1], 1.0) {
            right
        } else {
            return;
        };
        // Not for sums: `(1 + x) - 1` is simplified to `x`.
        let help = match &near.kind {
            ExprKind::Apply(Function::Exp, _) => "write `exp_m1(x)` for `exp(x) - 1`",
            ExprKind::Apply(Function::Cos, _) => "write `2 * sin(x / 2).powi(2)` for `1 - cos(x)`",
            ExprKind::Apply(Function::Cosh, _) => {
                "write `2 * sinh(x / 2).powi(2)` for `cosh(x) - 1`"
            }
            ExprKind::Sqrt(_) => "write `x / (1 + sqrt(1 + x))` for `sqrt(1 + x) - 1`",
            ExprKind::Powi(..) => {
                "write `x * (2 + x)` for `(1 + x).powi(2) - 1`, and `-x / (1 + x)` for `1 / (1 + x) - 1`"
            }
            ExprKind::Powf(..) => "write `exp_m1(p * ln_1p(x))` for `(1 + x).powf(p) - 1`",
            _ => return,
        };
        let text = excerpt(expr.original);
        self.cx
            .warn(expr.original, &message::difference(&text, help));
    }

    /// Whether an expression depends on strains and has this value where they are zero.
    fn is_at_rest(&mut self, value: ExprId, expected: f64) -> bool {
        #[expect(clippy::float_cmp, reason = "1 + 0 is 1")]
        self.at_rest(value)
            .is_some_and(|(.., at_rest)| at_rest == expected)
    }
}
