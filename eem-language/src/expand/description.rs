//! The description of the model: the implementation of `Describe`.

use eem_symbolic::{Model, ParameterPrograms, Program, Programs};
use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::equation::{Equation, differences};
use crate::ast;
use crate::checked::Checked;
use crate::units::{Quantities, Units};

// Expands to:
//
//     impl Describe for Spring {
//         const DESCRIPTION: Description = Description { name: "Spring", … };
//     }
pub(super) fn description(
    checked: &Checked<'_>,
    model: &Model,
    costs: &[TokenStream],
    equations: &[Equation],
    units: &Units,
) -> TokenStream {
    let name = ast::name(&checked.original.ident);
    let arguments = arguments(checked);
    let parameters = parameters(checked, units);
    let formulas = equations.iter().map(Equation::tokens);
    let differences = differences(checked, model);
    let differences = differences.iter().map(Equation::tokens);
    let body = quote! {
        const DESCRIPTION: __eem::Description = __eem::Description {
            name: #name,
            arguments: &[#(#arguments),*],
            parameters: &[#(#parameters),*],
            formulas: &[#(#formulas),*],
            divided_differences: &[#(#differences),*],
            costs: &[#(#costs),*],
        };
    };
    implementation(checked.original, &body)
}

/// The implementation of `Describe` with the given body.
pub(crate) fn implementation(input: &syn::DeriveInput, body: &TokenStream) -> TokenStream {
    let ident = &input.ident;
    let (impl_generics, ty_generics, where_clause) = input.generics.split_for_impl();
    quote! {
        #[automatically_derived]
        impl #impl_generics __eem::Describe for #ident #ty_generics #where_clause {
            #body
        }
    }
}

fn arguments(checked: &Checked<'_>) -> impl Iterator<Item = TokenStream> {
    let quantities = Quantities::of(checked.per_volume());
    checked.variables.iter().map(|variable| {
        let (name, role) = (ast::name(variable.ident), variable.role.name());
        let unit = quantities.of_role(variable.role).to_string();
        quote! { __eem::describe::Argument::new(#name, #role, #unit) }
    })
}

fn parameters(checked: &Checked<'_>, units: &Units) -> impl Iterator<Item = TokenStream> {
    checked.parameters.iter().map(|parameter| {
        let name = &parameter.name;
        let unit = units.of(parameter.origin);
        unit.map_or_else(
            || quote! { __eem::describe::Parameter::without_unit(#name) },
            |unit| quote! { __eem::describe::Parameter::new(#name, #unit) },
        )
    })
}

/// The cost of each generated function.
pub(super) fn costs(
    programs: &Programs,
    derivatives: Option<&ParameterPrograms>,
) -> Vec<TokenStream> {
    let rows = [
        ("free_energy", Some(&programs.free_energy), false),
        ("energy_magnitude", Some(&programs.energy_magnitude), false),
        ("internal_energy", Some(&programs.internal_energy), false),
        ("gradient", Some(&programs.gradient), false),
        ("hessian", Some(&programs.hessian), false),
        ("caloric", programs.caloric.as_ref(), false),
        ("entropy_hessian", programs.entropy_hessian.as_ref(), false),
        ("viscosity", programs.viscosity.as_ref(), false),
        ("drag", programs.drag.as_ref(), false),
        ("entropy_form", Some(&programs.entropy_form), true),
        ("mixed_states", programs.mixed_states.as_ref(), true),
        ("temperature_form", programs.temperature_form.as_ref(), true),
    ];
    let rows = rows.into_iter();
    let rows = rows
        .filter_map(|(function, program, two_states)| Some(cost(function, program?, two_states)));
    let derivatives = derivatives.into_iter().flat_map(ParameterPrograms::named);
    let derivatives = derivatives.map(|(function, program)| cost(function, program, false));
    rows.chain(derivatives).collect()
}

/// The operations per step and per call. A function of one state computes everything in every call.
fn cost(function: &str, program: &Program, two_states: bool) -> TokenStream {
    let count = program.operation_count();
    let (old, new) = (count.old.total(), count.new.total());
    let (step, call) = if two_states {
        (old, new)
    } else {
        (0, old + new)
    };
    let [step, call] = [step, call].map(Literal::usize_unsuffixed);
    quote! { __eem::describe::Cost::new(#function, #step, #call) }
}
