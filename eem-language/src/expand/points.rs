//! The functions of one state: ψ, e, gradient, Hessian, caloric quantities, viscosities.

use std::collections::BTreeMap;

use eem_symbolic::{Program, Programs, Stage};
use proc_macro2::TokenStream;
use quote::quote;

use super::docs;
use super::inputs::Inputs;
use super::rates::rates;
use super::statements::{Statements, value};
use super::viscosities::viscosities;

/// All functions of one state.
pub(super) fn points(programs: &Programs, inputs: &Inputs) -> TokenStream {
    let scalar = &inputs.scalar;
    let free_energy = scalar_function(&programs.free_energy, inputs);
    let energy_magnitude = scalar_function(&programs.energy_magnitude, inputs);
    let internal_energy = scalar_function(&programs.internal_energy, inputs);
    let docs = [
        docs::function("Free energy ψ.", &programs.free_energy),
        docs::function(
            "The sum of the magnitudes of the terms of ψ.",
            &programs.energy_magnitude,
        ),
        docs::function("Internal energy e = ψ + θ s.", &programs.internal_energy),
    ];
    let [
        free_energy_docs,
        energy_magnitude_docs,
        internal_energy_docs,
    ] = docs;
    let gradient = gradient(&programs.gradient, inputs);
    let hessian = hessian(&programs.hessian, inputs);
    let caloric = caloric(programs.caloric.as_ref(), inputs);
    let caloric_at = caloric_at(programs.caloric_at.as_ref(), inputs);
    let rates = rates(programs, inputs);
    let entropy_hessian = entropy_hessian(programs.entropy_hessian.as_ref(), inputs);
    let viscosities = viscosities(programs, inputs);
    quote! {
        #free_energy_docs
        fn free_energy(&self, __x: &Self::Variables) -> #scalar { #free_energy }
        #energy_magnitude_docs
        fn energy_magnitude(&self, __x: &Self::Variables) -> #scalar { #energy_magnitude }
        #internal_energy_docs
        fn internal_energy(&self, __x: &Self::Variables) -> #scalar { #internal_energy }
        #gradient
        #hessian
        #caloric
        #caloric_at
        #rates
        #entropy_hessian
        #viscosities
    }
}

