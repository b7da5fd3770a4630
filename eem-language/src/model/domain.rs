//! Domains: reports a subexpression that has no value, whatever the parameters and the state are.
//!
//! Constants are judged by their value, other expressions by their sign, given that lengths and
//! temperatures are positive and strains above their bounds. The base of a power has to be in its
//! domain in every state. Solids at rest are checked in `rest`.

use eem_symbolic::{ExprId, F64, Function, LowerBound, Rational, Sign, range, schedule, sign};

use super::Lowering;
use crate::ast::{Joint, Role, Strain};
use crate::checked::Expr;
use crate::message::expression as message;
use crate::units::excerpt;

impl Lowering<'_> {
    /// Reports a constant that is not finite, such as `exp(1000)`.
    pub(super) fn check_size(&self, expr: &Expr<'_>, value: ExprId) -> Option<ExprId> {
        let infinite = self.constant(value).is_some_and(|c| !c.is_finite());
        self.unless(infinite, expr, &message::constant_too_large)?;
        Some(value)
    }

    /// Reports a divisor that is identically zero, or so small that its inverse overflows.
    pub(super) fn check_divisor(&mut self, expr: &Expr<'_>, value: ExprId) -> Option<()> {
        let zero = self.constant(value).is_some_and(|c| !c.recip().is_finite());
        self.unless(zero, expr, &message::divisor_is_zero)?;
        self.check_divisor_at_rest(expr, value)
    }

    /// Checks `√x`: x ≥ 0.
    pub(super) fn check_root(&self, expr: &Expr<'_>, value: ExprId) -> Option<()> {
        let sign = self.sign(value);
        let outside = !sign.zero && !sign.positive;
        self.unless(outside, expr, &|| {
            message::outside_domain("sqrt", "negative", "x >= 0")
        })
    }

    /// Checks `x^y`: x > 0, unless y is an integer. A base whose sign can change with the state is
    /// refused: the first step with a negative base would be NaN.
    pub(super) fn check_base(
        &mut self,
        expr: &Expr<'_>,
        base: ExprId,
        exponent: ExprId,
    ) -> Option<()> {
        let exponent = self.constant(exponent);
        if exponent.is_some_and(|y| y < 0.0) {
            self.check_divisor(expr, base)?;
        }
        let integer = exponent.is_some_and(|y| y.fract() == 0.0);
        let sign = self.sign(base);
        let outside = !integer && !sign.zero && !sign.positive;
        self.unless(outside, expr, &message::negative_base)?;
        let any = self.symbols(|role| match role {
            Role::Viscous | Role::Joint(Joint::Trace | Joint::Strain) => true,
            Role::Stretch | Role::Strain(_) | Role::Joint(Joint::Square) | Role::Temperature => {
                false
            }
        });
        let negative = range(&self.graph, base, &self.bounds(), &any).lower < 0.0;
        if self.argument_in(base).is_none() {
            return Some(());
        }
        let smooth = self.is_smooth_power(base, exponent);
        self.unless(!integer && negative, expr, &|| {
            message::base_can_be_negative(&excerpt(expr.original), exponent, smooth)
        })?;
        match exponent {
            Some(y) if !integer => self.check_power_at_rest("powf", y, expr, base),
            _ => Some(()),
        }
    }

    /// Checks the argument of a function that is not defined everywhere.
    pub(super) fn check_argument(
        &mut self,
        function: Function,
        expr: &Expr<'_>,
        value: ExprId,
    ) -> Option<()> {
        let constant = self.constant(value);
        let (outside, what, domain) = match function {
            Function::Ln | Function::Log2 | Function::Log10 => {
                (!self.sign(value).positive, "never positive", "x > 0")
            }
            Function::Ln1p => (
                constant.is_some_and(|c| c <= -1.0),
                "not above -1",
                "x > -1",
            ),
            Function::Atanh => (
                constant.is_some_and(|c| c.abs() >= 1.0),
                "not between -1 and 1",
                "-1 < x < 1",
            ),
            Function::Cbrt => return self.check_power_at_rest("cbrt", 1.0 / 3.0, expr, value),
            Function::Exp
            | Function::ExpM1
            | Function::Sin
            | Function::Cos
            | Function::Tan
            | Function::Sinh
            | Function::Cosh
            | Function::Tanh
            | Function::Asinh
            | Function::Atan
            | Function::Abs => return Some(()),
        };
        self.unless(outside, expr, &|| {
            message::outside_domain(function.name(), what, domain)
        })?;
        self.check_value_at_rest(function, domain, expr, value)
    }

    pub(super) fn unless(
        &self,
        wrong: bool,
        expr: &Expr<'_>,
        message: &dyn Fn() -> crate::message::Message,
    ) -> Option<()> {
        if wrong {
            self.cx.error(expr.original, &message());
            return None;
        }
        Some(())
    }

    /// The value of an expression, if there are no symbols in it.
    pub(super) fn constant(&self, e: ExprId) -> Option<f64> {
        if let Some(number) = self.graph.as_number(e) {
            return Some(number.to_f64());
        }
        let mut symbols = self.variables.iter().chain(&self.parameters);
        if symbols.any(|&symbol| self.graph.depends_on(e, symbol)) {
            return None;
        }
        let program = schedule(&self.graph, Vec::new(), &[e]);
        program.interpret(&F64, &[]).first().copied()
    }

    /// The signs of an expression, given that lengths and temperatures are positive and strains above
    /// their bounds.
    pub(super) fn sign(&self, e: ExprId) -> Sign {
        if let Some(constant) = self.constant(e) {
            return Sign {
                negative: constant < 0.0,
                zero: constant == 0.0,
                positive: constant > 0.0,
            };
        }
        sign(&self.graph, e, &self.bounds())
    }

    /// Lower bounds of lengths, strains and temperature.
    fn bounds(&self) -> Vec<LowerBound> {
        let positive = self.symbols(|role| matches!(role, Role::Stretch | Role::Temperature));
        let positive = positive.into_iter().map(LowerBound::positive);
        positive.chain(self.strains()).collect()
    }

    /// Lower bounds of strains.
    pub(super) fn strains(&self) -> Vec<LowerBound> {
        let pairs = self.checked.variables.iter().zip(&self.variables);
        let bounds = pairs.filter_map(|(variable, &symbol)| {
            let zero = Rational::ZERO;
            if variable.role == Role::Joint(Joint::Square) {
                return Some(LowerBound::from(symbol, zero));
            }
            Some(match variable.role.strain()? {
                // (tr C − 3)/2 and det F − 1, where tr C and det F are positive.
                Strain::Trace => LowerBound::above(symbol, Rational::new(-3, 2)?),
                Strain::Square => LowerBound::from(symbol, zero),
                Strain::Dilatation => LowerBound::above(symbol, Rational::MINUS_ONE),
                // (|F a|² − 1)/2
                Strain::Fibre => LowerBound::above(symbol, Rational::new(-1, 2)?),
            })
        });
        bounds.collect()
    }
}
