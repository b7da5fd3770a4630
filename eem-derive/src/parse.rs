//! Parse phase: syntax trees → [`ast`](crate::ast).
//!
//! Refuses everything a free energy cannot contain, at the token that is in the way. What comes
//! out is complete; whether the names in it mean something is the question of the check phase.

mod block;
mod closure;
mod expr;
mod item;
mod number;
mod unsupported;

use syn::DeriveInput;

use crate::ast::{Input, Law};
use crate::attr::Attributes;
use crate::ctxt::Ctxt;

/// Reads a whole item. Nothing only if something was reported.
pub(crate) fn input<'a>(
    cx: &Ctxt,
    input: &'a DeriveInput,
    attributes: &'a Attributes,
) -> Option<Input<'a>> {
    let fields = item::fields(cx, input);
    let laws = laws(cx, attributes);
    let closure = attributes.closure.as_ref()?;
    let arguments = closure::arguments(cx, closure);
    let energy = closure::body(cx, closure);
    Some(Input {
        original: input,
        krate: &attributes.krate,
        fields: fields?,
        arguments,
        energy: energy?,
        closure,
        laws,
    })
}

fn laws<'a>(cx: &Ctxt, attributes: &'a Attributes) -> Vec<Law<'a>> {
    let law = |(dashpot, value)| {
        Some(Law {
            dashpot,
            value: expr::expr(cx, value)?,
        })
    };
    let pairs = attributes
        .laws
        .iter()
        .map(|(dashpot, value)| (dashpot, value));
    pairs.filter_map(law).collect()
}
