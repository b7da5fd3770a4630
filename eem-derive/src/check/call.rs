//! Calls: the functions a free energy can use, and how many arguments they take.

use eem_symbolic::Function;
use proc_macro2::Ident;

use super::resolve::Resolver;
use super::scope::Meaning;
use crate::ast;
use crate::checked::{Expr, ExprKind};
use crate::message::expression as message;
use crate::nearest::nearest;

/// What a function name stands for.
#[derive(Clone, Copy)]
enum Callee {
    Diff,
    Powi,
    Powf,
    Sqrt,
    Recip,
    Unary(Function),
}

/// The functions that are not in [`Function::ALL`].
const STRUCTURAL: [(&str, Callee); 5] = [
    ("diff", Callee::Diff),
    ("powi", Callee::Powi),
    ("powf", Callee::Powf),
    ("sqrt", Callee::Sqrt),
    ("recip", Callee::Recip),
];

impl Callee {
    fn from_name(name: &str) -> Option<Self> {
        let structural = STRUCTURAL.into_iter().find(|&(n, _)| n == name);
        match structural {
            Some((_, callee)) => Some(callee),
            None => Function::from_name(name).map(Self::Unary),
        }
    }

    /// All names, for suggestions.
    fn names() -> impl Iterator<Item = &'static str> {
        let structural = STRUCTURAL.into_iter().map(|(name, _)| name);
        structural.chain(Function::ALL.iter().map(|function| function.name()))
    }

    /// Number of arguments and how a call is written.
    fn form(self) -> (usize, String) {
        match self {
            Self::Diff => (2, "diff(expression, lambda)".to_owned()),
            Self::Powi => (2, "powi(x, 2)".to_owned()),
            Self::Powf => (2, "powf(x, y)".to_owned()),
            Self::Sqrt => (1, "sqrt(x)".to_owned()),
            Self::Recip => (1, "recip(x)".to_owned()),
            Self::Unary(function) => (1, format!("{}(x)", function.name())),
        }
    }
}

/// There is a function of this name.
pub(super) fn is_function(ident: &Ident) -> bool {
    Callee::from_name(&ast::name(ident)).is_some()
}

/// Resolves `function(arguments)`.
pub(super) fn call<'a>(
    resolver: &mut Resolver<'_, 'a>,
    function: &'a Ident,
    arguments: &'a [ast::Expr<'a>],
) -> Option<ExprKind<'a>> {
    let name = ast::name(function);
    let Some(callee) = Callee::from_name(&name) else {
        report_unknown(resolver, function, &name);
        // The arguments may be wrong as well.
        for argument in arguments {
            resolver.expr(argument);
        }
        return None;
    };
    let (expected, form) = callee.form();
    if arguments.len() != expected {
        let message = message::argument_count(&name, &form, expected, arguments.len());
        resolver.cx.error(function, &message);
    }
    if let (Callee::Diff, [expression, variable]) = (callee, arguments) {
        let expression = resolver.expr(expression);
        let variable = diff_variable(resolver, variable);
        return Some(ExprKind::Diff(Box::new(expression?), variable?));
    }
    let resolved = arguments.iter().map(|argument| resolver.expr(argument));
    let resolved: Vec<Option<Expr<'a>>> = resolved.collect();
    let mut resolved = resolved
        .into_iter()
        .collect::<Option<Vec<_>>>()?
        .into_iter();
    match (callee, resolved.next(), resolved.next(), resolved.next()) {
        (Callee::Powi, Some(x), Some(n), None) => Some(ExprKind::Powi(x.into(), n.into())),
        (Callee::Powf, Some(x), Some(y), None) => Some(ExprKind::Powf(x.into(), y.into())),
        (Callee::Sqrt, Some(x), None, None) => Some(ExprKind::Sqrt(x.into())),
        (Callee::Recip, Some(x), None, None) => Some(ExprKind::Recip(x.into())),
        (Callee::Unary(Function::Abs), Some(x), None, None) => {
            Some(ExprKind::Abs(function, x.into()))
        }
        (Callee::Unary(function), Some(x), None, None) => Some(ExprKind::Apply(function, x.into())),
        // The wrong number of arguments has been reported.
        _ => None,
    }
}

fn report_unknown(resolver: &Resolver<'_, '_>, function: &Ident, name: &str) {
    let message = if resolver.scope.resolve(function).is_some() {
        message::name_is_not_a_function(name)
    } else {
        let nearest = nearest(name, Callee::names());
        message::unknown_function(name, message::function_help(name, nearest, Callee::names()))
    };
    resolver.cx.error(function, &message);
}

/// The argument of the free energy that the second argument of `diff` names.
fn diff_variable<'a>(resolver: &Resolver<'_, 'a>, variable: &'a ast::Expr<'a>) -> Option<usize> {
    let cx = resolver.cx;
    let ast::ExprKind::Name(ident) = variable.kind else {
        cx.error(variable.original, &message::diff_variable_is_not_a_name());
        return None;
    };
    let refuse = |kind| {
        let names: Vec<String> = resolver
            .variables
            .iter()
            .map(|v| ast::name(v.ident))
            .collect();
        let names = names.iter().map(String::as_str);
        cx.error(ident, &message::diff_variable(ident, kind, names));
    };
    match resolver.scope.resolve(ident) {
        Some(Meaning::Argument(index)) => return Some(index),
        Some(Meaning::ForeignArgument(role)) => {
            cx.error(ident, &message::law_of_state(ident, role));
        }
        Some(Meaning::Field(_)) => refuse("parameter"),
        Some(Meaning::Binding(_) | Meaning::ForeignBinding) => refuse("`let` binding"),
        None => {
            let nearest = resolver.scope.nearest(ident);
            cx.error(ident, &message::unknown_name(ident, nearest));
        }
    }
    None
}
