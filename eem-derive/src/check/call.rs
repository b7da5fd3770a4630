//! Calls: the functions a free energy can use, and how many arguments they take.

use eem_symbolic::Function;
use proc_macro2::Ident;

use super::resolve::Resolver;
use super::scope::Meaning;
use crate::ast;
use crate::checked::ExprKind;
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
) -> ExprKind<'a> {
    let name = ast::name(function);
    let Some(callee) = Callee::from_name(&name) else {
        report_unknown(resolver, function, &name);
        return resolver.wrong(arguments);
    };
    let (expected, form) = callee.form();
    if arguments.len() != expected {
        let message = message::argument_count(&name, &form, expected, arguments.len());
        resolver.cx.error(function, &message);
        return resolver.wrong(arguments);
    }
    match (callee, arguments) {
        (Callee::Diff, [expression, variable]) => match diff_variable(resolver, variable) {
            Some(variable) => ExprKind::Diff(resolver.expr(expression).into(), variable),
            None => resolver.wrong([expression]),
        },
        (Callee::Powi, [x, n]) => {
            let (x, n) = (resolver.expr(x), resolver.expr(n));
            ExprKind::Powi(x.into(), n.into())
        }
        (Callee::Powf, [x, y]) => {
            let (x, y) = (resolver.expr(x), resolver.expr(y));
            ExprKind::Powf(x.into(), y.into())
        }
        (Callee::Sqrt, [x]) => ExprKind::Sqrt(resolver.expr(x).into()),
        (Callee::Recip, [x]) => ExprKind::Recip(resolver.expr(x).into()),
        (Callee::Unary(Function::Abs), [x]) => ExprKind::Abs(function, resolver.expr(x).into()),
        (Callee::Unary(function), [x]) => ExprKind::Apply(function, resolver.expr(x).into()),
        _ => unreachable!("the number of arguments has been checked"),
    }
}

fn report_unknown(resolver: &Resolver<'_, '_>, function: &Ident, name: &str) {
    let nearest = nearest(name, Callee::names());
    let message = match resolver.scope.resolve(function) {
        // A closure, which has been reported.
        Some(Meaning::Binding(index)) if resolver.is_wrong(index) => return,
        // It may be declared by what could not be read.
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
        Some(Meaning::Field(_)) => refuse("parameter"),
        // That it hides an argument has been reported.
        Some(Meaning::Binding(_)) if is_argument(resolver, ident) => {}
        Some(Meaning::Binding(_)) => refuse("`let` binding"),
        Some(meaning) => resolver.refuse(ident, meaning),
        None => resolver.unknown(ident),
    }
    None
}

fn is_argument(resolver: &Resolver<'_, '_>, ident: &Ident) -> bool {
    let mut variables = resolver.variables.iter();
    variables.any(|variable| ast::name(variable.ident) == ast::name(ident))
}
