//! The head of the implementation: generics, bounds and the scalar.

use proc_macro2::TokenStream;
use quote::{ToTokens as _, quote};
use syn::{DeriveInput, Generics, Ident, parse_quote};

use crate::checked::Scalar;

/// `impl<…> FreeEnergy<S> for Model<…> where …`, without the body.
pub(crate) struct Header<'a> {
    ident: &'a Ident,
    original: &'a Generics,
    generics: Generics,
    /// The type that stands for the scalar: a parameter of the struct or `__S`.
    pub(crate) scalar: TokenStream,
}

impl<'a> Header<'a> {
    /// The head for a struct and a scalar.
    pub(crate) fn new(input: &'a DeriveInput, scalar: Scalar<'a>) -> Self {
        let mut generics = input.generics.clone();
        let scalar = match scalar {
            Scalar::Any => {
                generics.params.push(parse_quote!(__S: __eem::Scalar));
                quote! { __S }
            }
            Scalar::Parameter(parameter) => {
                let bound = parse_quote!(#parameter: __eem::Scalar);
                generics.make_where_clause().predicates.push(bound);
                parameter.to_token_stream()
            }
        };
        Self {
            ident: &input.ident,
            original: &input.generics,
            generics,
            scalar,
        }
    }

    /// The implementation with the given body.
    pub(crate) fn implementation(&self, body: &TokenStream) -> TokenStream {
        let Self { ident, scalar, .. } = self;
        let (impl_generics, _, where_clause) = self.generics.split_for_impl();
        let (_, ty_generics, _) = self.original.split_for_impl();
        quote! {
            #[automatically_derived]
            impl #impl_generics __eem::FreeEnergy<#scalar> for #ident #ty_generics #where_clause {
                #body
            }
        }
    }
}
