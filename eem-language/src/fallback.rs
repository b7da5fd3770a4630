//! The expansion of an invalid model: its errors, and a stub of the implementation.
//!
//! Without the stub every use of the type would add "the trait `FreeEnergy` is not implemented" to
//! the messages that matter. The stub has arrays of the lengths that the closure declares: otherwise
//! every array of a state would add a type mismatch.

use proc_macro2::{Literal, TokenStream};
use quote::quote;
use syn::{DeriveInput, Path};

use crate::ast::{self, Input, Role, Strain};
use crate::checked::Scalar;
use crate::expand::{Header, constants::per_volume, description, strains, wrap};

/// The numbers of variables that the closure declares, as far as it could be read.
#[derive(Clone, Debug, Default)]
pub(crate) struct Shape {
    strains: Vec<Strain>,
    dashpots: usize,
    thermal: bool,
    constants: Vec<TokenStream>,
}

impl Shape {
    /// Counts the arguments of the closure by role.
    pub(crate) fn new(input: &Input<'_>) -> Self {
        let count = |role| {
            input
                .arguments
                .iter()
                .filter(|a| a.role == Some(role))
                .count()
        };
        let strain = |strain: Strain| {
            let role = Role::Strain(strain);
            let most = if role.is_repeatable() { usize::MAX } else { 1 };
            core::iter::repeat_n(strain, count(role).min(most))
        };
        Self {
            strains: Strain::ALL.into_iter().flat_map(strain).collect(),
            dashpots: count(Role::Viscous),
            thermal: count(Role::Temperature) > 0,
            constants: Vec::new(),
        }
    }

    /// Uses the constants of the formulas in the stub, so that Rust also reports those that do not exist.
    pub(crate) fn mention<'c>(&mut self, constants: impl Iterator<Item = &'c TokenStream>) {
        self.constants.extend(constants.cloned());
    }
}

/// The errors and a stub.
pub(crate) fn expand(
    input: &DeriveInput,
    krate: &Path,
    shape: &Shape,
    error: &syn::Error,
) -> TokenStream {
    let errors = error.to_compile_error();
    let header = Header::new(input, Scalar::Any);
    let name = ast::name(&input.ident);
    let implementation = header.implementation(&body(&header.scalar, &name, shape));
    let strains = strains::stub(input, shape.strains.iter().copied());
    let description = empty_description(input);
    let stub = wrap(krate, &quote! { #implementation #strains #description });
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

// Expands to: a model whose functions are never run because the program does not compile.
fn body(scalar: &TokenStream, name: &str, shape: &Shape) -> TokenStream {
    let mentioned = shape.constants.iter();
    let mentioned = mentioned.map(|path| {
        quote! { let _: __eem::core::primitive::f64 = __eem::core::convert::From::from(#path); }
    });
    let shape = constants(scalar, name, shape);
    let never = quote! { __eem::core::panic!("the free energy has errors") };
    quote! {
        #shape
        fn duplicate(&self) -> Self { #never }
        fn parameter(&self, _: __eem::core::primitive::usize) -> #scalar {
            #(#mentioned)*
            #never
        }
        fn free_energy(&self, _: &Self::Variables) -> #scalar { #never }
        fn energy_magnitude(&self, _: &Self::Variables) -> #scalar { #never }
        fn internal_energy(&self, _: &Self::Variables) -> #scalar { #never }
        fn gradient(&self, _: &Self::Variables) -> Self::Variables { #never }
        fn hessian(&self, _: &Self::Variables) -> (Self::Variables, Self::Hessian) { #never }
        fn caloric(&self, _: &Self::Variables) -> __eem::Caloric<#scalar> { #never }
        fn entropy_hessian(&self, _: &Self::Variables) -> Self::Hessian { #never }
        fn viscosity(&self, _: #scalar) -> (Self::Viscosities, Self::Viscosities) { #never }
        fn drag(&self, _: #scalar) -> (Self::Drag, Self::Drag) { #never }
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

fn constants(scalar: &TokenStream, name: &str, shape: &Shape) -> TokenStream {
    let &Shape {
        ref strains,
        dashpots,
        thermal,
        ..
    } = shape;
    let measures = strains.len().max(1);
    let variables = measures + dashpots + usize::from(thermal);
    let array = |length: usize| {
        let length = Literal::usize_unsuffixed(length);
        quote!([#scalar; #length])
    };
    let matrix = |rows: usize| {
        let (row, rows) = (array(variables), Literal::usize_unsuffixed(rows));
        quote!([#row; #rows])
    };
    let corners = if thermal { 2 * (variables - 1) } else { 0 };
    let responses = variables + usize::from(thermal);
    let (state, hessian, viscosities) = (array(variables), matrix(variables), array(dashpots));
    let (corners, nothing) = (array(corners), array(0));
    let (response, tangent) = (array(responses), matrix(responses));
    let [measures, dashpots] = [measures, dashpots].map(Literal::usize_unsuffixed);
    let per_volume = per_volume(!strains.is_empty());
    quote! {
        const MEASURES: __eem::core::primitive::usize = #measures;
        const DASHPOTS: __eem::core::primitive::usize = #dashpots;
        const THERMAL: __eem::core::primitive::bool = #thermal;
        #per_volume
        const MODEL: &'static __eem::core::primitive::str = #name;
        const PARAMETERS: &'static [&'static __eem::core::primitive::str] = &[];

        type Parameters = #nothing;
        type Variables = #state;
        type Hessian = #hessian;
        type Viscosities = #viscosities;
        type Drag = #nothing;
        type Corners = #corners;
        type Response = #response;
        type Tangent = #tangent;
        type EntropyFormOld = #nothing;
        type TemperatureFormOld = #nothing;
    }
}
