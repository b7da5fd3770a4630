//! The head of the implementation: generics, bounds and the scalar.

use proc_macro2::{Span, TokenStream};
use quote::{ToTokens as _, format_ident, quote};
use syn::{DeriveInput, GenericParam, Generics, Ident, parse_quote};

use crate::checked::Scalar;

/// `impl<…> FreeEnergy<S> for Model<…> where …`, without the body.
pub(crate) struct Header<'a> {
    ident: &'a Ident,
    original: &'a Generics,
    generics: Generics,
    /// The type that stands for the scalar: a parameter of the struct, or an [unused] name.
    pub(crate) scalar: TokenStream,
}

impl<'a> Header<'a> {
    /// The head for a struct and a scalar.
    pub(crate) fn new(input: &'a DeriveInput, scalar: Scalar<'a>) -> Self {
        let mut generics = input.generics.clone();
        let scalar = match scalar {
            Scalar::Any => {
                let scalar = unused(&generics);
                generics.params.push(parse_quote!(#scalar: __eem::Scalar));
                scalar.to_token_stream()
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

/// `__S`, with `_` appended until no parameter of the struct has that name.
fn unused(generics: &Generics) -> Ident {
    let mut scalar = Ident::new("__S", Span::call_site());
    while generics.params.iter().any(|parameter| match parameter {
        GenericParam::Type(parameter) => parameter.ident == scalar,
        GenericParam::Const(parameter) => parameter.ident == scalar,
        GenericParam::Lifetime(_) => false,
    }) {
        scalar = format_ident!("{scalar}_");
    }
    scalar
}
