//! The functions from which the rates of a state follow: forces, heat capacity, slopes of the entropy.

use std::collections::BTreeMap;

use eem_symbolic::{Program, Programs, Stage};
use proc_macro2::TokenStream;
use quote::{ToTokens as _, quote};

use super::docs;
use super::inputs::Inputs;
use super::statements::{Statements, value};

/// The functions `rates` and `rates_at`.
pub(super) fn rates(programs: &Programs, inputs: &Inputs) -> TokenStream {
    let rates = at_state(&programs.rates, inputs);
    let rates_at = at_temperature(&programs.rates_at, inputs);
    quote! { #rates #rates_at }
}

// Expands to: `let __v0 = …; __eem::Rates { forces: [__v7, __v8], slopes: [__v9, __zero] }`.
fn at_state(program: &Program, inputs: &Inputs) -> TokenStream {
    let lets = Statements {
        program,
        scalar: &inputs.scalar,
        input: Box::new(|index| inputs.point(index)),
        known: BTreeMap::new(),
    }
    .lets(|_, _| true);
    let rates = structure(program, inputs);
    let docs = docs::function(
        "Forces f and g, heat capacity c, slopes of the entropy.",
        program,
    );
    quote! {
        #docs
        fn rates(&self, __x: &Self::Variables) -> __eem::Rates<Self::Variables> {
            #lets
            #rates
        }
    }
}

// Expands to: `let __v0 = …; move |__theta| { let __v5 = __theta; … (__eem::Rates { … }, [__v9, __v10]) }`.
fn at_temperature(program: &Program, inputs: &Inputs) -> TokenStream {
    let scalar = &inputs.scalar;
    let lets = |stage| {
        let statements = Statements {
            program,
            scalar,
            input: Box::new(|index| {
                if inputs.thermal {
                    inputs.at_temperature(index)
                } else {
                    inputs.point(index)
                }
            }),
            known: BTreeMap::new(),
        };
        statements.lets(|_, instruction| instruction.stage == stage)
    };
    let (old, new) = (lets(Stage::Old), lets(Stage::New));
    let rates = structure(program, inputs);
    let outputs = &program.outputs;
    let free_energy = value(outputs[outputs.len() - 1]);
    let (theta, entropy) = if inputs.thermal {
        let entropy = value(outputs[outputs.len() - 2]);
        (quote!(__theta), entropy.into_token_stream())
    } else {
        (quote!(_), zero(inputs))
    };
    let docs = docs::new_stage(
        "The same, the entropy s and the free energy ψ, as functions of the temperature.",
        program,
    );
    quote! {
        #docs
        fn rates_at(
            &self,
            __x: Self::Variables,
        ) -> impl __eem::core::ops::Fn(
            #scalar,
        ) -> (__eem::Rates<Self::Variables>, [#scalar; 2]) {
            #old
            move |#theta| {
                #new
                (#rates, [#entropy, #free_energy])
            }
        }
    }
}

// Expands to: `__eem::Rates { forces: [__v7, __v8], slopes: [__v9, <__S as __eem::Scalar>::zero()] }`.
fn structure(program: &Program, inputs: &Inputs) -> TokenStream {
    let outputs = program.outputs.iter();
    let mut outputs = outputs.map(|&output| value(output).into_token_stream());
    let forces: Vec<_> = outputs.by_ref().take(inputs.variables).collect();
    let zero = zero(inputs);
    let slopes: Vec<_> = if inputs.thermal {
        let slopes = outputs.take(inputs.variables - 1);
        slopes.chain([zero]).collect()
    } else {
        vec![zero; inputs.variables]
    };
    quote! { __eem::Rates { forces: [#(#forces),*], slopes: [#(#slopes),*] } }
}

fn zero(inputs: &Inputs) -> TokenStream {
    let scalar = &inputs.scalar;
    quote!(<#scalar as __eem::Scalar>::zero())
}
