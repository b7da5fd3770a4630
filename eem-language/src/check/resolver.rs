//! The state while a body is resolved: the names in scope, the bindings, the names that have been used.

use proc_macro2::Ident;

use super::callee::is_function;
use super::inlining::{Helper, Inlining};
use super::parameters::Used;
use super::scope::{Meaning, Scope};
use crate::ast::{self, Role};
use crate::checked::{Body, Expr, ExprKind, Variable};
use crate::ctxt::Ctxt;
use crate::message::{expression as message, field};

/// Resolves one body: a free energy or a law.
pub(super) struct Resolver<'r, 'a> {
    pub(super) cx: &'r Ctxt,
    pub(super) scope: Scope,
    pub(super) variables: &'r [Variable<'a>],
    pub(super) used: &'r mut Used,
    pub(super) bindings: Vec<Expr<'a>>,
    /// For every binding its name, if it was written in this body, and whether it has been used.
    pub(super) names: Vec<(Option<&'a Ident>, bool)>,
    /// The same for the bindings in the bodies of helpers.
    pub(super) inner_names: Vec<(Option<&'a Ident>, bool)>,
    /// Whether the body is a viscosity law, which may use fewer names than the free energy.
    pub(super) is_law: bool,
    /// The helpers, whether they are visible or not.
    pub(super) helpers: Vec<Helper<'a>>,
    /// The calls of helpers that are being resolved, outermost first.
    pub(super) calls: Vec<&'a syn::Expr>,
    pub(super) inlining: Inlining,
    /// Whether no expression with an error may have used a name, so that unused names can be reported.
    pub(super) complete: bool,
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
            inner_names: Vec::new(),
            is_law: false,
            helpers: Vec::new(),
            calls: Vec::new(),
            inlining: Inlining::default(),
            complete: true,
        }
    }

    /// The body that ends in `value`. Reports unused bindings.
    pub(super) fn finish(self, value: Expr<'a>) -> Body<'a> {
        if self.complete {
            let names = self.names.iter().chain(&self.inner_names);
            let names = names.filter_map(|&(ident, used)| Some((ident?, used)));
            let helpers = self
                .helpers
                .iter()
                .map(|helper| (helper.ident, helper.used));
            let unused = names.chain(helpers).filter(|(_, used)| !used);
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

    /// Whether an error in the value of a binding has been reported.
    pub(super) fn is_wrong(&self, binding: usize) -> bool {
        matches!(self.bindings[binding].kind, ExprKind::Wrong(_))
    }

    /// Reports a name that is known but cannot be used here.
    pub(super) fn refuse(&self, ident: &Ident, meaning: Meaning) {
        let message = match meaning {
            Meaning::ForeignArgument(role) => message::law_of_state(ident, role),
            Meaning::ForeignBinding => message::law_of_binding(ident),
            Meaning::UnusedField => field::unused_and_used(ident),
            Meaning::Helper(_) | Meaning::OpenHelper => {
                message::name_is_a_function(&ast::name(ident))
            }
            // Reported where they are declared.
            Meaning::WrongArgument | Meaning::Unreadable => return,
            Meaning::Field(_)
            | Meaning::Array(..)
            | Meaning::Argument(_)
            | Meaning::Binding(_)
            | Meaning::HelperArgument(_) => {
                unreachable!("these can be used everywhere")
            }
        };
        self.cx.error(ident, &message);
    }

    /// The usual role of a name, if the model can have one more argument of that role.
    fn missing_role(&self, name: &str) -> Option<Role> {
        let role = Role::usual(name)?;
        let has = |taken: fn(Role, Role) -> bool| {
            let mut variables = self.variables.iter();
            variables.any(|variable| taken(variable.role, role))
        };
        let taken = role != Role::Viscous && has(|one, other| one == other);
        let other_kind = has(|one, other| {
            let are_measures = one.is_measure() && other.is_measure();
            are_measures && one.is_of_solid() != other.is_of_solid()
        });
        let foreign = self.is_law && role != Role::Temperature;
        (!taken && !other_kind && !foreign).then_some(role)
    }

    /// The name of the temperature, if the model has one.
    fn temperature(&self) -> Option<String> {
        let mut variables = self.variables.iter();
        let theta = variables.find(|variable| variable.role == Role::Temperature);
        theta.map(|variable| ast::name(variable.ident))
    }

    /// Reports an unknown name.
    pub(super) fn unknown(&self, ident: &Ident) {
        let name = ast::name(ident);
        let nearest = self.scope.nearest(ident);
        let constant = message::syntax::constant_of_paper(&name);
        let message = match (nearest, constant) {
            _ if is_function(ident) => message::name_is_a_function(&name),
            (None, Some(value)) => message::syntax::constant(&name, value),
            (Some(nearest), _) => message::misspelt_name(&name, nearest),
            (None, None) => match self.missing_role(&name) {
                Some(role) => message::missing_argument(&name, role),
                None if self.is_law => {
                    message::unknown_name_in_law(&name, self.temperature().as_deref())
                }
                None => message::unknown_name(&name),
            },
        };
        self.cx.error(ident, &message);
    }
}
