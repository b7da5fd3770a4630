//! Resolves the names of an expression and flattens its blocks.

use proc_macro2::Ident;

use super::call;
use super::parameters::Used;
use super::scope::{Meaning, Scope};
use crate::ast::{self, Block, Input};
use crate::checked::{Body, Expr, ExprKind, Variable};
use crate::ctxt::Ctxt;
use crate::message::expression as message;

/// The free energy with its names resolved.
pub(super) fn energy<'a>(
    cx: &Ctxt,
    input: &'a Input<'a>,
    variables: &[Variable<'a>],
    used: &mut Used,
) -> Option<Body<'a>> {
    let mut scope = Scope::default();
    for (index, field) in input.fields.iter().enumerate() {
        scope.declare(field.ident, Meaning::Field(index));
    }
    for (index, variable) in variables.iter().enumerate() {
        scope.declare(variable.ident, Meaning::Argument(index));
    }
    let mut resolver = Resolver::new(cx, scope, variables, used);
    let value = resolver.block(&input.energy);
    resolver.finish(value)
}

/// Resolves one body: a free energy or a law.
pub(super) struct Resolver<'r, 'a> {
    pub(super) cx: &'r Ctxt,
    pub(super) scope: Scope,
    pub(super) variables: &'r [Variable<'a>],
    used: &'r mut Used,
    bindings: Vec<Expr<'a>>,
}

impl<'r, 'a> Resolver<'r, 'a> {
    /// A resolver in the given scope.
    pub(super) fn new(
        cx: &'r Ctxt,
        scope: Scope,
        variables: &'r [Variable<'a>],
        used: &'r mut Used,
    ) -> Self {
        Self {
            cx,
            scope,
            variables,
            used,
            bindings: Vec::new(),
        }
    }

    /// The body that ends in `value`.
    pub(super) fn finish(self, value: Option<Expr<'a>>) -> Option<Body<'a>> {
        Some(Body {
            bindings: self.bindings,
            value: value?,
        })
    }

    fn block(&mut self, block: &'a Block<'a>) -> Option<Expr<'a>> {
        let mark = self.scope.enter();
        for binding in &block.bindings {
            // The value is resolved first: `let x = x + 1` refers to the `x` before.
            let value = self.expr(&binding.value);
            let index = value.map(|value| {
                self.bindings.push(value);
                self.bindings.len() - 1
            });
            self.scope.declare(binding.ident, Meaning::Binding(index));
        }
        let value = self.expr(&block.value);
        self.scope.leave(mark);
        value
    }

    /// Resolves an expression; nothing if something in it was reported.
    pub(super) fn expr(&mut self, expr: &'a ast::Expr<'a>) -> Option<Expr<'a>> {
        let kind = match &expr.kind {
            ast::ExprKind::Block(block) => return self.block(block),
            ast::ExprKind::Number(number) => ExprKind::Number(*number),
            ast::ExprKind::Name(ident) => self.name(ident)?,
            ast::ExprKind::Negate(inner) => ExprKind::Negate(Box::new(self.expr(inner)?)),
            ast::ExprKind::Binary(operator, left, right) => {
                let (left, right) = (self.expr(left), self.expr(right));
                ExprKind::Binary(*operator, Box::new(left?), Box::new(right?))
            }
            ast::ExprKind::Call(function, arguments) => call::call(self, function, arguments)?,
        };
        Some(Expr {
            original: expr.original,
            kind,
        })
    }

    fn name(&mut self, ident: &'a Ident) -> Option<ExprKind<'a>> {
        match self.scope.resolve(ident) {
            Some(Meaning::Field(index)) => {
                self.used.mark(index);
                return Some(ExprKind::Parameter(index));
            }
            Some(Meaning::Argument(index)) => return Some(ExprKind::Variable(index)),
            Some(Meaning::Binding(index)) => return index.map(ExprKind::Binding),
            Some(Meaning::ForeignArgument(role)) => {
                self.cx.error(ident, &message::law_of_state(ident, role));
            }
            Some(Meaning::ForeignBinding) => {
                self.cx.error(ident, &message::law_of_binding(ident));
            }
            None if call::is_function(ident) => {
                let name = ast::name(ident);
                self.cx.error(ident, &message::name_is_a_function(&name));
            }
            None => {
                let nearest = self.scope.nearest(ident);
                self.cx.error(ident, &message::unknown_name(ident, nearest));
            }
        }
        None
    }
}
