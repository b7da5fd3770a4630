//! The arguments of the free energy: how many of each role, and in which order they are stored.

use std::collections::BTreeSet;

use proc_macro2::Ident;

use crate::ast::{self, Argument, Input, Joint, Role, Strain};
use crate::checked::Variable;
use crate::ctxt::Ctxt;
use crate::message::attribute as message;

/// The arguments in the order of the state: measures, of which the strains are first, dashpots,
/// temperature, each as in the closure.
pub(super) fn variables<'a>(input: &Input<'a>) -> Vec<Variable<'a>> {
    let arguments = input.arguments.iter();
    let mut variables: Vec<Variable<'a>> = arguments
        .filter_map(|&Argument { ident, role }| Some(Variable { ident, role: role? }))
        .collect();
    variables.sort_by_key(|variable| match variable.role {
        Role::Stretch | Role::Strain(_) => 0,
        Role::Joint(_) => 1,
        Role::Viscous => 2,
        Role::Temperature => 3,
    });
    variables
}

/// Reports a model without a measure, and one with measures of both a spring and a solid.
pub(super) fn check_measures(cx: &Ctxt, input: &Input<'_>) {
    let closure = input.closure;
    let is_deformed = measures(input).any(|(_, role)| role.joint().is_none());
    let mut measures = measures(input).filter(|_| is_deformed);
    match measures.next() {
        Some((first, role)) => {
            let others = measures.filter(|(_, other)| other.is_of_solid() != role.is_of_solid());
            for (other, its_role) in others {
                let message = message::spring_and_solid([other, first], [its_role, role]);
                cx.error(other, &message);
            }
        }
        None if !input.arguments_complete => {}
        None if closure.inputs.is_empty() => {
            cx.error(closure.inputs_begin, &message::no_measure());
        }
        None => cx.error(&closure.inputs, &message::no_measure()),
    }
}

/// Reports invariants of a viscous strain without `ViscousStrain`, E:Γ, which drives it.
pub(super) fn check_flow(cx: &Ctxt, input: &Input<'_>) {
    let driven = of_role(input, Role::Joint(Joint::Strain)).count() > 0;
    if driven || !input.arguments_complete {
        return;
    }
    for (ident, role) in measures(input).filter(|(_, role)| role.joint().is_some()) {
        cx.error(ident, &message::flow_without_strain(ident, role));
    }
}

/// Reports a second argument of a role. Only dashpots and fibres may be several.
pub(super) fn check_counts(cx: &Ctxt, input: &Input<'_>) {
    for role in Role::ALL.into_iter().filter(|role| !role.is_repeatable()) {
        let mut arguments = of_role(input, role);
        if let Some(first) = arguments.next() {
            for second in arguments {
                let message = message::second_role(role, second.ident, first.ident);
                cx.error(second.ident, &message);
            }
        }
    }
}

/// Whether there are one stretch or different strains, at most one temperature, no viscous strain that
/// nothing drives, and different names.
pub(super) fn are_sound(input: &Input<'_>) -> bool {
    let count = |role| of_role(input, role).count();
    let names = input.arguments.iter().map(|argument| argument.ident);
    let names: BTreeSet<String> = names.map(ast::name).collect();
    let strains = Strain::ALL
        .map(Role::Strain)
        .map(|role| (role, count(role)));
    let strained = strains.iter().any(|&(_, count)| count > 0);
    let may_be = |&(role, count): &(Role, usize)| count <= 1 || role.is_repeatable();
    let joints = Joint::ALL.map(Role::Joint).map(|role| (role, count(role)));
    let flows = joints.iter().any(|&(_, count)| count > 0);
    let driven = strained && count(Role::Joint(Joint::Strain)) > 0;
    input.arguments_complete
        && count(Role::Stretch) == usize::from(!strained)
        && strains.iter().chain(&joints).all(may_be)
        && (!flows || driven)
        && count(Role::Temperature) <= 1
        && names.len() == input.arguments.len()
}

fn of_role<'i, 'a>(input: &'i Input<'a>, role: Role) -> impl Iterator<Item = &'i Argument<'a>> {
    let arguments = input.arguments.iter();
    arguments.filter(move |argument| argument.role == Some(role))
}

fn measures<'a>(input: &Input<'a>) -> impl Iterator<Item = (&'a Ident, Role)> {
    let arguments = input.arguments.iter();
    let roles = arguments.filter_map(|argument| Some((argument.ident, argument.role?)));
    roles.filter(|(_, role)| role.is_measure())
}
