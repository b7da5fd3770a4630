//! Warnings: a derive macro has none of its own, but the use of something deprecated is one.

use proc_macro2::{Ident, Span, TokenStream};
use quote::quote;

/// Code whose compilation prints the warnings at their places.
//
// Expands to, with the place of the warning:
//
//     const _: () = {
//         #[deprecated(note = "`ln(1 + j)` loses …")]
//         const FORM: () = ();
//         FORM
//     };
pub(crate) fn warnings(all: &[(Span, String)]) -> TokenStream {
    let one = |(span, text): &(Span, String)| {
        // With the place of what was written: the compiler does not warn of what a derive has written.
        let form = Ident::new("FORM", *span);
        quote! {
            const _: () = {
                #[deprecated(note = #text)]
                const #form: () = ();
                #form
            };
        }
    };
    all.iter().map(one).collect()
}
