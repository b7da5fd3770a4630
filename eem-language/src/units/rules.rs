//! The rules: what every operation demands of the units of its operands, and the unit it yields.

mod function;
mod sum;

use eem_symbolic::{Function, Rational};

use super::declaration::Declaration;
use super::declared::Units;
use super::excerpt::excerpt;
use super::quantities::Quantities;
use super::unknowns::Unknowns;
use crate::ast::Operator;
use crate::checked::{Body, Checked, Expr, ExprKind, Origin};
use crate::ctxt::Ctxt;
use crate::message::unit::{self as message, Side};
use crate::unit::Unit;

/// The unit of an expression, and what else is known of it.
#[derive(Clone, Debug)]
struct Quantity {
    unit: Unit,
    /// Its value, if it is a number.
    value: Option<Rational>,
    /// The first parameter in it that has a scale: a message about different scales names it.
    scaled: Option<Origin>,
}

impl Quantity {
    fn new(unit: Unit) -> Self {
        Self {
            unit,
            value: None,
            scaled: None,
        }
    }

    fn number(value: Option<Rational>) -> Self {
        Self {
            value,
            ..Self::new(Unit::one())
        }
    }

    /// Zero has any unit.
    fn is_zero(&self) -> bool {
        self.value.is_some_and(Rational::is_zero)
    }
}

/// Walks the bodies of a model.
pub(super) struct Rules<'r> {
    cx: &'r Ctxt,
    checked: &'r Checked<'r>,
    units: &'r Units,
    /// The units of what the model computes.
    pub(super) quantities: &'static Quantities,
    /// The units of fields that declare none, as far as the formulas determine them.
    pub(super) unknowns: Unknowns,
    /// The bindings of the current body; `None` where an error was reported.
    bindings: Vec<Option<Quantity>>,
}

impl<'r> Rules<'r> {
    pub(super) fn new(cx: &'r Ctxt, checked: &'r Checked<'r>, units: &'r Units) -> Self {
        Self {
            cx,
            checked,
            units,
            quantities: Quantities::of(checked.per_volume()),
            unknowns: Unknowns::default(),
            bindings: Vec::new(),
        }
    }

    /// Reports a body that does not have the wanted unit; the free energy of a spring, for example, is in J.
    pub(super) fn body(&mut self, what: &str, wanted_text: &str, wanted: &Unit, body: &Body<'_>) {
        self.bindings.clear();
        for binding in &body.bindings {
            let quantity = self.quantity(binding);
            self.bindings.push(quantity);
        }
        let Some(found) = self.quantity(&body.value) else {
            return;
        };
        if found.is_zero() || self.agree(&body.value, &found.unit, wanted) != Some(false) {
            return;
        }
        let text = excerpt(body.value.original);
        let side = Side {
            text: &text,
            unit: &found.unit,
        };
        let same = found.unit.coherent() == *wanted;
        let scale = same.then(|| self.scale_help(found.scaled)).flatten();
        let help = scale.unwrap_or_else(|| message::factor_is_missing("it", wanted, &found.unit));
        let message = message::wrong_result(what, wanted_text, &side, help);
        self.cx.error(body.value.original, &message);
    }

