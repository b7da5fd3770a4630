//! Messages about the attributes, the arguments of the closure and the viscosity laws.

use std::fmt::Display;

use proc_macro2::Ident;

use super::{Message, alternatives, list, said};
use crate::ast::{self, Joint, Role, Strain};

pub(crate) mod physics;

pub(crate) fn missing_free_energy(item: &Ident) -> Message {
    Message::new(
        format!("`{item}` has no free energy"),
        said(|d| format!("write {} on top of the {}", d.closure(), d.item())),
    )
}

pub(crate) fn second_free_energy() -> Message {
    Message::new(
        "a second free energy",
        said(|d| {
            let (item, derive) = (d.item(), d.choose("derive for", "write"));
            let one = d.choose(d.free_energy(), "closure");
            format!("a {item} has one {one}; add the terms, or {derive} another {item}")
        }),
    )
}

pub(crate) fn empty_free_energy() -> Message {
    Message::new(
        said(|d| format!("{} without a closure", d.free_energy())),
        said(|d| format!("write {}", d.closure())),
    )
}

pub(crate) fn unreadable_free_energy(error: &syn::Error) -> Message {
    Message::new(
        format!("cannot read the free energy: {error}"),
        said(|d| format!("it is a closure with typed arguments, {}", d.closure())),
    )
}

pub(crate) fn unreadable_formula(error: &syn::Error) -> Message {
    let error = error.to_string();
    // The parser expects `,` between the entries of an attribute and `;` between statements, but here
    // the formula should have continued.
    let text = if error.ends_with("expected `,`") || error.ends_with("expected `;`") {
        "cannot read the formula from here on".to_owned()
    } else {
        format!("cannot read the formula: {error}")
    };
    Message::new(
        text,
        "between two values is an operator, `2 * x`; a function has parentheses, `ln(x)`; `let` and `;` need braces, `|…| { let …; value }`; `|x|` is `abs(x)`",
    )
}

pub(crate) fn too_deep() -> Message {
    Message::new(
        "the formula is nested too deeply to be read",
        "bind its parts with `let`",
    )
}

pub(crate) fn too_many_terms(terms: usize, limit: usize) -> Message {
    Message::new(
        format!(
            "this sum has {terms} terms, more than the {} that are possible",
            limit + 1
        ),
        "bind parts of it with `let`",
    )
}

pub(crate) fn after_the_closure() -> Message {
    Message::new(
        "nothing may follow the closure of the free energy",
        "remove it; the decimal point is `.`, not `,`",
    )
}

pub(crate) fn free_energy_is_not_a_closure() -> Message {
    Message::new(
        "the free energy must be a closure, whose arguments have roles",
        said(|d| format!("write {}", d.closure())),
    )
}

pub(crate) fn unknown_option(name: impl Display) -> Message {
    Message::new(
        said(|d| format!("{} has no option `{name}`", d.free_energy())),
        said(|d| {
            let there_is = d.choose("`crate = path`, and the closure: ", "only its closure, ");
            format!("there is {there_is}{}", d.closure())
        }),
    )
}

pub(crate) fn second_crate() -> Message {
    Message::new(
        "a second `crate = …`",
        "the path of the crate is given once per struct",
    )
}

pub(crate) fn crate_is_not_a_path() -> Message {
    Message::new(
        "this is not the path of a crate",
        "write `crate = ::eem` without quotes, and a comma before the closure",
    )
}

pub(crate) fn argument_without_role(argument: &str) -> Message {
    let help = match Role::usual(argument) {
        Some(role @ Role::Strain(_)) => format!(
            "say what it stands for, in a solid `{argument}: {}`",
            role.name()
        ),
        usual => {
            let mut roles = vec![Role::Stretch, Role::Viscous, Role::Temperature];
            roles.sort_by_key(|role| Some(*role) != usual);
            let roles = roles.into_iter().map(Role::name);
            let roles: Vec<String> = roles.map(|role| format!("{argument}: {role}")).collect();
            let roles = alternatives(roles.iter().map(String::as_str));
            format!("say what it stands for: {roles}")
        }
    };
    Message::new(format!("the argument `{argument}` has no role"), help)
}

pub(crate) fn argument_pattern() -> Message {
    Message::new(
        "this argument of the free energy is not a plain name",
        "write `name: Role`, for example `lambda: Stretch`",
    )
}

/// `meant` are the roles that may have been meant.
pub(crate) fn unknown_role(role: &str, meant: &[&str]) -> Message {
    let help = match meant {
        [_, ..] => format!("did you mean {}?", alternatives(meant.iter().copied())),
        [] => format!(
            "the roles are {}, as bare words",
            list(Role::ALL.map(Role::name))
        ),
    };
    Message::new(format!("unknown role `{role}`"), help)
}

pub(crate) fn no_measure() -> Message {
    Message::new(
        "the free energy has neither a `Stretch` nor a strain",
        "add an argument: `lambda: Stretch` is the length of a spring; `e1: StrainTrace`, `e2: StrainSquare`, `j: Dilatation` and `e4: FibreStrain` are strains of a solid",
    )
}

