//! The rules: what every operation demands of the units of its operands, and the unit it yields.

use eem_symbolic::{Function, Rational};

use super::excerpt::excerpt;
use super::fields::Declaration;
use super::unit::Unit;
use super::unknowns::Unknowns;
use super::{Units, of_role};
use crate::ast::Operator;
use crate::checked::{Body, Checked, Expr, ExprKind};
use crate::ctxt::Ctxt;
use crate::message::unit::{self as message, Side};

/// What is known of an expression.
#[derive(Clone, Debug)]
struct Quantity {
    unit: Unit,
    /// Its value, if it is a number.
    value: Option<Rational>,
}

impl Quantity {
    fn new(unit: Unit) -> Self {
        Self { unit, value: None }
    }

    fn number(value: Option<Rational>) -> Self {
        Self {
            unit: Unit::one(),
            value,
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
    /// The units of fields that have none, as far as the formulas say them.
    pub(super) unknowns: Unknowns,
    /// The bindings of the current body; nothing where an error was reported.
    bindings: Vec<Option<Quantity>>,
}

impl<'r> Rules<'r> {
    pub(super) fn new(cx: &'r Ctxt, checked: &'r Checked<'r>, units: &'r Units) -> Self {
        Self {
            cx,
            checked,
            units,
            unknowns: Unknowns::default(),
            bindings: Vec::new(),
        }
    }

    /// A free energy is in J, a viscosity in N s/m.
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
        let help = if found.unit.coherent() == *wanted {
            message::scales_differ(&found.unit)
        } else {
            message::factor_is_missing("it", wanted, &found.unit)
        };
        let message = message::whole(what, wanted_text, &side, help);
        self.cx.error(body.value.original, &message);
    }

    /// Nothing if something in the expression was reported, here or by another phase.
    fn quantity(&mut self, expr: &Expr<'_>) -> Option<Quantity> {
        match &expr.kind {
            ExprKind::Number(number) => Some(Quantity::number(number.exact())),
            ExprKind::Parameter(field) => match self.units.declarations.get(*field)? {
                Declaration::Unit(unit, _) => Some(Quantity::new(unit.clone())),
                Declaration::Missing => Some(Quantity::new(Unit::unknown(*field))),
                Declaration::Unreadable => None,
            },
            ExprKind::Variable(index) => {
                let role = self.checked.variables.get(*index)?.role;
                Some(Quantity::new(of_role(role)))
            }
            ExprKind::Binding(index) => self.bindings.get(*index)?.clone(),
            ExprKind::Negate(inner) => {
                let Quantity { unit, value } = self.quantity(inner)?;
                let value = value.map(|value| -value);
                Some(Quantity { unit, value })
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
            ExprKind::Sqrt(inner) => self.root(expr, inner, 2),
            ExprKind::Recip(inner) => {
                let one = Quantity::number(Some(Rational::ONE));
                let inner = self.quantity(inner)?;
                self.product(expr, Operator::Divide, &one, &inner)
            }
            ExprKind::Abs(_, inner) => {
                let unit = self.quantity(inner)?.unit;
                Some(Quantity::new(unit))
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
            ExprKind::Diff(inner, variable) => {
                let role = self.checked.variables.get(*variable)?.role;
                let inner = self.quantity(inner)?;
                let unit = self.fits(expr, inner.unit.over(&of_role(role)))?;
                // The derivative of a number is zero.
                let value = inner.value.map(|_| Rational::ZERO);
                Some(Quantity { unit, value })
            }
        }
    }

    /// Both sides of a sum have the same unit.
    fn sum(
        &mut self,
        expr: &Expr<'_>,
        operator: Operator,
        sides: [&Expr<'_>; 2],
        [a, b]: [Quantity; 2],
    ) -> Option<Quantity> {
        let difference = operator == Operator::Subtract;
        let pair = a.value.zip(b.value);
        let value = pair.and_then(|(a, b)| a.checked_add(if difference { -b } else { b }));
        if a.is_zero() || b.is_zero() {
            let unit = if a.is_zero() { b.unit } else { a.unit };
            return Some(Quantity { unit, value });
        }
        if self.agree(expr, &a.unit, &b.unit)? {
            return Some(Quantity {
                unit: a.unit,
                value,
            });
        }
        let texts = sides.map(|side| excerpt(side.original));
        let help = if is_number(sides[1]) {
            message::number_with_unit(&texts[1], &a.unit)
        } else if is_number(sides[0]) {
            message::number_with_unit(&texts[0], &b.unit)
        } else if a.unit.coherent() == b.unit.coherent() {
            let scaled = if b.unit.scale().is_one() {
                &a.unit
            } else {
                &b.unit
            };
            message::scales_differ(scaled)
        } else {
            message::factor_is_missing("the right side", &a.unit, &b.unit)
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

    fn product(
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
        })
    }

    fn root(&mut self, expr: &Expr<'_>, inner: &Expr<'_>, degree: i128) -> Option<Quantity> {
        let Quantity { unit, value } = self.quantity(inner)?;
        let exponent = Rational::new(1, degree)?;
        Some(Quantity {
            unit: self.fits(expr, unit.power(exponent))?,
            value: value.filter(|value| value.is_zero()),
        })
    }

    /// The argument of a transcendental function is a pure number.
    fn argument(&mut self, function: &str, inner: &Expr<'_>) -> Option<()> {
        let argument = self.quantity(inner)?;
        if argument.is_zero() || self.agree(inner, &argument.unit, &Unit::one())? {
            return Some(());
        }
        let text = excerpt(inner.original);
        let side = Side {
            text: &text,
            unit: &argument.unit,
        };
        let help = if argument.unit.coherent().is_one() {
            message::scales_differ(&argument.unit)
        } else {
            message::divide_by_reference(&side)
        };
        let message = message::function_of_unit(function, &side, help);
        self.cx.error(inner.original, &message);
        None
    }

    /// An exponent is a pure number, and one that the compiler knows unless the base is one too.
    fn power(
        &mut self,
        expr: &Expr<'_>,
        sides: [&Expr<'_>; 2],
        base: &Quantity,
        exponent: &Quantity,
    ) -> Option<Quantity> {
        let texts = sides.map(|side| excerpt(side.original));
        if !self.agree(sides[1], &exponent.unit, &Unit::one())? {
            let side = Side {
                text: &texts[1],
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
            });
        }
        if !self.agree(sides[0], &base.unit, &Unit::one())? {
            let side = Side {
                text: &texts[0],
                unit: &base.unit,
            };
            let message = message::power_of_unit(&side, &texts[1]);
            self.cx.error(sides[0].original, &message);
            return None;
        }
        Some(Quantity::number(None))
    }

    /// Whether two units are equal. Where the unit of a field is unknown they are, and this says
    /// something about it; nothing if what it says is not consistent.
    fn agree(&mut self, expr: &Expr<'_>, a: &Unit, b: &Unit) -> Option<bool> {
        if a.first_unknown().or(b.first_unknown()).is_none() {
            return Some(a == b);
        }
        let learned = self.unknowns.equate(a, b);
        self.fits(expr, learned)?;
        let (a, b) = (self.unknowns.resolve(a)?, self.unknowns.resolve(b)?);
        (a == b).then_some(true)
    }

    /// Exponents beyond 128 bits are reported.
    fn fits<T>(&self, expr: &Expr<'_>, unit: Option<T>) -> Option<T> {
        if unit.is_none() {
            self.cx.error(expr.original, &message::beyond_measure());
        }
        unit
    }
}

/// A literal, with or without sign.
fn is_number(expr: &Expr<'_>) -> bool {
    match &expr.kind {
        ExprKind::Number(_) => true,
        ExprKind::Negate(inner) => is_number(inner),
        _ => false,
    }
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
