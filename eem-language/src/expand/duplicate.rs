//! The function `duplicate`, which copies a material.

use proc_macro2::TokenStream;
use quote::{quote, quote_spanned};
use syn::spanned::Spanned as _;
use syn::{Data, DeriveInput};

// Expands to:
//
//     fn duplicate(&self) -> Self {
//         Self { stiffness: Clone::clone(&self.stiffness), … }
//     }
pub(super) fn duplicate(input: &DeriveInput) -> TokenStream {
    let Data::Struct(item) = &input.data else {
        return TokenStream::new();
    };
    let copies = item
        .fields
        .members()
        .zip(&item.fields)
        .map(|(member, field)| {
            // If a field cannot be cloned, the compiler reports it there.
            let clone = quote_spanned!(field.ty.span()=> __eem::core::clone::Clone::clone);
            quote! { #member: #clone(&self.#member) }
        });
    quote! {
        fn duplicate(&self) -> Self {
            Self { #(#copies),* }
        }
    }
}