/// The later one of two measures comes first here.
pub(crate) fn spring_and_solid([later, first]: [&Ident; 2], roles: [Role; 2]) -> Message {
    let [later, first] = [later, first].map(ast::name);
    let [its_role, role] = roles.map(Role::name);
    Message::new(
        format!("`{later}` is a `{its_role}` after the `{role}` `{first}`"),
        "a spring has one `Stretch` and no strain, a solid has strains and no `Stretch`",
    )
}

/// `role` is one of a viscous strain that nothing drives.
pub(crate) fn flow_without_strain(argument: &Ident, role: Role) -> Message {
    let name = ast::name(argument);
    Message::new(
        format!(
            "`{name}` is a `{}`, but no `ViscousStrain` drives the viscous strain Γ",
            role.name()
        ),
        said(|d| {
            let law = d.choose("its viscosity, `#[viscosity(m3 = …)]`", "its viscosity");
            format!("add the argument `m3: ViscousStrain`, which is E:Γ, and {law}")
        }),
    )
}

pub(crate) fn second_role(role: Role, argument: &Ident, first: &Ident) -> Message {
    let (argument, first) = (ast::name(argument), ast::name(first));
    let help = match role {
        Role::Stretch => "a spring has one length; an internal variable is `Viscous`",
        Role::Strain(Strain::Fibre) | Role::Viscous => unreachable!("there may be many"),
        Role::Strain(_) => "every strain is one argument; remove one of the two",
        Role::Joint(_) => {
            "a solid has one viscous strain; remove one of the two, or make it `Viscous`"
        }
        Role::Temperature => "an element has one temperature",
    };
    Message::new(
        format!("`{argument}` is a second `{}` after `{first}`", role.name()),
        help,
    )
}

pub(crate) fn second_argument(argument: &Ident) -> Message {
    let name = ast::name(argument);
    Message::new(
        format!("`{name}` is already an argument"),
        "give every argument its own name",
    )
}

pub(crate) fn argument_hides_field(argument: &Ident) -> Message {
    let name = ast::name(argument);
    Message::new(
        said(|d| {
            let field = d.choose("a field of the struct", "a parameter");
            format!("`{name}` is an argument here and {field}")
        }),
        said(|d| {
            let unless = d.choose(
                "; a field that is no parameter can be marked with `#[free_energy(unused)]`",
                "",
            );
            format!("rename one of them{unless}")
        }),
    )
}

pub(crate) fn empty_viscosity() -> Message {
    Message::new(
        "`#[viscosity]` without a law",
        "write `#[viscosity(gamma = …)]` with the name of a `Viscous` argument or of the `Stretch`",
    )
}

pub(crate) fn unreadable_viscosity(error: &syn::Error) -> Message {
    Message::new(
        format!("cannot read the viscosity: {error}"),
        "it is a list of `dashpot = expression`, for example `#[viscosity(gamma = eta_ref)]`",
    )
}

pub(crate) fn missing_viscosity(dashpot: &Ident, role: Role, unit: &str) -> Message {
    let name = ast::name(dashpot);
    let what = match role {
        Role::Joint(Joint::Strain) => "the deviatoric flow of",
        Role::Joint(Joint::Trace) => "the volumetric flow of",
        Role::Stretch
        | Role::Strain(_)
        | Role::Joint(Joint::Square)
        | Role::Viscous
        | Role::Temperature => "the dashpot",
    };
    Message::new(
        format!("{what} `{name}` has no viscosity law"),
        said(|d| format!("{}, in {unit}", d.law(&name))),
    )
}

pub(crate) fn second_viscosity(dashpot: &Ident) -> Message {
    let name = ast::name(dashpot);
    Message::new(
        format!("a second viscosity for `{name}`"),
        "a dashpot has one law; remove one of them",
    )
}

pub(crate) fn viscosity_without_dashpot<'n>(
    name: &Ident,
    nearest: Option<&str>,
    dashpots: impl IntoIterator<Item = &'n str>,
) -> Message {
    let name = ast::name(name);
    let mut dashpots = dashpots.into_iter().peekable();
    let help = match nearest {
        Some(nearest) => format!("did you mean `{nearest}`?"),
        None if dashpots.peek().is_none() => {
            format!("remove the law, or declare `{name}: Viscous` in the free energy")
        }
        None => format!("the free energy has {}", list(dashpots)),
    };
    Message::new(format!("there is no dashpot `{name}`"), help)
}

pub(crate) fn viscosity_of_another_role(name: &Ident, role: Role) -> Message {
    let name = ast::name(name);
    Message::new(
        format!("`{name}` has no viscosity: it is a `{}`", role.name()),
        "only arguments of role `Viscous`, `ViscousStrain`, `ViscousTrace` and `Stretch` have one",
    )
}
