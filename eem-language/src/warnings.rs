//! Warnings: a derive macro cannot warn itself, but the compiler warns where its code uses something deprecated.

use proc_macro2::{Ident, Span, TokenStream};
use quote::quote;

use crate::dialect::Dialect;
use crate::message::Message;

/// Code whose compilation prints the warnings at their places.
//
// Expands to, with the place of the warning:
//
//     const _: () = {
//         #[deprecated(note = "`ln(1 + j)` is inaccurate …")]
//         macro_rules! formula { () => {}; }
//         formula!();
//     };
//
// A macro, because the compiler names it as it was called; the name of any other item would come with its module,
// which here is `_`.
pub(crate) fn warnings(all: &[(Span, Message)]) -> TokenStream {
    let one = |(span, message): &(Span, Message)| {
        let text = message.whole(Dialect::Attribute, &[]);
        // With the place of the user's formula: the compiler does not warn about code of a derive.
        let formula = Ident::new("formula", *span);
        quote! {
            const _: () = {
                #[deprecated(note = #text)]
                macro_rules! #formula { () => {}; }
                #formula!();
            };
        }
    };
    all.iter().map(one).collect()
}