    /// `None` if something in the expression has been reported, here or by another phase.
    fn quantity(&mut self, expr: &Expr<'_>) -> Option<Quantity> {
        match &expr.kind {
            ExprKind::Number(number) => Some(Quantity::number(number.exact())),
            ExprKind::Parameter(origin) => self.parameter(*origin),
            ExprKind::Variable(index) => {
                let role = self.checked.variables.get(*index)?.role;
                Some(Quantity::new(self.quantities.of_role(role)))
            }
            ExprKind::Binding(index) => self.bindings.get(*index)?.clone(),
            ExprKind::Negate(inner) => {
                let inner = self.quantity(inner)?;
                let value = inner.value.map(|value| -value);
                Some(Quantity { value, ..inner })
            }
            ExprKind::Binary(operator, left, right) => {
                let (a, b) = (self.quantity(left), self.quantity(right));
                match operator {
                    Operator::Add | Operator::Subtract => {
                        self.sum(expr, *operator, [left, right], [a?, b?])
                    }
                    Operator::Multiply | Operator::Divide => {
                        self.product(expr, *operator, &a?, &b?)
                    }
                }
            }
            ExprKind::InCall(call, inner) => {
                self.cx.enter(excerpt(call));
                let quantity = self.quantity(inner);
                self.cx.leave();
                quantity
            }
            ExprKind::Wrong(parts) => {
                for part in parts {
                    self.quantity(part);
                }
                None
            }
            ExprKind::Sqrt(inner) => self.root(expr, inner, 2),
            ExprKind::Recip(inner) => {
                let one = Quantity::number(Some(Rational::ONE));
                let inner = self.quantity(inner)?;
                self.product(expr, Operator::Divide, &one, &inner)
            }
            ExprKind::Abs(_, inner) => {
                let inner = self.quantity(inner)?;
                let value = inner.value.map(|value| value.max(-value));
                Some(Quantity { value, ..inner })
            }
            ExprKind::Apply(Function::Cbrt, inner) => self.root(expr, inner, 3),
            ExprKind::Apply(function, inner) => {
                self.argument(function.name(), inner);
                Some(Quantity::number(None))
            }
            ExprKind::Powi(base, exponent) | ExprKind::Powf(base, exponent) => {
                let (b, e) = (self.quantity(base), self.quantity(exponent));
                self.power(expr, [base, exponent], &b?, &e?)
            }
            ExprKind::Diff(inner, variable) => self.derivative(expr, inner, *variable),
        }
    }

    fn parameter(&self, origin: Origin) -> Option<Quantity> {
        let Some(declaration) = self.units.declaration(origin) else {
            // A constant without a declared unit is dimensionless.
            return Some(Quantity::number(None));
        };
        match declaration {
            Declaration::Unit(unit, _) => Some(Quantity {
                scaled: (!unit.scale().is_one()).then_some(origin),
                ..Quantity::new(unit.clone())
            }),
            Declaration::Missing => Some(Quantity::new(Unit::unknown(origin.field()?))),
            Declaration::Unreadable => None,
        }
    }

    /// `diff(inner, variable)`
    fn derivative(
        &mut self,
        expr: &Expr<'_>,
        inner: &Expr<'_>,
        variable: usize,
    ) -> Option<Quantity> {
        let role = self.checked.variables.get(variable)?.role;
        let inner = self.quantity(inner)?;
        let unit = self.fits(expr, inner.unit.over(&self.quantities.of_role(role)))?;
        // The derivative of a number is zero.
        let value = inner.value.map(|_| Rational::ZERO);
        let scaled = inner.scaled;
        Some(Quantity {
            unit,
            value,
            scaled,
        })
    }

    /// Whether two units are equal. Unknown units of fields are chosen such that they are; `None` if
    /// that contradicts what has been chosen before.
    fn agree(&mut self, expr: &Expr<'_>, a: &Unit, b: &Unit) -> Option<bool> {
        if a.first_unknown().or(b.first_unknown()).is_none() {
            return Some(a == b);
        }
        let learned = self.unknowns.equate(a, b);
        self.fits(expr, learned)?;
        let (a, b) = (self.unknowns.resolve(a)?, self.unknowns.resolve(b)?);
        (a == b).then_some(true)
    }

    /// Help where units differ by a factor only: it names the parameter whose unit has the factor.
    fn scale_help(&self, scaled: Option<Origin>) -> Option<String> {
        let mut parameters = self.checked.parameters.iter();
        let parameter = parameters.find(|parameter| Some(parameter.origin) == scaled)?;
        match self.units.declaration(parameter.origin)? {
            Declaration::Unit(unit, _) => Some(message::field_with_scale(&parameter.name, unit)),
            Declaration::Missing | Declaration::Unreadable => None,
        }
    }

    /// Reports a unit whose exponents do not fit 128 bits.
    fn fits<T>(&self, expr: &Expr<'_>, unit: Option<T>) -> Option<T> {
        if unit.is_none() {
            self.cx.error(expr.original, &message::beyond_measure());
        }
        unit
    }
}
