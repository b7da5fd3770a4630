//! The viscosity laws: one per dashpot, of the temperature and the parameters.

use super::parameters::Used;
use super::resolve::Resolver;
use super::scope::{Meaning, Scope};
use crate::ast::{self, Argument, Block, Expr, ExprKind, Input, Law, Role};
use crate::checked::{Body, Variable};
use crate::ctxt::Ctxt;
use crate::message::attribute as message;
use crate::nearest::nearest;

/// The laws with their names resolved, in the order of the dashpots.
pub(super) fn viscosities<'a>(
    cx: &Ctxt,
    input: &'a Input<'a>,
    variables: &[Variable<'a>],
    used: &mut Used,
) -> Option<Vec<Body<'a>>> {
    let mut bodies = Vec::new();
    for law in &input.laws {
        let mut resolver = Resolver::new(cx, scope(input, variables), variables, used);
        let value = resolver.expr(&law.value);
        bodies.push((ast::name(law.dashpot), resolver.finish(value)));
    }
    let dashpots = variables.iter().filter(|v| v.role == Role::Viscous);
    dashpots
        .map(|dashpot| {
            let name = ast::name(dashpot.ident);
            let position = bodies.iter().position(|(n, _)| *n == name)?;
            bodies.swap_remove(position).1
        })
        .collect()
}

/// What a law sees. Names of the free energy that it does not see are declared as such, so that
/// the message can say so; fields and the temperature hide them.
fn scope(input: &Input<'_>, variables: &[Variable<'_>]) -> Scope {
    let mut scope = Scope::default();
    declare_bindings(&mut scope, &input.energy);
    for (index, field) in input.fields.iter().enumerate() {
        scope.declare(field.ident, Meaning::Field(index));
    }
    for (index, variable) in variables.iter().enumerate() {
        let meaning = match variable.role {
            Role::Temperature => Meaning::Argument(index),
            role @ (Role::Stretch | Role::Viscous) => Meaning::ForeignArgument(role),
        };
        scope.declare(variable.ident, meaning);
    }
    scope
}

fn declare_bindings(scope: &mut Scope, block: &Block<'_>) {
    for binding in &block.bindings {
        scope.declare(binding.ident, Meaning::ForeignBinding);
        declare_inner(scope, &binding.value);
    }
    declare_inner(scope, &block.value);
}

fn declare_inner(scope: &mut Scope, expr: &Expr<'_>) {
    match &expr.kind {
        ExprKind::Number(_) | ExprKind::Name(_) => {}
        ExprKind::Negate(inner) => declare_inner(scope, inner),
        ExprKind::Binary(_, left, right) => {
            declare_inner(scope, left);
            declare_inner(scope, right);
        }
        ExprKind::Call(_, arguments) => {
            for argument in arguments {
                declare_inner(scope, argument);
            }
        }
        ExprKind::Block(block) => declare_bindings(scope, block),
    }
}

/// Every law is for a dashpot, and the only one for it.
pub(super) fn check_names(cx: &Ctxt, input: &Input<'_>) {
    for (i, Law { dashpot, .. }) in input.laws.iter().enumerate() {
        let name = ast::name(dashpot);
        let same = |ident| ast::name(ident) == name;
        match input.arguments.iter().find(|a| same(a.ident)) {
            Some(&Argument {
                role: Role::Viscous,
                ..
            }) => {}
            Some(argument) => {
                let message = message::viscosity_of_another_role(dashpot, argument.role);
                cx.error(dashpot, &message);
            }
            None => report_unknown(cx, input, dashpot),
        }
        if input.laws[..i].iter().any(|law| same(law.dashpot)) {
            cx.error(dashpot, &message::second_viscosity(dashpot));
        }
    }
}

fn report_unknown(cx: &Ctxt, input: &Input<'_>, name: &syn::Ident) {
    let viscous = input.arguments.iter().filter(|a| a.role == Role::Viscous);
    let dashpots: Vec<String> = viscous.map(|a| ast::name(a.ident)).collect();
    let dashpots = || dashpots.iter().map(String::as_str);
    let nearest = nearest(&ast::name(name), dashpots());
    let message = message::viscosity_without_dashpot(name, nearest, dashpots());
    cx.error(name, &message);
}

/// Every dashpot has a law.
pub(super) fn check_complete(cx: &Ctxt, input: &Input<'_>) {
    for argument in &input.arguments {
        let name = ast::name(argument.ident);
        let has_law = input.laws.iter().any(|law| ast::name(law.dashpot) == name);
        if argument.role == Role::Viscous && !has_law {
            cx.error(argument.ident, &message::missing_viscosity(argument.ident));
        }
    }
}
