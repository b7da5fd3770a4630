//! Limits how deeply a formula is nested, so that reading it does not exhaust the stack of the compiler.
//!
//! Reading is recursive, here and in `syn`: every operator of a chain and every pair of brackets is
//! a level. The levels are counted in the tokens, before anything recursive sees them.

use proc_macro2::{Span, TokenStream, TokenTree};

/// Levels that a formula may have. Twice as many still fit the 8 MiB of the compiler's threads in a
/// debug build, if the levels are operators between two values.
pub(super) const LIMIT: usize = 4000;
/// The same for a text, which a program may get from anybody: types in it need more stack than operators.
pub(super) const LIMIT_OF_TEXT: usize = LIMIT / 4;

/// Levels that a pair of brackets counts for: the functions of the parser between two expressions.
const BRACKETS: usize = 20;
/// Levels that a sign or a method counts for.
const PREFIX: usize = 2;

/// The place where the tokens become too deep.
pub(super) fn too_deep(tokens: TokenStream, limit: usize) -> Option<Span> {
    // Groups that are yet to be looked into, with the level at which they stand.
    let mut pending = vec![(tokens, 0)];
    while let Some((tokens, outside)) = pending.pop() {
        let (mut level, mut before) = (outside, Before::Operator);
        for token in tokens {
            if level > limit {
                return Some(token.span());
            }
            let this = Before::from(&token);
            match token {
                TokenTree::Group(group) => {
                    // `x[0][1]`, `f(x)(y)`
                    if before == Before::Group {
                        level += PREFIX;
                    }
                    pending.push((group.stream(), level + BRACKETS));
                }
                // The next statement or argument starts at the level outside.
                TokenTree::Punct(punct) if matches!(punct.as_char(), ';' | ',') => level = outside,
                TokenTree::Punct(punct) if before != Before::Operator && punct.as_char() != '.' => {
                    level += 1;
                }
                TokenTree::Punct(_) => level += PREFIX,
                // A keyword, `return x`, `x as f64`: a whole expression may follow.
                TokenTree::Ident(_) | TokenTree::Literal(_) if before != Before::Operator => {
                    level += BRACKETS;
                }
                TokenTree::Ident(_) | TokenTree::Literal(_) => {}
            }
            before = this;
        }
    }
    None
}

/// A token as seen by the one behind it.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Before {
    Operator,
    Word,
    Group,
}

impl From<&TokenTree> for Before {
    fn from(token: &TokenTree) -> Self {
        match token {
            TokenTree::Punct(_) => Self::Operator,
            TokenTree::Ident(_) | TokenTree::Literal(_) => Self::Word,
            TokenTree::Group(_) => Self::Group,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{LIMIT, too_deep};
    use proc_macro2::TokenStream;

    fn is_too_deep(text: &str) -> bool {
        let tokens: TokenStream = text.parse().expect("the text is made of tokens");
        too_deep(tokens, LIMIT).is_some()
    }

    #[test]
    fn chains_and_brackets_are_counted() {
        assert!(!is_too_deep(&format!("x{}", " + x".repeat(LIMIT))));
        assert!(is_too_deep(&format!("x{}", " + x".repeat(2 * LIMIT))));
        let brackets = |n| format!("{}x{}", "(".repeat(n), ")".repeat(n));
        assert!(!is_too_deep(&brackets(100)));
        assert!(is_too_deep(&brackets(1000)));
        assert!(is_too_deep(&"-".repeat(LIMIT)));
        assert!(is_too_deep(&format!("x{}", "[0]".repeat(LIMIT))));
        assert!(is_too_deep(&format!("x{}", " as f64".repeat(LIMIT))));
        assert!(is_too_deep(&"return ".repeat(LIMIT)));
        assert!(!is_too_deep(&format!(
            "x{}",
            " + k[0] * ln(x)".repeat(1900)
        )));
    }

    #[test]
    fn statements_and_arguments_start_anew() {
        assert!(!is_too_deep(&"let y = x + x + x; ".repeat(LIMIT)));
        assert!(!is_too_deep(&"x + x + x, ".repeat(LIMIT)));
    }
}
