//! The derivatives with respect to the parameters: adjoints and tangents of both forms, adjoints of functions of one state.

use std::collections::BTreeMap;

use eem_symbolic::{ParameterPrograms, Program};
use proc_macro2::TokenStream;
use quote::quote;

use super::docs;
use super::inputs::Inputs;
use super::statements::{Statements, value};

/// An argument of a generated function, and how many inputs of its program it holds.
type Argument = (TokenStream, usize);

/// The generated functions of all these derivatives.
pub(super) fn parameters(programs: &ParameterPrograms, inputs: &Inputs) -> TokenStream {
    let entropy = entropy_form(programs, inputs);
    let temperature = temperature_form(programs, inputs);
    let state = functions_of_a_state(programs, inputs);
    let viscosities = viscosities(programs, inputs);
    quote! {
        const HAS_PARAMETER_DERIVATIVES: __eem::core::primitive::bool = true;
        #entropy
        #temperature
        #state
        #viscosities
    }
}

fn entropy_form(programs: &ParameterPrograms, inputs: &Inputs) -> TokenStream {
    let [states, corners] = [states(inputs), vec![corners(inputs)]];
    let [weights, direction] = [weights(inputs.responses()), direction(inputs)];
    let arguments = [states, corners].concat();
    let program = &programs.entropy_form_adjoint;
    let adjoint = body(program, inputs, &[&arguments[..], &[weights]].concat());
    let adjoint_docs = docs::function(
        "Entropy form: derivatives of weighted algorithmic quantities by the parameters.",
        program,
    );
    let program = &programs.entropy_form_tangent;
    let tangent = body(program, inputs, &[&arguments[..], &[direction]].concat());
    let tangent_docs = docs::function(
        "Entropy form: derivative of the algorithmic quantities along parameters.",
        program,
    );
    quote! {
        #adjoint_docs
        fn entropy_form_adjoint(
            &self,
            __x0: &Self::Variables,
            __x1: &Self::Variables,
            __corners: &Self::Corners,
            __weights: &Self::Response,
        ) -> Self::Parameters { #adjoint }
        #tangent_docs
        fn entropy_form_tangent(
            &self,
            __x0: &Self::Variables,
            __x1: &Self::Variables,
            __corners: &Self::Corners,
            __direction: &Self::Parameters,
        ) -> Self::Response { #tangent }
    }
}

fn temperature_form(programs: &ParameterPrograms, inputs: &Inputs) -> TokenStream {
    let (Some(adjoint), Some(tangent)) = (
        &programs.temperature_form_adjoint,
        &programs.temperature_form_tangent,
    ) else {
        return the_same_form();
    };
    let states = states(inputs);
    let adjoint_docs = docs::function(
        "Temperature form: derivatives of weighted algorithmic quantities by the parameters.",
        adjoint,
    );
    let tangent_docs = docs::function(
        "Temperature form: derivative of the algorithmic quantities along parameters.",
        tangent,
    );
    let [weights, direction] = [weights(inputs.responses()), direction(inputs)];
    let adjoint = body(adjoint, inputs, &[&states[..], &[weights]].concat());
    let tangent = body(tangent, inputs, &[&states[..], &[direction]].concat());
    quote! {
        #adjoint_docs
        fn temperature_form_adjoint(
            &self,
            __x0: &Self::Variables,
            __x1: &Self::Variables,
            __weights: &Self::Response,
        ) -> Self::Parameters { #adjoint }
        #tangent_docs
        fn temperature_form_tangent(
            &self,
            __x0: &Self::Variables,
            __x1: &Self::Variables,
            __direction: &Self::Parameters,
        ) -> Self::Response { #tangent }
    }
}

// Without a temperature both forms are the same.
fn the_same_form() -> TokenStream {
    quote! {
        /// There is no temperature: the same as the entropy form.
        fn temperature_form_adjoint(
            &self,
            __x0: &Self::Variables,
            __x1: &Self::Variables,
            __weights: &Self::Response,
        ) -> Self::Parameters {
            __eem::FreeEnergy::entropy_form_adjoint(self, __x0, __x1, &[], __weights)
        }
        /// There is no temperature: the same as the entropy form.
        fn temperature_form_tangent(
            &self,
            __x0: &Self::Variables,
            __x1: &Self::Variables,
            __direction: &Self::Parameters,
        ) -> Self::Response {
            __eem::FreeEnergy::entropy_form_tangent(self, __x0, __x1, &[], __direction)
        }
    }
}

fn functions_of_a_state(programs: &ParameterPrograms, inputs: &Inputs) -> TokenStream {
    let state = (quote!(__x), inputs.variables);
    let program = &programs.gradient_adjoint;
    let gradient_docs = docs::function(
        "Derivatives of weighted components of the gradient ∂ψ/∂x by the parameters.",
        program,
    );
    let gradient = body(program, inputs, &[state.clone(), weights(inputs.variables)]);
    let program = &programs.energy_by_parameters;
    let energy_docs = docs::function(
        "Derivatives of the internal energy e by the parameters.",
        program,
    );
    let energy = body(program, inputs, &[state]);
    quote! {
        #gradient_docs
        fn gradient_adjoint(
            &self,
            __x: &Self::Variables,
            __weights: &Self::Variables,
        ) -> Self::Parameters { #gradient }
        #energy_docs
        fn energy_by_parameters(&self, __x: &Self::Variables) -> Self::Parameters { #energy }
    }
}

fn viscosities(programs: &ParameterPrograms, inputs: &Inputs) -> TokenStream {
    let scalar = &inputs.scalar;
    let purpose = "Derivatives of weighted viscosities by the parameters.";
    let program = programs.viscosity_adjoint.as_ref();
    let (docs, body) = viscosity(purpose, program, inputs);
    let viscosities = quote! {
        #docs
        fn viscosity_adjoint(
            &self,
            __theta: #scalar,
            __weights: &Self::Viscosities,
        ) -> Self::Parameters { #body }
    };
    let purpose = "Derivatives of the weighted viscosity of the stretch by the parameters.";
    let program = programs.drag_adjoint.as_ref();
    let (docs, body) = viscosity(purpose, program, inputs);
    quote! {
        #viscosities
        #docs
        fn drag_adjoint(&self, __theta: #scalar, __weights: &Self::Drag) -> Self::Parameters { #body }
    }
}

/// Documentation and body of an adjoint of viscosities.
fn viscosity(
    purpose: &str,
    program: Option<&Program>,
    inputs: &Inputs,
) -> (TokenStream, TokenStream) {
    let Some(program) = program else {
        let scalar = &inputs.scalar;
        return (
            quote! { /** There is no such viscosity: zero. */ },
            quote! { __eem::Array::filled(<#scalar as __eem::Scalar>::zero()) },
        );
    };
    let body = written(program, inputs, |index| inputs.viscosity(index));
    (docs::function(purpose, program), body)
}

fn states(inputs: &Inputs) -> Vec<Argument> {
    let count = inputs.variables;
    vec![(quote!(__x0), count), (quote!(__x1), count)]
}

fn corners(inputs: &Inputs) -> Argument {
    (quote!(__corners), inputs.corners())
}

fn weights(count: usize) -> Argument {
    (quote!(__weights), count)
}

fn direction(inputs: &Inputs) -> Argument {
    (quote!(__direction), inputs.parameters.len())
}

/// The body of a function whose program takes the parameters, then the arguments.
fn body(program: &Program, inputs: &Inputs, arguments: &[Argument]) -> TokenStream {
    written(program, inputs, |index| inputs.argument(index, arguments))
}

// Expands to: `let __v0 = __x0[0]; … [__v7, __v8]`.
fn written(
    program: &Program,
    inputs: &Inputs,
    input: impl Fn(usize) -> TokenStream,
) -> TokenStream {
    let lets = Statements {
        program,
        scalar: &inputs.scalar,
        input: Box::new(input),
        known: BTreeMap::new(),
    }
    .lets(|_, _| true);
    let outputs = program.outputs.iter().map(|&output| value(output));
    quote! { #lets [#(#outputs),*] }
}
