//! Runs the phases one after the other; the model is printed only if none has reported an error.

use eem_symbolic::Model;
use proc_macro2::TokenStream;
use quote::quote;
use syn::DeriveInput;

use crate::attr::Attributes;
use crate::checked::Checked;
use crate::ctxt::Ctxt;
use crate::dialect::Dialect;
use crate::fallback::Shape;
use crate::units::Units;
use crate::{check, expand, fallback, model, parse, physics, units, warnings};

/// The code that `#[derive(FreeEnergy)]` generates for a struct, or the errors of all phases as `compile_error!`,
/// together with an implementation that does nothing.
///
/// A phase leaves a hole where it reported something, and the phases after it look at the rest.
///
/// With the feature `gradients` the code contains derivatives with respect to the parameters.
#[must_use]
pub fn derive(input: &DeriveInput) -> TokenStream {
    derive_with(input, cfg!(feature = "gradients"))
}

/// The same, with derivatives with respect to the parameters if `gradients` is true.
pub(crate) fn derive_with(input: &DeriveInput, gradients: bool) -> TokenStream {
    let cx = Ctxt::new(Dialect::Attribute);
    let attributes = Attributes::from_syn(&cx, input);
    let parsed = parse::input(&cx, input, &attributes);
    let mut shape = parsed.as_ref().map_or_else(Shape::default, Shape::new);
    let checked = parsed.as_ref().map(|parsed| check::check(&cx, parsed));
    shape.mention(checked.iter().flat_map(Checked::constants));
    let model = checked.as_ref().and_then(|checked| model(&cx, checked));
    let warnings = warnings::warnings(&cx.take_warnings());
    let implementation = cx
        .barrier(checked.as_ref().zip(model))
        .and_then(|(checked, (model, units))| {
            let programs = model.programs();
            let derivatives = gradients.then(|| model.parameter_programs(&programs));
            physics::check_programs(&cx, checked, &programs, derivatives.as_ref());
            cx.barrier(Some(()))?;
            let derivatives = derivatives.as_ref();
            let code = expand::expand(checked, &model, &programs, derivatives, &units);
            Ok(code)
        })
        .unwrap_or_else(|error| fallback::expand(input, &attributes.krate, &shape, &error));
    quote! { #warnings #implementation }
}

/// The model and its units; `None` if a reported error leaves no model.
pub(crate) fn model(cx: &Ctxt, checked: &Checked<'_>) -> Option<(Model, Units)> {
    let units = units::check(cx, checked);
    let model = model::lower(cx, checked)?;
    if checked.sound {
        physics::check(cx, checked, &model);
    }
    Some((model, units))
}
