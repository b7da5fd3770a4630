//! The functions that a free energy can use, and how many arguments they take.

use eem_symbolic::Function;
use proc_macro2::Ident;

use crate::ast;

/// What a function name stands for.
#[derive(Clone, Copy)]
pub(super) enum Callee {
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
    /// The function of this name.
    pub(super) fn from_name(name: &str) -> Option<Self> {
        let structural = STRUCTURAL.into_iter().find(|&(n, _)| n == name);
        match structural {
            Some((_, callee)) => Some(callee),
            None => Function::from_name(name).map(Self::Unary),
        }
    }

    /// All names, for suggestions.
    pub(super) fn names() -> impl Iterator<Item = &'static str> {
        let structural = STRUCTURAL.into_iter().map(|(name, _)| name);
        structural.chain(Function::ALL.iter().map(|function| function.name()))
    }

    /// Number of arguments, and an example of a call.
    pub(super) fn form(self) -> (usize, String) {
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

/// Whether there is a function of this name.
pub(super) fn is_function(ident: &Ident) -> bool {
    Callee::from_name(&ast::name(ident)).is_some()
}
