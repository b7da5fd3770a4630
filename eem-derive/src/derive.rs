//! Runs the phases one after the other, with a barrier after each.

use proc_macro2::TokenStream;
use syn::DeriveInput;

use crate::attr::Attributes;
use crate::ctxt::Ctxt;
use crate::{check, expand, fallback, model, parse, units};

/// The implementation of the trait, or all errors of the first phase that found any together with
/// an implementation that does nothing.
pub(crate) fn derive(input: &DeriveInput) -> TokenStream {
    let cx = Ctxt::new();
    let attributes = Attributes::from_syn(&cx, input);
    try_derive(&cx, input, &attributes)
        .unwrap_or_else(|error| fallback::expand(input, &attributes.krate, &error))
}

fn try_derive(cx: &Ctxt, input: &DeriveInput, attributes: &Attributes) -> syn::Result<TokenStream> {
    let parsed = cx.barrier(parse::input(cx, input, attributes))?;
    let checked = cx.barrier(check::check(cx, &parsed))?;
    let units = units::check(cx, &checked);
    let model = cx.barrier(model::lower(cx, &checked))?;
    Ok(expand::expand(&checked, &model, &units))
}
