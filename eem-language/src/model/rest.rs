//! The solid at rest, where all strains, also viscous ones, are zero: a free energy has a value and a stress there.

use eem_symbolic::{ExprId, Function, substitute};

use super::Lowering;
use crate::ast::{self, Role};
use crate::checked::Expr;
use crate::message::expression::rest as message;
use crate::units::excerpt;

/// From here on a power of something that is zero has two derivatives.
const SMOOTH: f64 = 2.0;

impl Lowering<'_> {
    /// Whether `(x²)^(y/2)` is known to have two derivatives wherever x may be, for the base x.
    pub(super) fn is_smooth_power(&mut self, base: ExprId, exponent: Option<f64>) -> bool {
        let at_rest = self.at_rest(base);
        exponent.is_some_and(|y| 0.5 * y >= SMOOTH)
            || at_rest.is_some_and(|(_, _, at_rest)| at_rest != 0.0)
    }

    /// `1/j`
    pub(super) fn check_divisor_at_rest(&mut self, expr: &Expr<'_>, value: ExprId) -> Option<()> {
        let Some((name, strain, at_rest)) = self.at_rest(value) else {
            return Some(());
        };
        let zero = !at_rest.recip().is_finite();
        self.unless(zero, expr, &|| message::divisor(&name, strain))
    }

    /// `√e2`, whose slope is infinite, and other powers below 2, whose curvature is.
    pub(super) fn check_power_at_rest(
        &mut self,
        function: &str,
        exponent: f64,
        expr: &Expr<'_>,
        base: ExprId,
    ) -> Option<()> {
        let Some((_, _, at_rest)) = self.at_rest(base) else {
            return Some(());
        };
        let singular = at_rest == 0.0 && exponent < SMOOTH;
        let signed = self.sign(base).negative;
        self.unless(singular, expr, &|| {
            message::power(function, exponent, &excerpt(expr.original), signed)
        })?;
        let negative = at_rest < 0.0 && function != Function::Cbrt.name();
        self.unless(negative, expr, &|| message::negative(function))
    }

    /// `ln(j)`
    pub(super) fn check_value_at_rest(
        &mut self,
        function: Function,
        domain: &str,
        expr: &Expr<'_>,
        value: ExprId,
    ) -> Option<()> {
        let Some((name, strain, at_rest)) = self.at_rest(value) else {
            return Some(());
        };
        let outside = match function {
            Function::Ln1p => at_rest <= -1.0,
            Function::Atanh => at_rest.abs() >= 1.0,
            _ => at_rest <= 0.0,
        };
        self.unless(outside, expr, &|| {
            message::value(function.name(), domain, &name, strain)
        })
    }

    /// The first strain in an expression, and what is left of the expression without strains if that is
    /// a number.
    pub(super) fn at_rest(&mut self, e: ExprId) -> Option<(String, Role, f64)> {
        let pairs = self.checked.variables.iter().zip(&self.variables);
        let strains = pairs.filter(|(variable, _)| variable.role.is_of_solid());
        let strains: Vec<_> = strains
            .filter(|&(_, &symbol)| self.graph.depends_on(e, symbol))
            .collect();
        let (first, _) = strains.first()?;
        let (name, strain) = (ast::name(first.ident), first.role);
        let zero = self.graph.integer(0);
        let zeros: Vec<_> = strains.iter().map(|&(_, &symbol)| (symbol, zero)).collect();
        let rest = substitute(&mut self.graph, e, &zeros);
        Some((name, strain, self.constant(rest)?))
    }
}
