//! Model phase: [`checked`](crate::checked) → [`eem_symbolic::Model`].
//!
//! A fold that calls one constructor of the graph per node. What can be wrong here shows only once
//! the expressions exist: exponents, dependences and values of constants.

use eem_symbolic::{ExprId, F64, Graph, Model, Number, Symbol, diff, schedule};

use crate::ast::{self, Operator, Role};
use crate::checked::{Body, Checked, Expr, ExprKind};
use crate::ctxt::Ctxt;
use crate::message::expression as message;

/// Builds the model. Nothing only if something was reported.
pub(crate) fn lower(cx: &Ctxt, checked: &Checked<'_>) -> Option<Model> {
    let mut graph = Graph::new();
    let variables = checked.variables.iter();
    let variables: Vec<Symbol> = variables
        .map(|v| graph.symbol(&ast::name(v.ident)))
        .collect();
    let parameters = checked.parameters.iter();
    let parameters: Vec<Symbol> = parameters
        .map(|p| graph.symbol(&ast::name(p.ident)))
        .collect();
    let mut lowering = Lowering {
        cx,
        checked,
        graph,
        variables,
        parameters,
        bindings: Vec::new(),
    };
    let psi = lowering.body(&checked.energy);
    let viscosities = checked.viscosities.iter().map(|law| lowering.body(law));
    let viscosities: Vec<Option<ExprId>> = viscosities.collect();
    Some(Model {
        measures: lowering.of_role(Role::Stretch),
        dashpots: lowering.of_role(Role::Viscous),
        temperature: lowering.of_role(Role::Temperature).first().copied(),
        parameters: lowering.parameters,
        graph: lowering.graph,
        psi: psi?,
        viscosities: viscosities.into_iter().collect::<Option<_>>()?,
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
    /// Values of the bindings of the current body; nothing where an error was reported.
    bindings: Vec<Option<ExprId>>,
}

impl Lowering<'_> {
    fn of_role(&self, role: Role) -> Vec<Symbol> {
        let pairs = self.checked.variables.iter().zip(&self.variables);
        let of_role = pairs.filter(|(variable, _)| variable.role == role);
        of_role.map(|(_, &symbol)| symbol).collect()
    }

    fn body(&mut self, body: &Body<'_>) -> Option<ExprId> {
        self.bindings.clear();
        for binding in &body.bindings {
            let value = self.expr(binding);
            self.bindings.push(value);
        }
        self.expr(&body.value)
    }

    fn expr(&mut self, expr: &Expr<'_>) -> Option<ExprId> {
        let value = self.value(expr)?;
        self.check_finite(expr, value)
    }

    /// A constant outside of the domain of a function has no value: `ln(-1)`, `1 / 0`.
    fn check_finite(&self, expr: &Expr<'_>, value: ExprId) -> Option<ExprId> {
        if self
            .constant(value)
            .is_some_and(|constant| !constant.is_finite())
        {
            self.cx.error(expr.original, &message::not_finite());
            return None;
        }
        Some(value)
    }

    fn check_divisor(&self, expr: &Expr<'_>, value: ExprId) -> Option<ExprId> {
        if self
            .constant(value)
            .is_some_and(|constant| !constant.recip().is_finite())
        {
            self.cx.error(expr.original, &message::divisor_is_zero());
            return None;
        }
        Some(value)
    }

    /// The value of an expression, if there are no symbols in it.
    fn constant(&self, e: ExprId) -> Option<f64> {
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

    fn value(&mut self, expr: &Expr<'_>) -> Option<ExprId> {
        Some(match &expr.kind {
            ExprKind::Number(number) => self.graph.number(*number),
            ExprKind::Parameter(field) => {
                let mut parameters = self.checked.parameters.iter();
                let index = parameters.position(|parameter| parameter.field == *field)?;
                self.graph.variable(self.parameters[index])
            }
            ExprKind::Variable(index) => self.graph.variable(self.variables[*index]),
            ExprKind::Binding(index) => self.bindings[*index]?,
            ExprKind::Negate(inner) => {
                let inner = self.expr(inner)?;
                self.graph.neg(inner)
            }
            ExprKind::Binary(operator, left, right) => self.binary(*operator, left, right)?,
            ExprKind::Sqrt(inner) => {
                let inner = self.expr(inner)?;
                self.graph.sqrt(inner)
            }
            ExprKind::Recip(inner) => {
                let inner = self.expr(inner)?;
                self.graph.recip(inner)
            }
            ExprKind::Abs(token, inner) => self.abs(token, inner)?,
            ExprKind::Apply(function, inner) => {
                let inner = self.expr(inner)?;
                self.graph.apply(*function, inner)
            }
            ExprKind::Powi(base, exponent) => self.powi(base, exponent)?,
            ExprKind::Powf(base, exponent) => {
                let (base, exponent) = (self.expr(base), self.expr(exponent));
                self.graph.power(base?, exponent?)
            }
            ExprKind::Diff(inner, variable) => {
                let inner = self.expr(inner)?;
                diff(&mut self.graph, inner, self.variables[*variable])
            }
        })
    }

    fn binary(&mut self, operator: Operator, left: &Expr<'_>, right: &Expr<'_>) -> Option<ExprId> {
        let divisor = right;
        let (left, right) = (self.expr(left), self.expr(right));
        let (left, right) = (left?, right?);
        if operator == Operator::Divide {
            self.check_divisor(divisor, right)?;
        }
        Some(match operator {
            Operator::Add => self.graph.add(left, right),
            Operator::Subtract => self.graph.sub(left, right),
            Operator::Multiply => self.graph.mul(left, right),
            Operator::Divide => self.graph.div(left, right),
        })
    }

    /// |x| has no derivative at zero, so that only parameters may be inside.
    fn abs(&mut self, token: &syn::Ident, inner: &Expr<'_>) -> Option<ExprId> {
        let inner = self.expr(inner)?;
        for (variable, &symbol) in self.checked.variables.iter().zip(&self.variables) {
            if self.graph.depends_on(inner, symbol) {
                let name = ast::name(variable.ident);
                self.cx.error(token, &message::abs_of_state(&name));
                return None;
            }
        }
        Some(self.graph.apply(eem_symbolic::Function::Abs, inner))
    }

    fn powi(&mut self, base: &Expr<'_>, exponent: &Expr<'_>) -> Option<ExprId> {
        let (base, value) = (self.expr(base), self.expr(exponent));
        let (base, value) = (base?, value?);
        let integer = match self.graph.as_number(value) {
            Some(Number::Exact(rational)) => rational.to_i32(),
            Some(Number::Float(_)) | None => None,
        };
        if integer.is_none() {
            let message = message::exponent_is_not_an_integer();
            self.cx.error(exponent.original, &message);
        }
        Some(self.graph.powi(base, integer?))
    }
}
