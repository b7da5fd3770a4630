//! The algorithmic quantities of a step, in entropy and in temperature form.
//!
//! Each form is three functions. One runs once per step and depends on the old state alone. One runs
//! once per iteration and takes the values of the first. The third is the second without the tangent.

use std::collections::BTreeMap;

use eem_symbolic::{Operation, Program, Programs, Restriction, Stage, Value};
use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::docs;
use super::inputs::Inputs;
use super::statements::{Statements, value};

/// The functions of both forms.
pub(super) fn forms(programs: &Programs, inputs: &Inputs) -> TokenStream {
    let entropy = entropy_form(programs, inputs);
    let temperature = match &programs.temperature_form {
        Some(program) => temperature_form(program, inputs),
        None => the_same_form(),
    };
    quote! { #entropy #temperature }
}

fn entropy_form(programs: &Programs, inputs: &Inputs) -> TokenStream {
    let program = &programs.entropy_form;
    let (mut old, new) = (old_stage(program, inputs), new_stage(program, inputs));
    let mut mixed_states = None;
    if let Some(mixed) = &programs.mixed_states {
        let first = kept(program, inputs).len();
        let parts = [
            (old, first),
            (old_stage(mixed, inputs), kept(mixed, inputs).len()),
        ];
        old = joined(&parts, inputs);
        mixed_states = Some(mixed_states_function(mixed, inputs, first));
    }
    let old_docs = docs::old_stage(
        "Entropy form: what depends on the old state alone.",
        program,
    );
    let new_docs = docs::new_stage(
        "Entropy form: algorithmic quantities and their tangent.",
        program,
    );
    let restriction = program.restricted_to(inputs.responses());
    let response = response(program, &restriction, inputs);
    let response_docs = docs::new_stage(
        "Entropy form: the same algorithmic quantities without their tangent.",
        &restriction.program,
    );
    let corners = if inputs.thermal {
        quote!(__corners)
    } else {
        quote!(_)
    };
    quote! {
        #old_docs
        fn entropy_form_old(&self, __x0: &Self::Variables) -> Self::EntropyFormOld { #old }
        #new_docs
        fn entropy_form(
            &self,
            __old: &Self::EntropyFormOld,
            __x1: &Self::Variables,
            #corners: &Self::Corners,
        ) -> (Self::Response, Self::Tangent) { #new }
        #response_docs
        fn entropy_form_response(
            &self,
            __old: &Self::EntropyFormOld,
            __x1: &Self::Variables,
            #corners: &Self::Corners,
        ) -> Self::Response { #response }
        #mixed_states
    }
}

// Expands to: `let __form = { … }; let __mixed = { … }; [__form[0], __mixed[0]]`.
fn joined([form, mixed]: &[(TokenStream, usize); 2], inputs: &Inputs) -> TokenStream {
    let scalar = &inputs.scalar;
    let names = [quote!(__form), quote!(__mixed)];
    let (mut lets, mut entries) = (TokenStream::new(), Vec::new());
    for (name, (array, count)) in names.iter().zip([form, mixed]) {
        let length = Literal::usize_unsuffixed(*count);
        lets.extend(quote! { let #name: [#scalar; #length] = { #array }; });
        let places = (0..*count).map(Literal::usize_unsuffixed);
        entries.extend(places.map(|place| quote!(#name[#place])));
    }
    quote! { #lets [#(#entries),*] }
}

// `first` is where the values of the old stage begin in `__old`.
fn mixed_states_function(program: &Program, inputs: &Inputs, first: usize) -> TokenStream {
    let new = {
        let statements = statements(program, inputs, known_from(program, inputs, first));
        let lets = statements.lets(|_, instruction| instruction.stage == Stage::New);
        let outputs = program.outputs.iter();
        let outputs: Vec<_> = outputs.map(|&output| statements.read(output)).collect();
        let (excesses, capacities) = outputs.split_at(inputs.corners());
        quote! { #lets [[#(#excesses),*], [#(#capacities),*]] }
    };
    let docs = docs::new_stage(
        "By how much the entropies of the corners are too large, and their heat capacities.",
        program,
    );
    quote! {
        #docs
        fn mixed_states(
            &self,
            _: &Self::Variables,
            __old: &Self::EntropyFormOld,
            __x1: &Self::Variables,
            __corners: &Self::Corners,
        ) -> [Self::Corners; 2] { #new }
    }
}

fn temperature_form(program: &Program, inputs: &Inputs) -> TokenStream {
    let (old, new) = (old_stage(program, inputs), new_stage(program, inputs));
    let old_docs = docs::old_stage(
        "Temperature form: what depends on the old state alone.",
        program,
    );
    let new_docs = docs::new_stage(
        "Temperature form: algorithmic quantities and their tangent.",
        program,
    );
    let restriction = program.restricted_to(inputs.responses());
    let response = response(program, &restriction, inputs);
    let response_docs = docs::new_stage(
        "Temperature form: the same algorithmic quantities without their tangent.",
        &restriction.program,
    );
    quote! {
        #old_docs
        fn temperature_form_old(&self, __x0: &Self::Variables) -> Self::TemperatureFormOld { #old }
        #new_docs
        fn temperature_form(
            &self,
            __old: &Self::TemperatureFormOld,
            __x1: &Self::Variables,
        ) -> (Self::Response, Self::Tangent) { #new }
        #response_docs
        fn temperature_form_response(
            &self,
            __old: &Self::TemperatureFormOld,
            __x1: &Self::Variables,
        ) -> Self::Response { #response }
    }
}

// Without a temperature both forms are the same.
fn the_same_form() -> TokenStream {
    quote! {
        /// There is no temperature: the same as the entropy form.
        fn temperature_form_old(&self, __x0: &Self::Variables) -> Self::TemperatureFormOld {
            __eem::FreeEnergy::entropy_form_old(self, __x0)
        }
        /// There is no temperature: the same as the entropy form.
        fn temperature_form(
            &self,
            __old: &Self::TemperatureFormOld,
            __x1: &Self::Variables,
        ) -> (Self::Response, Self::Tangent) {
            __eem::FreeEnergy::entropy_form(self, __old, __x1, &[])
        }
        /// There is no temperature: the same as the entropy form.
        fn temperature_form_response(
            &self,
            __old: &Self::TemperatureFormOld,
            __x1: &Self::Variables,
        ) -> Self::Response {
            __eem::FreeEnergy::entropy_form_response(self, __old, __x1, &[])
        }
    }
}

// Expands to: `let __v0 = __x0[0]; … [__v3, __v5]`.
fn old_stage(program: &Program, inputs: &Inputs) -> TokenStream {
    let kept = kept(program, inputs);
    let needed = program.needed_by(&kept);
    let statements = statements(program, inputs, BTreeMap::new());
    let lets =
        statements.lets(|index, instruction| instruction.stage == Stage::Old && needed[index]);
    let kept = kept.into_iter().map(value);
    quote! { #lets [#(#kept),*] }
}

// Expands to: `let __v6 = __x1[0]; let __v3 = __old[0]; … ([…], [[…], …])`.
fn new_stage(program: &Program, inputs: &Inputs) -> TokenStream {
    let statements = statements(program, inputs, known(program, inputs));
    let lets = statements.lets(|_, instruction| instruction.stage == Stage::New);
    let outputs: Vec<_> = program
        .outputs
        .iter()
        .map(|&output| statements.read(output))
        .collect();
    let (response, tangent) = outputs.split_at(inputs.responses());
    let rows = tangent
        .chunks(inputs.variables)
        .map(|row| quote!([#(#row),*]));
    quote! {
        #lets
        ([#(#response),*], [#(#rows),*])
    }
}

// Expands to: `let __v6 = __x1[0]; … […]`: those statements of the full function that the response
// depends on, hence the same bits. Both functions read the same `__old`.
fn response(program: &Program, restriction: &Restriction, inputs: &Inputs) -> TokenStream {
    let of_all = known(program, inputs);
    let origin = |value: Value| restriction.origins[value.index()];
    let known = restriction.program.hoisted().into_iter();
    let known = known.filter_map(|value| Some((value, of_all.get(&origin(value)?)?.clone())));
    let statements = statements(&restriction.program, inputs, known.collect());
    let lets = statements.lets(|_, instruction| instruction.stage == Stage::New);
    let outputs = restriction.program.outputs.iter();
    let outputs = outputs.map(|&output| statements.read(output));
    quote! {
        #lets
        [#(#outputs),*]
    }
}

/// The values that `__old` holds: those of the old stage that the new stage uses. Parameters are not
/// among them, they are read from `self`.
pub(super) fn kept(program: &Program, inputs: &Inputs) -> Vec<Value> {
    let hoisted = program.hoisted().into_iter();
    hoisted
        .filter(|&value| parameter(program, inputs, value).is_none())
        .collect()
}

/// Number of values that the entropy form keeps of the old state, those of `mixed_states` included.
pub(super) fn kept_in_entropy_form(programs: &Programs, inputs: &Inputs) -> usize {
    let mixed = programs.mixed_states.as_ref();
    let form = kept(&programs.entropy_form, inputs).len();
    form + mixed.map_or(0, |mixed| kept(mixed, inputs).len())
}

/// How the new stage reads the values of the old one: from `__old`, or from `self`.
fn known(program: &Program, inputs: &Inputs) -> BTreeMap<Value, TokenStream> {
    known_from(program, inputs, 0)
}

/// The same with the values from `__old[first]` on.
fn known_from(program: &Program, inputs: &Inputs, first: usize) -> BTreeMap<Value, TokenStream> {
    let mut known = BTreeMap::new();
    for value in program.hoisted() {
        if let Some(parameter) = parameter(program, inputs, value) {
            known.insert(value, parameter.clone());
        }
    }
    for (position, value) in kept(program, inputs).into_iter().enumerate() {
        let position = Literal::usize_unsuffixed(first + position);
        known.insert(value, quote!(__old[#position]));
    }
    known
}

/// The field of `self` that a value is read from, if it is a parameter.
fn parameter<'p>(program: &Program, inputs: &'p Inputs, value: Value) -> Option<&'p TokenStream> {
    match program.instructions[value.index()].operation {
        Operation::Input(index) => inputs.parameters.get(index),
        _ => None,
    }
}

fn statements<'p>(
    program: &'p Program,
    inputs: &'p Inputs,
    known: BTreeMap<Value, TokenStream>,
) -> Statements<'p> {
    Statements {
        program,
        scalar: &inputs.scalar,
        input: Box::new(|index| inputs.form(index)),
        known,
    }
}
