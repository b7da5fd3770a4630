//! Functions and powers: dimensionless arguments, except where the exponent is known.

use eem_symbolic::Rational;

use super::{Quantity, Rules};
use crate::checked::Expr;
use crate::message::unit::{self as message, Side};
use crate::unit::Unit;
use crate::units::excerpt::excerpt;

impl Rules<'_> {
    /// A root divides the exponents of the unit by its degree, 2 or 3.
    pub(super) fn root(
        &mut self,
        expr: &Expr<'_>,
        inner: &Expr<'_>,
        degree: i128,
    ) -> Option<Quantity> {
        let inner = self.quantity(inner)?;
        let exponent = Rational::new(1, degree)?;
        Some(Quantity {
            unit: self.fits(expr, inner.unit.power(exponent))?,
            value: inner.value.filter(|value| value.is_zero()),
            scaled: inner.scaled,
        })
    }

    /// The argument of a transcendental function is dimensionless.
    pub(super) fn argument(&mut self, function: &str, inner: &Expr<'_>) -> Option<()> {
        let argument = self.quantity(inner)?;
        if argument.is_zero() || self.agree(inner, &argument.unit, &Unit::one())? {
            return Some(());
        }
        let text = excerpt(inner.original);
        let side = Side {
            text: &text,
            unit: &argument.unit,
        };
        let same = argument.unit.coherent().is_one();
        let scale = same.then(|| self.scale_help(argument.scaled)).flatten();
        let help = scale.unwrap_or_else(|| message::divide_by_reference(&side));
        let message = message::function_of_unit(function, &side, help);
        self.cx.error(inner.original, &message);
        None
    }

    /// An exponent is dimensionless. Unless the base is dimensionless, too, the exponent is a known number.
    pub(super) fn power(
        &mut self,
        expr: &Expr<'_>,
        sides: [&Expr<'_>; 2],
        base: &Quantity,
        exponent: &Quantity,
    ) -> Option<Quantity> {
        let text = |side: usize| excerpt(sides[side].original);
        if !self.agree(sides[1], &exponent.unit, &Unit::one())? {
            let side = Side {
                text: &text(1),
                unit: &exponent.unit,
            };
            let message = message::exponent_with_unit(&side);
            self.cx.error(sides[1].original, &message);
            return None;
        }
        if let Some(exponent) = exponent.value {
            let power = |value: Rational| value.checked_powi(exponent.to_i32()?);
            return Some(Quantity {
                unit: self.fits(expr, base.unit.power(exponent))?,
                value: base.value.and_then(power),
                scaled: base.scaled,
            });
        }
        if !self.agree(sides[0], &base.unit, &Unit::one())? {
            let side = Side {
                text: &text(0),
                unit: &base.unit,
            };
            let message = message::power_of_unit(&side, &text(1));
            self.cx.error(sides[0].original, &message);
            return None;
        }
        Some(Quantity::number(None))
    }
}
