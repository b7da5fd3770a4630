//! Resolves the names of an expression and flattens its blocks.

use proc_macro2::Ident;

use super::scope::{Meaning, Scope};
use super::{call, names, parameters::Used};
use crate::ast::{self, Block, Input};
use crate::checked::{Body, Expr, ExprKind, Variable};
use crate::ctxt::Ctxt;
use crate::message::{expression as message, field};

/// The free energy with its names resolved.
pub(super) fn energy<'a>(
    cx: &Ctxt,
    input: &'a Input<'a>,
    variables: &[Variable<'a>],
    used: &mut Used,
) -> Body<'a> {
    let mut scope = Scope::default();
    declare_fields(&mut scope, input);
    for argument in &input.arguments {
        let index = variables.iter().position(|v| v.ident == argument.ident);
        let meaning = index.map_or(Meaning::WrongArgument, Meaning::Argument);
        scope.declare(argument.ident, meaning);
    }
    if input.arguments.len() < input.closure.inputs.len() {
        scope.declare_unreadable();
    }
    let mut resolver = Resolver::new(cx, scope, variables, used);
    let value = resolver.block(&input.energy);
    resolver.finish(value)
}

/// Makes the fields of the struct visible.
pub(super) fn declare_fields(scope: &mut Scope, input: &Input<'_>) {
    let Some(fields) = &input.fields else {
        return scope.declare_unreadable();
    };
    for (index, field) in fields.iter().enumerate() {
        let meaning = if field.unused {
            Meaning::UnusedField
        } else {
            Meaning::Field(index)
        };
        scope.declare(field.ident, meaning);
    }
}

/// Resolves one body: a free energy or a law.
pub(super) struct Resolver<'r, 'a> {
    pub(super) cx: &'r Ctxt,
    pub(super) scope: Scope,
    pub(super) variables: &'r [Variable<'a>],
    used: &'r mut Used,
    bindings: Vec<Expr<'a>>,
    /// The names of the bindings, and whether something mentions them.
    names: Vec<(&'a Ident, bool)>,
    /// Nothing has been reported that may have hidden the use of a name.
    complete: bool,
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
            names: Vec::new(),
            complete: true,
        }
    }

    /// The body that ends in `value`. Reports bindings without effect.
    pub(super) fn finish(self, value: Expr<'a>) -> Body<'a> {
        if self.complete {
            let unused = self.names.iter().filter(|(_, used)| !used);
            for (ident, _) in unused.filter(|(ident, _)| !ast::is_underscored(ident)) {
                self.cx.error(ident, &message::unused_binding(ident));
            }
        } else {
            self.used.give_up();
        }
        Body {
            bindings: self.bindings,
            value,
        }
    }

    /// The value of a binding has been reported.
    pub(super) fn is_wrong(&self, binding: usize) -> bool {
        matches!(self.bindings[binding].kind, ExprKind::Wrong(_))
    }

    fn block(&mut self, block: &'a Block<'a>) -> Expr<'a> {
        let mark = self.scope.enter();
        for binding in &block.bindings {
            // The value is resolved first: `let x = x + 1` refers to the `x` before.
            let value = self.expr(&binding.value);
            let Some(ident) = binding.ident else {
                self.complete = false;
                self.scope.declare_unreadable();
                continue;
            };
            names::check_binding(self.cx, &self.scope, ident);
            self.scope
                .declare(ident, Meaning::Binding(self.bindings.len()));
            self.bindings.push(value);
            self.names.push((ident, false));
        }
        let value = self.expr(&block.value);
        self.scope.leave(mark);
        value
    }

    /// Resolves an expression.
    pub(super) fn expr(&mut self, expr: &'a ast::Expr<'a>) -> Expr<'a> {
        let kind = match &expr.kind {
            ast::ExprKind::Block(block) => return self.block(block),
            ast::ExprKind::Number(number) => ExprKind::Number(*number),
            ast::ExprKind::Name(ident) => self.name(ident),
            ast::ExprKind::Negate(inner) => ExprKind::Negate(Box::new(self.expr(inner))),
            ast::ExprKind::Binary(operator, left, right) => {
                let (left, right) = (self.expr(left), self.expr(right));
                ExprKind::Binary(*operator, Box::new(left), Box::new(right))
            }
            ast::ExprKind::Call(function, arguments) => call::call(self, function, arguments),
            ast::ExprKind::Wrong(parts) => self.wrong(parts),
        };
        Expr {
            original: expr.original,
            kind,
        }
    }

    /// A hole, and what can be resolved in it.
    pub(super) fn wrong(
        &mut self,
        parts: impl IntoIterator<Item = &'a ast::Expr<'a>>,
    ) -> ExprKind<'a> {
        self.complete = false;
        ExprKind::Wrong(parts.into_iter().map(|part| self.expr(part)).collect())
    }

    fn name(&mut self, ident: &'a Ident) -> ExprKind<'a> {
        match self.scope.resolve(ident) {
            Some(Meaning::Field(index)) => {
                self.used.mark(index);
                return ExprKind::Parameter(index);
            }
            Some(Meaning::Argument(index)) => return ExprKind::Variable(index),
            Some(Meaning::Binding(index)) => {
                self.names[index].1 = true;
                return ExprKind::Binding(index);
            }
            Some(meaning) => self.refuse(ident, meaning),
            None => self.unknown(ident),
        }
        self.wrong([])
    }

    /// Reports a name that is known and cannot be used here.
    pub(super) fn refuse(&self, ident: &Ident, meaning: Meaning) {
        let message = match meaning {
            Meaning::ForeignArgument(role) => message::law_of_state(ident, role),
            Meaning::ForeignBinding => message::law_of_binding(ident),
            Meaning::UnusedField => field::unused_and_used(ident),
            // What is wrong with them has been reported.
            Meaning::WrongArgument | Meaning::Unreadable => return,
            Meaning::Field(_) | Meaning::Argument(_) | Meaning::Binding(_) => {
                unreachable!("these can be used everywhere")
            }
        };
        self.cx.error(ident, &message);
    }

    /// Reports a name that stands for nothing.
    pub(super) fn unknown(&self, ident: &Ident) {
        let name = ast::name(ident);
        let nearest = self.scope.nearest(ident);
        let constant = message::syntax::constant_value(&name);
        let message = match (nearest, constant) {
            _ if call::is_function(ident) => message::name_is_a_function(&name),
            (None, Some(value)) => message::syntax::constant(&name, value),
            _ => message::unknown_name(ident, nearest),
        };
        self.cx.error(ident, &message);
    }
}
