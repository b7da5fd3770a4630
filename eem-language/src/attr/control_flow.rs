//! Finds `if` and `match` in tokens that cannot be parsed.
//!
//! Where the parser gives up is seldom where the mistake is: `if x > 1 { a } else { b } + c` at the
//! start of a statement fails at `+`, and `a if x > 1 else b` after `a`. The keyword is the mistake.

use proc_macro2::{Ident, TokenStream, TokenTree};

/// The first of the keywords, in the order of the source.
pub(super) fn first(tokens: TokenStream) -> Option<Ident> {
    tokens.into_iter().find_map(|token| match token {
        TokenTree::Ident(ident) if ident == "if" || ident == "match" => Some(ident),
        TokenTree::Group(group) => first(group.stream()),
        TokenTree::Ident(_) | TokenTree::Punct(_) | TokenTree::Literal(_) => None,
    })
}
