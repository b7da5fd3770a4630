//! Sums and products: sums need equal units, products multiply them.

use eem_symbolic::Rational;

use super::{Quantity, Rules};
use crate::ast::Operator;
use crate::checked::{Expr, ExprKind};
use crate::message::unit::{self as message, Side};
use crate::units::excerpt::excerpt;

impl Rules<'_> {
    /// Both sides of a sum have the same unit.
    pub(super) fn sum(
        &mut self,
        expr: &Expr<'_>,
        operator: Operator,
        sides: [&Expr<'_>; 2],
        [a, b]: [Quantity; 2],
    ) -> Option<Quantity> {
        let difference = operator == Operator::Subtract;
        let pair = a.value.zip(b.value);
        let value = pair.and_then(|(a, b)| a.checked_add(if difference { -b } else { b }));
        let any = a.is_zero() || b.is_zero();
        if any || self.agree(expr, &a.unit, &b.unit)? {
            return Some(Quantity {
                scaled: a.scaled.or(b.scaled),
                unit: if a.is_zero() { b.unit } else { a.unit },
                value,
            });
        }
        let texts = sides.map(|side| excerpt(side.original));
        let help = if is_number(sides[1], &b) {
            message::number_with_unit(&texts[1], &a.unit)
        } else if is_number(sides[0], &a) {
            message::number_with_unit(&texts[0], &b.unit)
        } else {
            let same = a.unit.coherent() == b.unit.coherent();
            let scaled = if b.unit.scale().is_one() {
                a.scaled
            } else {
                b.scaled
            };
            let scale = same.then(|| self.scale_help(scaled)).flatten();
            let factor = || message::factor_is_missing("the right side", &a.unit, &b.unit);
            scale.unwrap_or_else(factor).into()
        };
        let [left, right] = [(&texts[0], &a.unit), (&texts[1], &b.unit)];
        let [left, right] = [left, right].map(|(text, unit)| Side { text, unit });
        let message = message::sum(difference, &left, &right, help);
        match operator_token(expr.original) {
            Some(operator) => self.cx.error(operator, &message),
            None => self.cx.error(expr.original, &message),
        }
        None
    }

    /// A product multiplies units, and is zero if a factor is.
    pub(super) fn product(
        &self,
        expr: &Expr<'_>,
        operator: Operator,
        a: &Quantity,
        b: &Quantity,
    ) -> Option<Quantity> {
        let pair = a.value.zip(b.value);
        let (unit, value) = if operator == Operator::Divide {
            let value = pair.and_then(|(a, b)| a.checked_div(b));
            (a.unit.over(&b.unit), value)
        } else {
            let value = pair.and_then(|(a, b)| a.checked_mul(b));
            (a.unit.times(&b.unit), value)
        };
        let zero = a.is_zero() || (b.is_zero() && operator != Operator::Divide);
        Some(Quantity {
            unit: self.fits(expr, unit)?,
            value: if zero { Some(Rational::ZERO) } else { value },
            scaled: a.scaled.or(b.scaled),
        })
    }
}

/// Whether an expression is a number: a computed rational, or any number that is written.
fn is_number(expr: &Expr<'_>, quantity: &Quantity) -> bool {
    let mut expr = expr;
    while let ExprKind::Negate(inner) = &expr.kind {
        expr = inner;
    }
    quantity.value.is_some() || matches!(expr.kind, ExprKind::Number(_))
}

/// The operator of a sum, without the parentheses around it.
fn operator_token(expr: &syn::Expr) -> Option<&syn::BinOp> {
    match expr {
        syn::Expr::Binary(binary) => Some(&binary.op),
        syn::Expr::Paren(paren) => operator_token(&paren.expr),
        syn::Expr::Group(group) => operator_token(&group.expr),
        _ => None,
    }
}
