//! The measures of a free energy per volume: the implementation of `StrainEnergy`, and that of `JointEnergy` if
//! there is a viscous strain.

use eem_symbolic::Programs;
use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::quote;
use syn::DeriveInput;

use super::forms::{kept, kept_in_entropy_form};
use super::inputs::Inputs;
use crate::ast::{Joint, Strain};
use crate::checked::Checked;

/// Components of a tensor without a trace; there is one more if the trace flows as well.
const DEVIATORIC: usize = 5;

/// The implementations for a model.
pub(super) fn strains(
    checked: &Checked<'_>,
    programs: &Programs,
    inputs: &Inputs,
) -> Option<TokenStream> {
    let joints: Vec<Joint> = checked.joints().collect();
    let mut strains: Vec<TokenStream> = checked.strains().map(variant).collect();
    if joints.is_empty() {
        return implementation(checked.original, &strains, None);
    }
    let components = DEVIATORIC + usize::from(joints.contains(&Joint::Trace));
    strains.extend((0..components).map(|k| {
        let k = Literal::usize_unsuffixed(k);
        quote!(Component(#k))
    }));
    let energy = component_energy(&joints, components, programs, inputs);
    let joint = joint_energy(checked.original, &joints);
    let strains = implementation(checked.original, &strains, Some(&energy));
    Some(quote! { #joint #strains })
}

/// The implementation for a model with errors that has these strains.
pub(crate) fn stub(
    input: &DeriveInput,
    strains: impl Iterator<Item = Strain>,
) -> Option<TokenStream> {
    let strains: Vec<TokenStream> = strains.map(variant).collect();
    implementation(input, &strains, None)
}

fn variant(strain: Strain) -> TokenStream {
    let variant = Ident::new(strain.variant(), Span::call_site());
    quote!(#variant)
}

// Expands to: nothing for a spring, else
//
//     impl StrainEnergy<2> for Rubber {
//         const STRAINS: [Strain; 2] = [Strain::Trace, Strain::Square];
//         type AtPoint = Self where Self: Material;
//         fn at_point(&self) -> Self::AtPoint where Self: Material {
//             FreeEnergy::<f64>::duplicate(self)
//         }
//     }
//
// and with a viscous strain `ComponentEnergy<Self, …>` instead of `Self`.
fn implementation(
    input: &DeriveInput,
    strains: &[TokenStream],
    energy: Option<&TokenStream>,
) -> Option<TokenStream> {
    if strains.is_empty() {
        return None;
    }
    let count = Literal::usize_unsuffixed(strains.len());
    let ident = &input.ident;
    let (impl_generics, ty_generics, where_clause) = input.generics.split_for_impl();
    let copy = quote!(__eem::FreeEnergy::<__eem::core::primitive::f64>::duplicate(
        self
    ));
    let (energy, copy) = match energy {
        Some(energy) => (quote!(#energy), quote!(__eem::ComponentEnergy::new(#copy))),
        None => (quote!(Self), copy),
    };
    Some(quote! {
        #[automatically_derived]
        impl #impl_generics __eem::StrainEnergy<#count> for #ident #ty_generics #where_clause {
            const STRAINS: [__eem::Strain; #count] = [#(__eem::Strain::#strains),*];
            type AtPoint = #energy where Self: __eem::Material;
            fn at_point(&self) -> Self::AtPoint
            where
                Self: __eem::Material,
            {
                #copy
            }
        }
    })
}

// Expands to: `ComponentEnergy<Self, 13, 5, 14, 27, 25>`, with the numbers of variables, dashpots, algorithmic
// quantities, and values that the two forms keep of the old state.
fn component_energy(
    joints: &[Joint],
    components: usize,
    programs: &Programs,
    inputs: &Inputs,
) -> TokenStream {
    let temperature = programs.temperature_form.as_ref();
    let temperature = temperature.unwrap_or(&programs.entropy_form);
    let variables = inputs.variables - joints.len() + 2 * components;
    let numbers = [
        variables,
        inputs.dashpots + components,
        variables + usize::from(inputs.thermal),
        kept_in_entropy_form(programs, inputs) + 2 * components,
        kept(temperature, inputs).len() + 2 * components,
    ];
    let numbers = numbers.map(Literal::usize_unsuffixed);
    quote!(__eem::ComponentEnergy<Self, #(#numbers),*>)
}

// Expands to: `impl JointEnergy for Rubber { const JOINT: &'static [Joint] = &[Joint::Strain, …]; }`.
fn joint_energy(input: &DeriveInput, joints: &[Joint]) -> TokenStream {
    let variants = joints.iter().map(|joint| joint.variant());
    let variants = variants.map(|variant| Ident::new(variant, Span::call_site()));
    let ident = &input.ident;
    let (impl_generics, ty_generics, where_clause) = input.generics.split_for_impl();
    quote! {
        #[automatically_derived]
        impl #impl_generics __eem::JointEnergy for #ident #ty_generics #where_clause {
            const JOINT: &'static [__eem::Joint] = &[#(__eem::Joint::#variants),*];
        }
    }
}
