//! Resolves the names of an expression and flattens its blocks.

use eem_symbolic::Function;
use proc_macro2::Ident;
use quote::ToTokens;

use super::callee::Callee;
use super::parameters::{Used, array};
use super::resolver::Resolver;
use super::scope::{Meaning, Scope};
use super::{constants, names};
use crate::ast::{self, Binding, Block, Bound, Input};
use crate::checked::{Body, Expr, ExprKind, Origin, Variable};
use crate::ctxt::Ctxt;
use crate::dialect::Dialect;
use crate::message::{expression as message, field, text};
use crate::nearest::nearest;

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
        let meaning = match array(field.ty) {
            _ if field.unused => Meaning::UnusedField,
            Some((_, length)) => Meaning::Array(index, length),
            None => Meaning::Field(index),
        };
        scope.declare(field.ident, meaning);
    }
}

impl<'a> Resolver<'_, 'a> {
    /// Resolves a block; its bindings join those of the body.
    pub(super) fn block(&mut self, block: &'a Block<'a>) -> Expr<'a> {
        let mark = self.scope.enter();
        for Binding { ident, value } in &block.bindings {
            // The value is resolved first: `let x = x + 1` refers to the `x` before.
            let value = match (value, ident) {
                (Bound::Value(value), _) => Some(self.expr(value)),
                (Bound::Helper(helper), Some(ident)) => {
                    self.define(ident, helper);
                    continue;
                }
                (Bound::Helper(_), None) => None,
            };
            let (Some(ident), Some(value)) = (ident, value) else {
                self.complete = false;
                self.scope.declare_unreadable();
                continue;
            };
            names::check_binding(self.cx, &self.scope, ident);
            let binding = self.bind(ident, value);
            self.scope.declare(ident, Meaning::Binding(binding));
        }
        let value = self.expr(&block.value);
        self.scope.leave(mark);
        value
    }

    /// Resolves an expression.
    pub(super) fn expr(&mut self, expr: &'a ast::Expr<'a>) -> Expr<'a> {
        self.inlining.level += 1;
        let kind = match &expr.kind {
            ast::ExprKind::Block(block) => {
                let value = self.block(block);
                self.inlining.level -= 1;
                return value;
            }
            ast::ExprKind::Number(number) => ExprKind::Number(*number),
            ast::ExprKind::Name(ident) => self.name(ident),
            ast::ExprKind::Constant(path) => self.path(path),
            ast::ExprKind::Entry(entry) => self.entry(entry),
            ast::ExprKind::Negate(inner) => ExprKind::Negate(Box::new(self.expr(inner))),
            ast::ExprKind::Binary(operator, left, right) => {
                let (left, right) = (self.expr(left), self.expr(right));
                ExprKind::Binary(*operator, Box::new(left), Box::new(right))
            }
            ast::ExprKind::Call(function, arguments) => {
                self.call(function, arguments, expr.original)
            }
            ast::ExprKind::Wrong(parts) => self.wrong(parts),
        };
        self.inlining.level -= 1;
        Expr {
            original: expr.original,
            kind,
        }
    }

    /// An expression that has been reported. Its parts are resolved all the same, so that mistakes in
    /// them are reported, too.
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
                return ExprKind::Parameter(Origin::Field(index));
            }
            Some(Meaning::Array(index, _)) => {
                self.used.mark(index);
                self.cx.error(ident, &field::array_without_index(ident));
                return self.wrong([]);
            }
            Some(Meaning::Argument(index)) => return ExprKind::Variable(index),
            Some(Meaning::Binding(index) | Meaning::HelperArgument(index)) => {
                self.names[index].1 = true;
                return ExprKind::Binding(index);
            }
            Some(Meaning::Unreadable) | None if self.may_be_constant(ident) => {
                return match constants::bare(ident) {
                    Some(value) => ExprKind::Number(value.into()),
                    None => self.constant(ident),
                };
            }
            Some(meaning) => self.refuse(ident, meaning),
            None => self.unknown(ident),
        }
        self.wrong([])
    }

    /// A constant at the end of a path.
    fn path(&mut self, path: &'a syn::Path) -> ExprKind<'a> {
        if let Some(value) = constants::of_std(path) {
            return ExprKind::Number(value.into());
        }
        let in_text = self.cx.dialect() == Dialect::Text;
        let of_std = path.segments.iter().rev().nth(1);
        let of_std = of_std.is_some_and(|module| module.ident == "consts");
        match path.segments.last() {
            Some(last) if !ast::is_upper_case(&last.ident) || (in_text && of_std) => {
                let meant = constants::meant(&last.ident);
                let text = constants::text(path);
                let message = message::syntax::constant_of_std(&text, meant.as_deref());
                self.cx.error(path, &message);
                self.wrong([])
            }
            Some(last) if in_text => {
                let (text, last) = (constants::text(path), ast::name(&last.ident));
                let message = text::constant_of_program(&text, &last);
                self.cx.error(path, &message);
                self.wrong([])
            }
            _ => self.constant(path),
        }
    }

    /// Whether a name that is not declared may be a constant. In a text only `PI` may: a text has no program.
    fn may_be_constant(&self, ident: &Ident) -> bool {
        let of_program = self.cx.dialect() == Dialect::Attribute && ast::is_upper_case(ident);
        of_program || constants::bare(ident).is_some()
    }

    /// A constant of the program, which Rust resolves.
    fn constant(&mut self, path: impl ToTokens) -> ExprKind<'a> {
        let index = self.used.constants.mention(path);
        ExprKind::Parameter(Origin::Constant(index))
    }

    /// `name[2]`
    fn entry(&mut self, entry: &ast::Entry<'a>) -> ExprKind<'a> {
        let ast::Entry {
            array: ident,
            index,
            literal,
        } = *entry;
        let what = match self.scope.resolve(ident) {
            Some(Meaning::Array(field, length)) => {
                self.used.mark_entry(field, index);
                match length {
                    Some(length) if index >= length => {
                        let message = field::index_out_of_range(ident, index, length);
                        self.cx.error(literal, &message);
                        return self.wrong([]);
                    }
                    _ => return ExprKind::Parameter(Origin::Entry(field, index)),
                }
            }
            Some(Meaning::Field(field)) => {
                self.used.mark(field);
                "a number"
            }
            Some(Meaning::Argument(_) | Meaning::HelperArgument(_)) => "an argument",
            Some(Meaning::Binding(_)) => "a `let` binding",
            None if self.may_be_constant(ident) => "a constant",
            Some(meaning) => {
                self.refuse(ident, meaning);
                return self.wrong([]);
            }
            None => {
                self.unknown(ident);
                return self.wrong([]);
            }
        };
        self.cx.error(literal, &field::index_of_number(ident, what));
        self.wrong([])
    }

    /// Resolves `function(arguments)`.
    fn call(
        &mut self,
        function: &'a Ident,
        arguments: &'a [ast::Expr<'a>],
        original: &'a syn::Expr,
    ) -> ExprKind<'a> {
        let name = ast::name(function);
        let Some(callee) = Callee::from_name(&name) else {
            if let Some(Meaning::Helper(helper)) = self.scope.resolve(function) {
                return self.inline(helper, function, arguments, original);
            }
            report_unknown(self, function, &name);
            return self.wrong(arguments);
        };
        let (expected, form) = callee.form();
        if arguments.len() != expected {
            let message = message::argument_count(&name, &form, expected, arguments.len());
            self.cx.error(function, &message);
            return self.wrong(arguments);
        }
        match (callee, arguments) {
            (Callee::Diff, [expression, variable]) => match diff_variable(self, variable) {
                Some(variable) => ExprKind::Diff(self.expr(expression).into(), variable),
                None => self.wrong([expression]),
            },
            (Callee::Powi, [x, n]) => {
                let (x, n) = (self.expr(x), self.expr(n));
                ExprKind::Powi(x.into(), n.into())
            }
            (Callee::Powf, [x, y]) => {
                let (x, y) = (self.expr(x), self.expr(y));
                ExprKind::Powf(x.into(), y.into())
            }
            (Callee::Sqrt, [x]) => ExprKind::Sqrt(self.expr(x).into()),
            (Callee::Recip, [x]) => ExprKind::Recip(self.expr(x).into()),
            (Callee::Unary(Function::Abs), [x]) => ExprKind::Abs(function, self.expr(x).into()),
            (Callee::Unary(function), [x]) => ExprKind::Apply(function, self.expr(x).into()),
            _ => unreachable!("the number of arguments has been checked"),
        }
    }
}

