//! What a wrong model expands to: its errors, and an implementation that does nothing.
//!
//! Without the implementation every use of the type would add "the trait `FreeEnergy` is not
//! implemented" to the one message that matters.

use proc_macro2::TokenStream;
use quote::quote;
use syn::{DeriveInput, Path};

use crate::ast;
use crate::checked::Scalar;
use crate::expand::{Header, description, wrap};

/// The errors and a stub.
pub(crate) fn expand(input: &DeriveInput, krate: &Path, error: &syn::Error) -> TokenStream {
    let errors = error.to_compile_error();
    let header = Header::new(input, Scalar::Any);
    let implementation = header.implementation(&body(&header.scalar));
    let description = empty_description(input);
    let stub = wrap(krate, &quote! { #implementation #description });
    quote! { #errors #stub }
}

// Expands to: a description without content.
fn empty_description(input: &DeriveInput) -> TokenStream {
    let name = ast::name(&input.ident);
    let body = quote! {
        const DESCRIPTION: __eem::Description = __eem::Description::new(#name);
    };
    description::implementation(input, &body)
}

// Expands to: the smallest model there can be, whose functions are never run because the program
// does not compile.
fn body(scalar: &TokenStream) -> TokenStream {
    let never = quote! { __eem::core::panic!("the free energy has errors") };
    quote! {
        const MEASURES: __eem::core::primitive::usize = 1;
        const DASHPOTS: __eem::core::primitive::usize = 0;
        const THERMAL: __eem::core::primitive::bool = false;
        const PARAMETERS: &'static [&'static __eem::core::primitive::str] = &[];

        type Variables = [#scalar; 1];
        type Hessian = [[#scalar; 1]; 1];
        type Viscosities = [#scalar; 0];
        type Corners = [#scalar; 0];
        type Response = [#scalar; 1];
        type Tangent = [[#scalar; 1]; 1];
        type EntropyFormOld = [#scalar; 0];
        type TemperatureFormOld = [#scalar; 0];

        fn parameter(&self, _: __eem::core::primitive::usize) -> #scalar { #never }
        fn free_energy(&self, _: &Self::Variables) -> #scalar { #never }
        fn internal_energy(&self, _: &Self::Variables) -> #scalar { #never }
        fn gradient(&self, _: &Self::Variables) -> Self::Variables { #never }
        fn hessian(&self, _: &Self::Variables) -> (Self::Variables, Self::Hessian) { #never }
        fn caloric(&self, _: &Self::Variables) -> __eem::Caloric<#scalar> { #never }
        fn entropy_hessian(&self, _: &Self::Variables) -> Self::Hessian { #never }
        fn viscosity(&self, _: #scalar) -> (Self::Viscosities, Self::Viscosities) { #never }
        fn entropy_form_old(&self, _: &Self::Variables) -> Self::EntropyFormOld { #never }
        fn entropy_form(
            &self,
            _: &Self::EntropyFormOld,
            _: &Self::Variables,
            _: &Self::Corners,
        ) -> (Self::Response, Self::Tangent) { #never }
        fn temperature_form_old(&self, _: &Self::Variables) -> Self::TemperatureFormOld { #never }
        fn temperature_form(
            &self,
            _: &Self::TemperatureFormOld,
            _: &Self::Variables,
        ) -> (Self::Response, Self::Tangent) { #never }
    }
}
