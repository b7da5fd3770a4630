//! Model phase: [`checked`](crate::checked) → [`eem_symbolic::Model`].
//!
//! A fold that calls one constructor of the graph per node. It reports errors that show only once the
//! expressions exist: in exponents, dependences and domains.

mod digits;
mod domain;
mod rest;
mod smooth;

use eem_symbolic::{ExprId, Graph, Model, Number, Symbol, diff};

use crate::ast::{self, Operator, Role};
use crate::checked::{Body, Checked, Expr, ExprKind};
use crate::ctxt::Ctxt;
use crate::message::expression as message;
use crate::units::excerpt;

/// Builds the model. `None` only if an error was reported, here or before.
pub(crate) fn lower(cx: &Ctxt, checked: &Checked<'_>) -> Option<Model> {
    let mut graph = Graph::new();
    let variables = checked.variables.iter();
    let variables: Vec<Symbol> = variables
        .map(|v| graph.symbol(&ast::name(v.ident)))
        .collect();
    let parameters = checked.parameters.iter();
    let parameters: Vec<Symbol> = parameters.map(|p| graph.symbol(&p.name)).collect();
    let mut lowering = Lowering {
        cx,
        checked,
        graph,
        variables,
        parameters,
        bindings: Vec::new(),
    };
    let psi = lowering.body(&checked.energy);
    let laws = checked.viscosities.iter();
    let viscosities = laws.map(|law| lowering.body(law.as_ref()?));
    let viscosities: Vec<Option<ExprId>> = viscosities.collect();
    let drag = checked.drag.as_ref().map(|law| lowering.body(law));
    Some(Model {
        measures: lowering.symbols(Role::is_measure),
        strains: lowering.strains(),
        dashpots: lowering.symbols(|role| role == Role::Viscous),
        temperature: lowering.symbols(|role| role == Role::Temperature).pop(),
        parameters: lowering.parameters,
        graph: lowering.graph,
        psi: psi?,
        viscosities: viscosities.into_iter().collect::<Option<_>>()?,
        drag: match drag {
            Some(law) => Some(law?),
            None => None,
        },
    })
}

struct Lowering<'l> {
    cx: &'l Ctxt,
    checked: &'l Checked<'l>,
    graph: Graph,
    /// Symbols of [`Checked::variables`].
    variables: Vec<Symbol>,
    /// Symbols of [`Checked::parameters`].
    parameters: Vec<Symbol>,
    /// Values of the bindings of the current body; `None` where an error was reported.
    bindings: Vec<Option<ExprId>>,
}

