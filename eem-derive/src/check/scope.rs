//! What a name means at a point of an expression.
//!
//! The inner name hides the outer one, as in Rust: a `let` hides whatever came before it,
//! arguments included; an argument hides a field.

use proc_macro2::Ident;

use crate::ast::{self, Role};
use crate::nearest::nearest;

/// What a name stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Meaning {
    /// Field of the struct.
    Field(usize),
    /// Argument of the free energy, in the order of the state.
    Argument(usize),
    /// `let` binding; nothing if its value was wrong, which has been reported.
    Binding(Option<usize>),
    /// An argument that a viscosity must not use.
    ForeignArgument(Role),
    /// A `let` of the free energy, which a viscosity does not see.
    ForeignBinding,
}

impl Meaning {
    /// May be suggested in place of a wrong name.
    fn visible(self) -> bool {
        match self {
            Self::Field(_) | Self::Argument(_) | Self::Binding(_) => true,
            Self::ForeignArgument(_) | Self::ForeignBinding => false,
        }
    }
}

/// The names that can be used at a point, innermost last.
#[derive(Debug, Default)]
pub(super) struct Scope {
    names: Vec<(String, Meaning)>,
}

impl Scope {
    /// Declares a name; it hides others of the same name.
    pub(super) fn declare(&mut self, ident: &Ident, meaning: Meaning) {
        self.names.push((ast::name(ident), meaning));
    }

    /// What `ident` stands for here.
    pub(super) fn resolve(&self, ident: &Ident) -> Option<Meaning> {
        let wanted = ast::name(ident);
        let inner_first = self.names.iter().rev();
        inner_first
            .filter(|(name, _)| *name == wanted)
            .map(|&(_, meaning)| meaning)
            .next()
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
