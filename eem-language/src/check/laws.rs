//! The viscosity laws, functions of the temperature and the parameters: one per dashpot, at most one of the stretch.

use super::parameters::Used;
use super::resolve;
use super::resolver::Resolver;
use super::scope::{Meaning, Scope};
use crate::ast::{self, Argument, Block, Bound, Expr, ExprKind, Input, Joint, Law, Role};
use crate::checked::{Body, Variable};
use crate::ctxt::Ctxt;
use crate::message::attribute as message;
use crate::nearest::nearest;
use crate::units::Quantities;

/// The laws with their names resolved.
pub(super) struct Laws<'a> {
    /// In the order of the dashpots, then the laws of the deviatoric and of the volumetric viscous strain; `None`
    /// where one is missing.
    pub(super) viscosities: Vec<Option<Body<'a>>>,
    /// The law of the stretch, if there is one.
    pub(super) drag: Option<Body<'a>>,
}

/// Resolves the names of all laws.
pub(super) fn laws<'a>(
    cx: &Ctxt,
    input: &'a Input<'a>,
    variables: &[Variable<'a>],
    used: &mut Used,
) -> Laws<'a> {
    let mut bodies = Vec::new();
    for law in &input.laws {
        let mut resolver = Resolver {
            is_law: true,
            ..Resolver::new(cx, scope(input, variables), variables, used)
        };
        let value = resolver.expr(&law.value);
        bodies.push((ast::name(law.dashpot), resolver.finish(value)));
    }
    let mut take = |variable: &Variable<'a>| {
        let name = ast::name(variable.ident);
        let position = bodies.iter().position(|(n, _)| *n == name);
        Some(bodies.remove(position?).1)
    };
    let stretch = variables.iter().find(|v| v.role == Role::Stretch);
    let drag = stretch.and_then(&mut take);
    let flows = [
        Role::Viscous,
        Role::Joint(Joint::Strain),
        Role::Joint(Joint::Trace),
    ];
    let of_role = |role| variables.iter().filter(move |v| v.role == role);
    let viscosities: Vec<_> = flows.into_iter().flat_map(of_role).map(take).collect();
    if viscosities.iter().any(Option::is_none) {
        used.give_up();
    }
    Laws { viscosities, drag }
}

/// The names that a law may use. Other names of the free energy are declared as foreign, so that the
/// message can say so; fields and the temperature hide them.
fn scope(input: &Input<'_>, variables: &[Variable<'_>]) -> Scope {
    let mut scope = Scope::default();
    declare_bindings(&mut scope, &input.energy);
    resolve::declare_fields(&mut scope, input);
    for argument in &input.arguments {
        let index = variables.iter().position(|v| v.ident == argument.ident);
        let meaning = match (index, argument.role) {
            (Some(index), Some(Role::Temperature)) => Meaning::Argument(index),
            (_, Some(role)) => Meaning::ForeignArgument(role),
            (_, None) => Meaning::WrongArgument,
        };
        scope.declare(argument.ident, meaning);
    }
    if input.arguments.len() < input.closure.inputs.len() {
        scope.declare_unreadable();
    }
    scope
}

fn declare_bindings(scope: &mut Scope, block: &Block<'_>) {
    for binding in &block.bindings {
        match binding.ident {
            Some(ident) => scope.declare(ident, Meaning::ForeignBinding),
            None => scope.declare_unreadable(),
        }
        match &binding.value {
            Bound::Value(value) => declare_inner(scope, value),
            Bound::Helper(helper) => declare_bindings(scope, &helper.body),
        }
    }
    declare_inner(scope, &block.value);
}

fn declare_inner(scope: &mut Scope, expr: &Expr<'_>) {
    match &expr.kind {
        ExprKind::Number(_) | ExprKind::Name(_) | ExprKind::Constant(_) | ExprKind::Entry(_) => {}
        ExprKind::Negate(inner) => declare_inner(scope, inner),
        ExprKind::Binary(_, left, right) => {
            declare_inner(scope, left);
            declare_inner(scope, right);
        }
        ExprKind::Call(_, arguments) | ExprKind::Wrong(arguments) => {
            for argument in arguments {
                declare_inner(scope, argument);
            }
        }
        ExprKind::Block(block) => declare_bindings(scope, block),
    }
}

/// Reports laws for names that have no viscosity, and second laws for one name.
pub(super) fn check_names(cx: &Ctxt, input: &Input<'_>) {
    for (i, Law { dashpot, .. }) in input.laws.iter().enumerate() {
        let name = ast::name(dashpot);
        let same = |ident| ast::name(ident) == name;
        match input.arguments.iter().find(|a| same(a.ident)) {
            Some(&Argument {
                role: Some(role), ..
            }) if !role.flows() && role != Role::Stretch => {
                let message = message::viscosity_of_another_role(dashpot, role);
                cx.error(dashpot, &message);
            }
            None if input.arguments_complete => report_unknown(cx, input, dashpot),
            Some(_) | None => {}
        }
        if input.laws[..i].iter().any(|law| same(law.dashpot)) {
            cx.error(dashpot, &message::second_viscosity(dashpot));
        }
    }
}

fn report_unknown(cx: &Ctxt, input: &Input<'_>, name: &syn::Ident) {
    let viscous = input.arguments.iter();
    let viscous = viscous.filter(|a| a.role.is_some_and(Role::flows));
    let dashpots: Vec<String> = viscous.map(|a| ast::name(a.ident)).collect();
    let dashpots = || dashpots.iter().map(String::as_str);
    let nearest = nearest(&ast::name(name), dashpots());
    let message = message::viscosity_without_dashpot(name, nearest, dashpots());
    cx.error(name, &message);
}

/// Reports dashpots without a law. If a law has an unknown name, it is taken for the missing one.
pub(super) fn check_complete(cx: &Ctxt, input: &Input<'_>) {
    let known = |law: &Law<'_>| {
        let mut arguments = input.arguments.iter();
        arguments.any(|argument| ast::name(argument.ident) == ast::name(law.dashpot))
    };
    if !input.laws_complete || !input.laws.iter().all(known) {
        return;
    }
    for argument in &input.arguments {
        let name = ast::name(argument.ident);
        let has_law = input.laws.iter().any(|law| ast::name(law.dashpot) == name);
        if let Some(role) = argument.role.filter(|role| role.flows() && !has_law) {
            let unit = Quantities::of(input.per_volume()).viscosity;
            let message = message::missing_viscosity(argument.ident, role, unit);
            cx.error(argument.ident, &message);
        }
    }
}
