//! The closure of a free energy: its arguments with their roles.

use quote::ToTokens;
use syn::{ExprClosure, Pat, PatIdent, PatType, ReturnType, Type};

use super::modifiers::check_modifiers;
use super::name::plain_name;
use crate::ast::{Argument, Joint, Role, Strain};
use crate::ctxt::Ctxt;
use crate::message::attribute as message;
use crate::message::expression::syntax::not_allowed;
use crate::nearest::nearest;

/// The arguments whose names can be read; reports the others.
pub(super) fn arguments<'a>(cx: &Ctxt, closure: &'a ExprClosure) -> Vec<Argument<'a>> {
    check_modifiers(cx, closure);
    if let ReturnType::Type(arrow, _) = &closure.output {
        cx.error(arrow, &not_allowed("a return type"));
    }
    let arguments = closure.inputs.iter();
    arguments.filter_map(|pat| argument(cx, pat)).collect()
}

fn argument<'a>(cx: &Ctxt, pat: &'a Pat) -> Option<Argument<'a>> {
    match pat {
        Pat::Type(PatType { pat, ty, .. }) => {
            let ident = plain_name(cx, pat, message::argument_pattern);
            let role = role(cx, ident, ty);
            ident.map(|ident| Argument { ident, role })
        }
        Pat::Ident(PatIdent { ident, .. }) => {
            let name = crate::ast::name(ident);
            cx.error(ident, &message::argument_without_role(&name));
            Some(Argument { ident, role: None })
        }
        other => {
            cx.error(other, &message::argument_pattern());
            None
        }
    }
}

/// Other words for the roles.
const SYNONYMS: [(&[&str], &[Role]); 9] = [
    (&["Length", "Elongation", "Lambda"], &[Role::Stretch]),
    (
        &["Strain"],
        &[
            Role::Stretch,
            Role::Strain(Strain::Trace),
            Role::Strain(Strain::Square),
            Role::Strain(Strain::Dilatation),
            Role::Strain(Strain::Fibre),
        ],
    ),
    (
        &["Trace", "FirstInvariant", "I1", "E1"],
        &[Role::Strain(Strain::Trace)],
    ),
    (
        &["Square", "SecondInvariant", "I2", "E2"],
        &[Role::Strain(Strain::Square)],
    ),
    (
        &[
            "Jacobian",
            "Determinant",
            "Volume",
            "VolumeChange",
            "ThirdInvariant",
            "I3",
            "J",
        ],
        &[Role::Strain(Strain::Dilatation)],
    ),
    (
        &[
            "Fibre",
            "Fiber",
            "FiberStrain",
            "FourthInvariant",
            "I4",
            "E4",
        ],
        &[Role::Strain(Strain::Fibre)],
    ),
    (
        &["ViscousTensor", "InternalStrain", "InelasticStrain", "M3"],
        &[Role::Joint(Joint::Strain)],
    ),
    (
        &["Dashpot", "Internal", "Damper", "Gamma"],
        &[Role::Viscous],
    ),
    (&["Temp", "Theta"], &[Role::Temperature]),
];

fn role(cx: &Ctxt, argument: Option<&syn::Ident>, ty: &Type) -> Option<Role> {
    let name = match ty {
        Type::Group(group) => return role(cx, argument, &group.elem),
        Type::Path(path) => path.path.get_ident(),
        _ => None,
    };
    let role = name.and_then(|name| Role::ALL.into_iter().find(|role| name == role.name()));
    if role.is_some() {
        return role;
    }
    let text = ty.to_token_stream().to_string().replace(' ', "");
    match argument {
        // The type of the value in place of its role.
        Some(argument) if text == "f64" || text == "f32" || text == "_" => {
            let name = crate::ast::name(argument);
            cx.error(ty, &message::argument_without_role(&name));
        }
        _ => {
            let word = last_word(ty).unwrap_or_default();
            cx.error(ty, &message::unknown_role(&text, &meant(&word)));
        }
    }
    None
}

/// The roles that may have been meant by a word.
fn meant(word: &str) -> Vec<&'static str> {
    let synonym = SYNONYMS.iter().find(|(words, _)| words.contains(&word));
    match synonym {
        Some((_, roles)) => roles.iter().map(|role| role.name()).collect(),
        None => nearest(word, Role::ALL.map(Role::name))
            .into_iter()
            .collect(),
    }
}

/// The name at the end of a path, also behind a reference.
fn last_word(ty: &Type) -> Option<String> {
    match ty {
        Type::Group(group) => last_word(&group.elem),
        Type::Reference(reference) => last_word(&reference.elem),
        Type::Path(path) => Some(path.path.segments.last()?.ident.to_string()),
        _ => None,
    }
}
