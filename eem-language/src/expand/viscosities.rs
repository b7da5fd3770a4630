//! The viscosities: those of the dashpots, and that of the stretch.

use std::collections::BTreeMap;

use eem_symbolic::{Program, Programs};
use proc_macro2::TokenStream;
use quote::quote;

use super::docs;
use super::inputs::Inputs;
use super::statements::{Statements, value};

/// The functions `viscosity` and `drag`.
pub(super) fn viscosities(programs: &Programs, inputs: &Inputs) -> TokenStream {
    let viscosity = viscosity(programs.viscosity.as_ref(), inputs);
    let drag = drag(programs.drag.as_ref(), inputs);
    quote! { #viscosity #drag }
}

// Expands to: `fn viscosity(&self, __theta: __S) -> (Self::Viscosities, Self::Viscosities) { … }`.
fn viscosity(program: Option<&Program>, inputs: &Inputs) -> TokenStream {
    let scalar = &inputs.scalar;
    let Some(program) = program else {
        return quote! {
            /// There is no dashpot: nothing.
            fn viscosity(&self, _: #scalar) -> (Self::Viscosities, Self::Viscosities) {
                ([], [])
            }
        };
    };
    let docs = docs::function("Viscosities η and dη/dθ.", program);
    let (theta, body) = body(program, inputs, inputs.viscosities);
    quote! {
        #docs
        fn viscosity(&self, #theta: #scalar) -> (Self::Viscosities, Self::Viscosities) { #body }
    }
}

// Expands to: `fn drag(&self, __theta: __S) -> (Self::Drag, Self::Drag) { … }`.
fn drag(program: Option<&Program>, inputs: &Inputs) -> TokenStream {
    let scalar = &inputs.scalar;
    let Some(program) = program else {
        return quote! {
            /// No dashpot stands beside the spring: nothing.
            fn drag(&self, _: #scalar) -> (Self::Drag, Self::Drag) {
                ([], [])
            }
        };
    };
    let docs = docs::function("Viscosity η of the stretch and dη/dθ.", program);
    let (theta, body) = body(program, inputs, inputs.drags);
    quote! {
        #docs
        fn drag(&self, #theta: #scalar) -> (Self::Drag, Self::Drag) { #body }
    }
}

// Expands to: `__theta` and `let __v0 = __theta; … ([__v7], [__v8])`.
fn body(program: &Program, inputs: &Inputs, count: usize) -> (TokenStream, TokenStream) {
    let lets = Statements {
        program,
        scalar: &inputs.scalar,
        input: Box::new(|index| inputs.viscosity(index)),
        known: BTreeMap::new(),
    }
    .lets(|_, _| true);
    let outputs: Vec<_> = program
        .outputs
        .iter()
        .map(|&output| value(output))
        .collect();
    let (viscosities, derivatives) = outputs.split_at(count);
    let theta = if inputs.thermal {
        quote!(__theta)
    } else {
        quote!(_)
    };
    let body = quote! {
        #lets
        ([#(#viscosities),*], [#(#derivatives),*])
    };
    (theta, body)
}