fn report_unknown(resolver: &Resolver<'_, '_>, function: &Ident, name: &str) {
    let helpers = resolver
        .helpers
        .iter()
        .map(|helper| ast::name(helper.ident));
    let helpers: Vec<String> = helpers.collect();
    let mut known: Vec<&str> = Callee::names().collect();
    known.extend(helpers.iter().map(String::as_str));
    let nearest = nearest(name, known);
    let message = match resolver.scope.resolve(function) {
        // The value of the binding is a closure, which has been reported.
        Some(Meaning::Binding(index)) if resolver.is_wrong(index) => return,
        Some(Meaning::ForeignBinding) => message::law_of_binding(function),
        Some(Meaning::OpenHelper) => message::helper::calls_itself(function),
        // A declaration that could not be read may have this name.
        Some(Meaning::Unreadable) if nearest.is_none() => return,
        None | Some(Meaning::Unreadable) => {
            message::unknown_function(name, message::function_help(name, nearest, Callee::names()))
        }
        Some(_) => message::name_is_not_a_function(name),
    };
    resolver.cx.error(function, &message);
}

/// The argument of the free energy that the second argument of `diff` names.
fn diff_variable<'a>(resolver: &Resolver<'_, 'a>, variable: &'a ast::Expr<'a>) -> Option<usize> {
    let cx = resolver.cx;
    let ident = match variable.kind {
        ast::ExprKind::Name(ident) => ident,
        ast::ExprKind::Wrong(_) => return None,
        _ => {
            cx.error(variable.original, &message::diff_variable_is_not_a_name());
            return None;
        }
    };
    let refuse = |kind| {
        let variables = resolver.variables.iter();
        let names: Vec<String> = variables.map(|v| ast::name(v.ident)).collect();
        let names = names.iter().map(String::as_str);
        cx.error(ident, &message::diff_variable(ident, kind, names));
    };
    match resolver.scope.resolve(ident) {
        Some(Meaning::Argument(index)) => return Some(index),
        Some(Meaning::Field(_) | Meaning::Array(..)) => refuse("parameter"),
        // The binding hides an argument, which has been reported.
        Some(Meaning::Binding(_) | Meaning::HelperArgument(_)) if is_argument(resolver, ident) => {}
        Some(Meaning::HelperArgument(_)) => refuse("helper argument"),
        Some(Meaning::Binding(_)) => refuse("`let` binding"),
        Some(meaning) => resolver.refuse(ident, meaning),
        None if resolver.may_be_constant(ident) => refuse("constant"),
        None => resolver.unknown(ident),
    }
    None
}

fn is_argument(resolver: &Resolver<'_, '_>, ident: &Ident) -> bool {
    let mut variables = resolver.variables.iter();
    variables.any(|variable| ast::name(variable.ident) == ast::name(ident))
}
