//! Helpers, `let f = |x| …;`: every call becomes the body of the closure, with its arguments as bindings.
//!
//! A body is resolved where it is defined, which reports what is wrong with its names, and once more for
//! every call, which reports nothing again. Properties that depend on the arguments, such as units, are
//! checked by later phases: they visit the body in every call, and name the call in messages.

use std::mem;

use proc_macro2::Ident;

use super::inlining::{Helper, Inlining};
use super::names;
use super::resolver::Resolver;
use super::scope::Meaning;
use crate::ast;
use crate::checked::{Expr, ExprKind};
use crate::message::expression as message;

/// Largest number of calls inside of one call: with helpers that each call the one before twice, a formula
/// would grow exponentially.
const CALLS: usize = 1000;
/// Largest number of levels of expressions between a call in the formula and one inside of it: resolving is recursive.
const LEVELS: usize = 500;
/// Levels that a call counts for: the functions between two expressions.
const LEVELS_OF_CALL: usize = 5;

impl<'a> Resolver<'_, 'a> {
    /// Declares a helper, after its body has been resolved once for the sake of messages.
    pub(super) fn define(&mut self, ident: &'a Ident, definition: &'a ast::Helper<'a>) {
        names::check_helper(self.cx, &self.scope, ident);
        let mark = self.scope.enter();
        self.scope.declare(ident, Meaning::OpenHelper);
        let scope = self.scope.clone();
        let bindings = self.bindings.len();
        for &argument in &definition.arguments {
            self.declare_argument(argument, None, definition.body.value.original);
        }
        self.block(&definition.body);
        // Nothing of this is part of the formula: a call resolves the body with its own arguments.
        self.bindings.truncate(bindings);
        let names = self.names.split_off(bindings);
        self.inner_names.extend(names);
        self.scope.leave(mark);
        let meaning = Meaning::Helper(self.helpers.len());
        self.scope.declare(ident, meaning);
        self.helpers.push(Helper {
            ident,
            used: self.cx.is_muted(),
            definition,
            scope,
        });
    }

    /// Declares an argument of a helper, with its value if there is a call.
    fn declare_argument(
        &mut self,
        argument: Option<&'a Ident>,
        value: Option<Expr<'a>>,
        original: &'a syn::Expr,
    ) {
        let Some(ident) = argument else {
            self.complete = false;
            return self.scope.declare_unreadable();
        };
        names::check_helper_argument(self.cx, &self.scope, ident);
        let kind = ExprKind::Number(eem_symbolic::Number::ONE);
        let value = value.unwrap_or(Expr { original, kind });
        let binding = self.bind(ident, value);
        self.scope.declare(ident, Meaning::HelperArgument(binding));
    }

    /// Resolves the call of a helper.
    pub(super) fn inline(
        &mut self,
        helper: usize,
        function: &'a Ident,
        arguments: &'a [ast::Expr<'a>],
        call: &'a syn::Expr,
    ) -> ExprKind<'a> {
        self.helpers[helper].used = true;
        let definition = self.helpers[helper].definition;
        let (expected, found) = (definition.arguments.len(), arguments.len());
        if expected != found {
            let names = definition.arguments.iter().flatten();
            let names: Vec<String> = names.map(|name| ast::name(name)).collect();
            let name = ast::name(function);
            let form = format!("{name}({})", names.join(", "));
            let message = message::argument_count(&name, &form, expected, found);
            self.cx.error(function, &message);
            return self.wrong(arguments);
        }
        let values: Vec<Expr<'a>> = arguments.iter().map(|value| self.expr(value)).collect();
        let outermost = self.calls.is_empty();
        if outermost {
            let Inlining { level, .. } = self.inlining;
            self.inlining = Inlining {
                level,
                start: level,
                ..Inlining::default()
            };
        }
        let result = self.body_of_call(helper, values, call);
        if outermost && self.inlining.exhausted {
            self.cx
                .error(function, &message::helper::too_many_calls(function, CALLS));
        }
        result
    }

    fn body_of_call(
        &mut self,
        helper: usize,
        values: Vec<Expr<'a>>,
        call: &'a syn::Expr,
    ) -> ExprKind<'a> {
        self.inlining.calls += 1;
        let Inlining {
            level,
            start,
            calls,
            ..
        } = self.inlining;
        if calls > CALLS || level - start > LEVELS {
            self.inlining.exhausted = true;
        }
        if self.inlining.exhausted {
            self.complete = false;
            return ExprKind::Wrong(values);
        }
        let Helper {
            definition,
            ref scope,
            ..
        } = self.helpers[helper];
        let scope = scope.clone();
        let outside = mem::replace(&mut self.scope, scope);
        self.cx.mute();
        for (&argument, value) in definition.arguments.iter().zip(values) {
            let original = value.original;
            self.declare_argument(argument, Some(value), original);
        }
        self.calls.push(call);
        self.inlining.level += LEVELS_OF_CALL;
        let value = self.block(&definition.body);
        self.inlining.level -= LEVELS_OF_CALL;
        let result = self.bind_value(value);
        self.calls.pop();
        self.cx.unmute();
        self.scope = outside;
        ExprKind::Binding(result)
    }

    /// Adds a binding with a name.
    pub(super) fn bind(&mut self, ident: &'a Ident, value: Expr<'a>) -> usize {
        // In a call the name is left out: unused names are reported where the helper is defined.
        self.add(
            Some(ident).filter(|_| self.calls.is_empty() && !self.cx.is_muted()),
            value,
        )
    }

    /// Adds the value of a call.
    fn bind_value(&mut self, value: Expr<'a>) -> usize {
        self.add(None, value)
    }

    fn add(&mut self, name: Option<&'a Ident>, value: Expr<'a>) -> usize {
        let calls = self.calls.iter().rev();
        let value = calls.fold(value, |value, call| Expr {
            original: value.original,
            kind: ExprKind::InCall(call, Box::new(value)),
        });
        self.bindings.push(value);
        self.names.push((name, false));
        self.bindings.len() - 1
    }
}
