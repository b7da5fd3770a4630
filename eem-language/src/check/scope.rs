//! The meaning of names at a point of an expression.
//!
//! The inner name hides the outer one, as in Rust; [`names`](super::names) reports where it does.

use proc_macro2::Ident;

use crate::ast::{self, Role};
use crate::nearest::nearest;

/// What a name stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Meaning {
    /// Field of the struct.
    Field(usize),
    /// Field that is an array, with its length if that is written out.
    Array(usize, Option<usize>),
    /// Field that is marked as unused.
    UnusedField,
    /// Argument of the free energy, in the order of the state.
    Argument(usize),
    /// Argument whose role could not be read.
    WrongArgument,
    /// `let` binding.
    Binding(usize),
    /// An argument of a helper, which is a binding in every call.
    HelperArgument(usize),
    /// `let` binding of a closure.
    Helper(usize),
    /// A helper inside of its own body.
    OpenHelper,
    /// An argument that a viscosity must not use.
    ForeignArgument(Role),
    /// A `let` of the free energy, which a viscosity does not see.
    ForeignBinding,
    /// Any name: something that declares names could not be read.
    Unreadable,
}

impl Meaning {
    /// Whether it may be suggested in place of a wrong name.
    fn visible(self) -> bool {
        match self {
            Self::Field(_)
            | Self::Array(..)
            | Self::Argument(_)
            | Self::WrongArgument
            | Self::Binding(_)
            | Self::HelperArgument(_)
            | Self::Helper(_) => true,
            Self::OpenHelper
            | Self::UnusedField
            | Self::ForeignArgument(_)
            | Self::ForeignBinding
            | Self::Unreadable => false,
        }
    }
}

/// The names that can be used at a point, innermost last.
#[derive(Clone, Debug, Default)]
pub(super) struct Scope {
    names: Vec<(String, Meaning)>,
}

impl Scope {
    /// Declares a name; it hides others of the same name.
    pub(super) fn declare(&mut self, ident: &Ident, meaning: Meaning) {
        self.names.push((ast::name(ident), meaning));
    }

    /// From here on, unknown names may be due to what could not be read.
    pub(super) fn declare_unreadable(&mut self) {
        self.names.push((String::new(), Meaning::Unreadable));
    }

    /// What `ident` stands for here.
    pub(super) fn resolve(&self, ident: &Ident) -> Option<Meaning> {
        let wanted = ast::name(ident);
        let mut inner_first = self.names.iter().rev();
        let found = inner_first.find(|(name, _)| *name == wanted);
        let unreadable = || self.names.iter().find(|(_, m)| *m == Meaning::Unreadable);
        found.or_else(unreadable).map(|&(_, meaning)| meaning)
    }

    /// Whether the name is taken.
    pub(super) fn contains(&self, name: &str) -> bool {
        self.names.iter().any(|(known, _)| known == name)
    }

    /// The visible name most like `ident`.
    pub(super) fn nearest(&self, ident: &Ident) -> Option<&str> {
        let visible = self.names.iter().rev().filter(|(_, m)| m.visible());
        nearest(&ast::name(ident), visible.map(|(name, _)| name.as_str()))
    }

    /// A mark to return to at the end of a block.
    pub(super) fn enter(&self) -> usize {
        self.names.len()
    }

    /// Forgets the names declared since `mark`.
    pub(super) fn leave(&mut self, mark: usize) {
        self.names.truncate(mark);
    }
}
