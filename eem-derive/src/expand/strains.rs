//! The measures of a free energy per volume: the implementation of `StrainEnergy`.

use proc_macro2::{Literal, Span, TokenStream};
use quote::quote;
use syn::{DeriveInput, Ident};

use crate::ast::Strain;

// Expands to: nothing for a spring, else
//
//     impl StrainEnergy<2> for Rubber {
//         const STRAINS: [Strain; 2] = [Strain::Trace, Strain::Square];
//     }
pub(crate) fn strains(
    input: &DeriveInput,
    strains: impl Iterator<Item = Strain>,
) -> Option<TokenStream> {
    let variants = strains.map(|strain| Ident::new(strain.variant(), Span::call_site()));
    let variants: Vec<Ident> = variants.collect();
    if variants.is_empty() {
        return None;
    }
    let count = Literal::usize_unsuffixed(variants.len());
    let ident = &input.ident;
    let (impl_generics, ty_generics, where_clause) = input.generics.split_for_impl();
    Some(quote! {
        #[automatically_derived]
        impl #impl_generics __eem::StrainEnergy<#count> for #ident #ty_generics #where_clause {
            const STRAINS: [__eem::Strain; #count] = [#(__eem::Strain::#variants),*];
        }
    })
}
