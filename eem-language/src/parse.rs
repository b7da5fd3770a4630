//! Parse phase: syntax trees → [`ast`](crate::ast).
//!
//! Refuses everything a free energy cannot contain, at the token that is in the way. Names are
//! resolved in the check phase.

mod block;
mod closure;
mod expr;
mod helper;
mod item;
mod modifiers;
mod name;
mod number;
mod unsupported;

use syn::DeriveInput;

use crate::ast::{Input, Law};
use crate::attr::Attributes;
use crate::ctxt::Ctxt;

/// Reads a whole item. `None` only if there is no closure to read, which has been reported.
pub(crate) fn input<'a>(
    cx: &Ctxt,
    input: &'a DeriveInput,
    attributes: &'a Attributes,
) -> Option<Input<'a>> {
    let fields = item::fields(cx, input);
    let laws = attributes.laws.iter();
    let laws = laws.map(|(dashpot, value)| Law {
        dashpot,
        value: expr::expr(cx, value),
    });
    let laws = laws.collect();
    let closure = attributes.closure.as_ref()?;
    let arguments = closure::arguments(cx, closure);
    let arguments_complete = arguments.len() == closure.inputs.len()
        && arguments.iter().all(|argument| argument.role.is_some());
    Some(Input {
        original: input,
        krate: &attributes.krate,
        fields,
        arguments,
        arguments_complete,
        energy: block::body(cx, &closure.body),
        closure,
        laws,
        laws_complete: attributes.laws_complete,
    })
}