impl Lowering<'_> {
    /// The variables of the roles that are `wanted`.
    fn symbols(&self, wanted: impl Fn(Role) -> bool) -> Vec<Symbol> {
        let pairs = self.checked.variables.iter().zip(&self.variables);
        let pairs = pairs.filter(|(variable, _)| wanted(variable.role));
        pairs.map(|(_, &symbol)| symbol).collect()
    }

    fn body(&mut self, body: &Body<'_>) -> Option<ExprId> {
        self.bindings.clear();
        for binding in &body.bindings {
            let value = self.expr(binding);
            self.bindings.push(value);
        }
        self.expr(&body.value)
    }

    /// The expression in the graph; `None` if an error in it was reported.
    fn expr(&mut self, expr: &Expr<'_>) -> Option<ExprId> {
        let value = self.value(expr)?;
        self.check_size(expr, value)
    }

    fn value(&mut self, expr: &Expr<'_>) -> Option<ExprId> {
        Some(match &expr.kind {
            ExprKind::Number(number) => self.graph.number(*number),
            ExprKind::Parameter(origin) => {
                let mut parameters = self.checked.parameters.iter();
                let index = parameters.position(|parameter| parameter.origin == *origin)?;
                self.graph.variable(self.parameters[index])
            }
            ExprKind::Variable(index) => self.graph.variable(self.variables[*index]),
            ExprKind::Binding(index) => self.bindings[*index]?,
            ExprKind::Negate(inner) => {
                let inner = self.expr(inner)?;
                self.graph.neg(inner)
            }
            ExprKind::Binary(operator, left, right) => {
                self.binary(*operator, expr, [left, right])?
            }
            ExprKind::Sqrt(inner) => {
                let value = self.expr(inner)?;
                self.check_root(inner, value)?;
                self.check_square(inner, value)?;
                self.check_power_at_rest("sqrt", 0.5, inner, value)?;
                self.graph.sqrt(value)
            }
            ExprKind::Recip(inner) => {
                let value = self.expr(inner)?;
                self.check_divisor(inner, value)?;
                self.graph.recip(value)
            }
            ExprKind::Abs(token, inner) => self.abs(token, inner)?,
            ExprKind::Apply(function, inner) => {
                let value = self.expr(inner)?;
                self.check_argument(*function, inner, value)?;
                self.warn_of_function(*function, expr, value);
                self.graph.apply(*function, value)
            }
            ExprKind::Powi(base, exponent) => self.powi(base, exponent)?,
            ExprKind::Powf(base, exponent) => {
                let (value, exponent) = (self.expr(base), self.expr(exponent));
                let (value, exponent) = (value?, exponent?);
                self.check_base(base, value, exponent)?;
                if self.graph.as_number(exponent) == Some(Number::HALF) {
                    self.check_square(base, value)?;
                }
                self.graph.power(value, exponent)
            }
            ExprKind::Diff(inner, variable) => {
                let value = self.expr(inner)?;
                self.check_derivative(inner, value)?;
                diff(&mut self.graph, value, self.variables[*variable])
            }
            ExprKind::InCall(call, inner) => self.in_call(call, inner)?,
            ExprKind::Wrong(parts) => {
                for part in parts {
                    self.expr(part);
                }
                return None;
            }
        })
    }

    /// The value of a call of a helper; errors in it name the call.
    fn in_call(&mut self, call: &syn::Expr, inner: &Expr<'_>) -> Option<ExprId> {
        self.cx.enter(excerpt(call));
        let value = self.expr(inner);
        self.cx.leave();
        value
    }

    fn binary(
        &mut self,
        operator: Operator,
        expr: &Expr<'_>,
        operands: [&Expr<'_>; 2],
    ) -> Option<ExprId> {
        let [_, divisor] = operands;
        let [left, right] = operands.map(|operand| self.expr(operand));
        if let (Operator::Divide, Some(right)) = (operator, right) {
            self.check_divisor(divisor, right)?;
        }
        let (left, right) = (left?, right?);
        self.warn_of_difference(operator, expr, operands, [left, right]);
        Some(match operator {
            Operator::Add => self.graph.add(left, right),
            Operator::Subtract => self.graph.sub(left, right),
            Operator::Multiply => self.graph.mul(left, right),
            Operator::Divide => self.graph.div(left, right),
        })
    }

    fn powi(&mut self, base: &Expr<'_>, exponent: &Expr<'_>) -> Option<ExprId> {
        let (value, power) = (self.expr(base), self.expr(exponent));
        let integer = match self.graph.as_number(power?) {
            Some(Number::Exact(power)) if power.is_integer() => Ok(power.to_i32()),
            Some(Number::Exact(_) | Number::Float(_)) | None => Err(()),
        };
        let n = match integer {
            Ok(Some(n)) => n,
            Ok(None) => {
                let message = message::exponent_is_too_large();
                self.cx.error(exponent.original, &message);
                return None;
            }
            Err(()) => {
                let message = message::exponent_is_not_an_integer();
                self.cx.error(exponent.original, &message);
                return None;
            }
        };
        if n < 0 {
            self.check_divisor(base, value?)?;
        }
        Some(self.graph.powi(value?, n))
    }
}