// Expands to: `let __v0 = __x[0]; … __v9`.
fn scalar_function(program: &Program, inputs: &Inputs) -> TokenStream {
    let lets = lets(program, inputs);
    let output = value(program.outputs[0]);
    quote! { #lets #output }
}

fn gradient(program: &Program, inputs: &Inputs) -> TokenStream {
    let lets = lets(program, inputs);
    let outputs = program.outputs.iter().map(|&output| value(output));
    let docs = docs::function("Gradient ∂ψ/∂x.", program);
    quote! {
        #docs
        fn gradient(&self, __x: &Self::Variables) -> Self::Variables {
            #lets
            [#(#outputs),*]
        }
    }
}

// Expands to: `let __v0 = …; ([__v7, __v8], [[__v9, __v10], [__v10, __v11]])`.
fn hessian(program: &Program, inputs: &Inputs) -> TokenStream {
    let lets = lets(program, inputs);
    let outputs: Vec<_> = program
        .outputs
        .iter()
        .map(|&output| value(output))
        .collect();
    let (gradient, hessian) = outputs.split_at(inputs.variables);
    let rows = hessian
        .chunks(inputs.variables)
        .map(|row| quote!([#(#row),*]));
    let docs = docs::function("Gradient ∂ψ/∂x and Hessian ∂²ψ/∂x².", program);
    quote! {
        #docs
        fn hessian(&self, __x: &Self::Variables) -> (Self::Variables, Self::Hessian) {
            #lets
            ([#(#gradient),*], [#(#rows),*])
        }
    }
}

// Expands to: `let __v0 = …; __eem::Caloric { entropy: __v7, heat_capacity: __v8, magnitude: __v9 }`.
fn caloric(program: Option<&Program>, inputs: &Inputs) -> TokenStream {
    let scalar = &inputs.scalar;
    let Some(program) = program else {
        return quote! {
            /// There is no temperature: zero.
            fn caloric(&self, _: &Self::Variables) -> __eem::Caloric<#scalar> {
                let __zero = <#scalar as __eem::Scalar>::zero();
                __eem::Caloric { entropy: __zero, heat_capacity: __zero, magnitude: __zero }
            }
        };
    };
    let lets = lets(program, inputs);
    let [entropy, heat_capacity, magnitude] = [0, 1, 2].map(|i| value(program.outputs[i]));
    let docs = docs::function(
        "Entropy s, heat capacity θ ∂s/∂θ, and the sum of the magnitudes of the terms of s.",
        program,
    );
    quote! {
        #docs
        fn caloric(&self, __x: &Self::Variables) -> __eem::Caloric<#scalar> {
            #lets
            __eem::Caloric {
                entropy: #entropy,
                heat_capacity: #heat_capacity,
                magnitude: #magnitude,
            }
        }
    }
}

// Expands to: `let __v0 = …; move |__theta| { let __v5 = __theta; … (__eem::Caloric { … }, __v9) }`.
fn caloric_at(program: Option<&Program>, inputs: &Inputs) -> TokenStream {
    let Some(program) = program else {
        return TokenStream::new();
    };
    let scalar = &inputs.scalar;
    let lets = |stage| {
        let statements = Statements {
            program,
            scalar,
            input: Box::new(|index| inputs.at_temperature(index)),
            known: BTreeMap::new(),
        };
        statements.lets(|_, instruction| instruction.stage == stage)
    };
    let (old, new) = (lets(Stage::Old), lets(Stage::New));
    let [entropy, heat_capacity, magnitude, free_energy] =
        [0, 1, 2, 3].map(|i| value(program.outputs[i]));
    let docs = docs::new_stage(
        "The same, and the free energy ψ, as functions of the temperature.",
        program,
    );
    quote! {
        #docs
        fn caloric_at(
            &self,
            __x: Self::Variables,
        ) -> impl __eem::core::ops::Fn(#scalar) -> (__eem::Caloric<#scalar>, #scalar) {
            #old
            move |__theta| {
                #new
                let __caloric = __eem::Caloric {
                    entropy: #entropy,
                    heat_capacity: #heat_capacity,
                    magnitude: #magnitude,
                };
                (__caloric, #free_energy)
            }
        }
    }
}

// Expands to: `let __v0 = …; [[__v9, __v10], [__v10, __v11]]`.
fn entropy_hessian(program: Option<&Program>, inputs: &Inputs) -> TokenStream {
    let scalar = &inputs.scalar;
    let Some(program) = program else {
        return quote! {
            /// There is no temperature: zero.
            fn entropy_hessian(&self, _: &Self::Variables) -> Self::Hessian {
                let __row = __eem::Array::filled(<#scalar as __eem::Scalar>::zero());
                __eem::Array::filled(__row)
            }
        };
    };
    let lets = lets(program, inputs);
    let outputs: Vec<_> = program
        .outputs
        .iter()
        .map(|&output| value(output))
        .collect();
    let rows = outputs
        .chunks(inputs.variables)
        .map(|row| quote!([#(#row),*]));
    let docs = docs::function("Hessian of the entropy, ∂²s/∂x².", program);
    quote! {
        #docs
        fn entropy_hessian(&self, __x: &Self::Variables) -> Self::Hessian {
            #lets
            [#(#rows),*]
        }
    }
}

fn lets(program: &Program, inputs: &Inputs) -> TokenStream {
    Statements {
        program,
        scalar: &inputs.scalar,
        input: Box::new(|index| inputs.point(index)),
        known: BTreeMap::new(),
    }
    .lets(|_, _| true)
}
