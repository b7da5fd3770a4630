//! The solid at rest, where all strains, also viscous ones, are zero: a free energy must have a value and a stress there.

use eem_symbolic::{ExprId, Function, substitute};

use super::Lowering;
use crate::ast::{self, Role};
use crate::checked::Expr;
use crate::message::expression::rest as message;
use crate::units::excerpt;

/// The smallest exponent with which a power has two derivatives where its base is zero.
const SMOOTH: f64 = 2.0;

impl Lowering<'_> {
    /// Whether `(x²)^(y/2)` is known to have two derivatives wherever x may be, for the base x.
    pub(super) fn is_smooth_power(&mut self, base: ExprId, exponent: Option<f64>) -> bool {
        let at_rest = self.at_rest(base);
        exponent.is_some_and(|y| 0.5 * y >= SMOOTH)
            || at_rest.is_some_and(|(_, _, at_rest)| at_rest != 0.0)
    }

    /// Reports a divisor that is zero at rest, as in `1/j`.
    pub(super) fn check_divisor_at_rest(&mut self, expr: &Expr<'_>, value: ExprId) -> Option<()> {
        let Some((name, strain, at_rest)) = self.at_rest(value) else {
            return Some(());
        };
        let zero = !at_rest.recip().is_finite();
        self.unless(zero, expr, &|| message::divisor(&name, strain))
    }

    /// Reports powers that are singular at rest: `√e2` has an infinite slope there, other powers below 2 an infinite
    /// curvature, and powers of negative numbers have no value.
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

    /// Reports a function whose argument is outside its domain at rest, as in `ln(j)`.
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

    /// Name and role of the first strain in an expression, and the value of the expression at rest, if that
    /// is a number.
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
