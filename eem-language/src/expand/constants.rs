//! The shape of a model: associated constants and types, and its parameters.

use eem_symbolic::Programs;
use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::forms::{kept, kept_in_entropy_form};
use super::inputs::Inputs;
use crate::ast;
use crate::checked::Checked;
use crate::units::Units;

// Expands to:
//
//     const MEASURES: usize = 1; …
//     type Variables = [__S; 3]; …
//     fn parameter(&self, index: usize) -> __S { [self.stiffness, …][index] }
pub(super) fn constants(
    checked: &Checked<'_>,
    programs: &Programs,
    inputs: &Inputs,
    units: &Units,
) -> TokenStream {
    let types = types(programs, inputs);
    let (dashpots, thermal) = (Literal::usize_unsuffixed(inputs.dashpots), inputs.thermal);
    let measures = Literal::usize_unsuffixed(inputs.measures());
    let per_volume = per_volume(checked.per_volume());
    let constant_capacity = programs.has_constant_capacity.then(|| {
        quote! { const HAS_CONSTANT_CAPACITY: __eem::core::primitive::bool = true; }
    });
    let name = ast::name(&checked.original.ident);
    let names = checked.parameters.iter().map(|p| &p.name);
    let units = parameter_units(checked, units);
    let (scalar, parameters) = (&inputs.scalar, &inputs.parameters);
    let count = Literal::usize_unsuffixed(parameters.len());
    quote! {
        const MEASURES: __eem::core::primitive::usize = #measures;
        const DASHPOTS: __eem::core::primitive::usize = #dashpots;
        const THERMAL: __eem::core::primitive::bool = #thermal;
        #per_volume
        #constant_capacity
        const MODEL: &'static __eem::core::primitive::str = #name;
        const PARAMETERS: &'static [&'static __eem::core::primitive::str] = &[#(#names),*];
        #units

        #types

        fn parameter(&self, __index: __eem::core::primitive::usize) -> #scalar {
            let __parameters: [#scalar; #count] = [#(#parameters),*];
            __parameters[__index]
        }
    }
}

/// `None` for a model without units, which is the default of the trait.
fn parameter_units(checked: &Checked<'_>, units: &Units) -> Option<TokenStream> {
    let parameters = checked.parameters.iter();
    let units: Vec<_> = parameters
        .map(|parameter| units.of(parameter.origin))
        .collect();
    units.iter().any(Option::is_some).then(|| {
        let units = units.into_iter().map(Option::unwrap_or_default);
        quote! {
            const PARAMETER_UNITS: &'static [&'static __eem::core::primitive::str] = &[#(#units),*];
        }
    })
}

/// `None` for a spring, which is the default of the trait.
pub(crate) fn per_volume(per_volume: bool) -> Option<TokenStream> {
    per_volume.then(|| quote! { const PER_VOLUME: __eem::core::primitive::bool = true; })
}

fn types(programs: &Programs, inputs: &Inputs) -> TokenStream {
    let scalar = &inputs.scalar;
    let array = |length: usize| {
        let length = Literal::usize_unsuffixed(length);
        quote!([#scalar; #length])
    };
    let matrix = |rows: usize| {
        let (row, rows) = (array(inputs.variables), Literal::usize_unsuffixed(rows));
        quote!([#row; #rows])
    };
    let parameters = array(inputs.parameters.len());
    let (variables, hessian) = (array(inputs.variables), matrix(inputs.variables));
    let (viscosities, drag) = (array(inputs.viscosities), array(inputs.drags));
    let corners = array(inputs.corners());
    let (response, tangent) = (array(inputs.responses()), matrix(inputs.responses()));
    let entropy = array(kept_in_entropy_form(programs, inputs));
    let temperature = programs
        .temperature_form
        .as_ref()
        .unwrap_or(&programs.entropy_form);
    let temperature = array(kept(temperature, inputs).len());
    quote! {
        type Parameters = #parameters;
        type Variables = #variables;
        type Hessian = #hessian;
        type Viscosities = #viscosities;
        type Drag = #drag;
        type Corners = #corners;
        type Response = #response;
        type Tangent = #tangent;
        type EntropyFormOld = #entropy;
        type TemperatureFormOld = #temperature;
    }
}
