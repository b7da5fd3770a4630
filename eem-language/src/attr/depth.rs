//! Limits how deeply a formula is nested, so that reading it does not exhaust the stack of the compiler.
//!
//! Reading is recursive, here and in `syn`: every operator of a chain and every pair of brackets is a level. The levels are
//! counted in the tokens, before anything recursive sees them. A sum is a chain that leans to the left, `((a + b) + c) + d`:
//! each of its terms is at most as many levels deep as the sum has signs, whatever the terms before it contain. The same holds
//! for the factors of a term.

use proc_macro2::{Ident, Span, TokenStream, TokenTree};

/// Levels that a formula may have. Twice as many still fit the 8 MiB of the compiler's threads in a
/// debug build, if the levels are operators between two values.
pub(super) const LIMIT: usize = 4000;
/// The same for a text, which a program may get from anybody: types in it need more stack than operators.
pub(super) const LIMIT_OF_TEXT: usize = LIMIT / 4;

/// Levels that a pair of brackets counts for: the functions of the parser between two expressions.
const BRACKETS: usize = 20;
/// Levels that a sign or a method counts for.
const PREFIX: usize = 2;

/// Why a formula is too deep.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Excess {
    /// A sum of this many terms.
    Terms(usize),
    /// Brackets, signs and other operators inside of one another.
    Nesting,
}

/// The place where the tokens become too deep, and why.
pub(super) fn too_deep(tokens: TokenStream, limit: usize) -> Option<(Span, Excess)> {
    // Groups that are yet to be looked into, with the level at which they stand.
    let mut pending = vec![(tokens, 0)];
    while let Some((tokens, outside)) = pending.pop() {
        let tokens: Vec<_> = tokens.into_iter().collect();
        // The next statement or argument starts at the level outside.
        for part in tokens.split(|token| is_punct(token, &[';', ','])) {
            let signs = signs(part);
            if let Some(last) = part.last().filter(|_| signs > limit) {
                return Some((last.span(), Excess::Terms(signs + 1)));
            }
            if let Some(span) = part_too_deep(part, (outside + signs, limit), &mut pending) {
                return Some((span, Excess::Nesting));
            }
        }
    }
    None
}

/// The binary signs of a statement or an argument.
fn signs(part: &[TokenTree]) -> usize {
    let mut before = Before::Operator;
    let mut signs = 0;
    for token in part {
        signs += usize::from(before != Before::Operator && is_punct(token, &['+', '-']));
        before = Before::from(token);
    }
    signs
}

/// The place where a statement or an argument that begins at a level becomes too deep; its groups become pending.
fn part_too_deep(
    part: &[TokenTree],
    (start, limit): (usize, usize),
    pending: &mut Vec<(TokenStream, usize)>,
) -> Option<Span> {
    // Levels of all that follows, of the term, and of the factor.
    let (mut outer, mut term, mut factor) = (start, 0, 0);
    let mut before = Before::Operator;
    for token in part {
        let level = outer + term + factor;
        if level > limit {
            return Some(token.span());
        }
        match token {
            TokenTree::Group(group) => {
                // `x[0][1]`, `f(x)(y)`
                if before == Before::Group {
                    factor += PREFIX;
                }
                pending.push((group.stream(), outer + term + factor + BRACKETS));
            }
            TokenTree::Punct(punct) => match (punct.as_char(), before) {
                // Counted in `start`.
                ('+' | '-', Before::Word | Before::Group) => (term, factor) = (0, 0),
                ('*' | '/', Before::Word | Before::Group) => {
                    term += 1;
                    factor = 0;
                }
                ('.', Before::Word | Before::Group) | ('-' | '!' | '*' | '&', Before::Operator) => {
                    factor += PREFIX;
                }
                (_, Before::Operator) => outer += PREFIX,
                (_, Before::Word | Before::Group) => outer += 1,
            },
            // `return x`, `x as f64`: a whole expression may follow.
            TokenTree::Ident(ident) if is_keyword(ident) => outer += BRACKETS,
            TokenTree::Ident(_) | TokenTree::Literal(_) => {
                outer += if before == Before::Operator {
                    0
                } else {
                    BRACKETS
                };
            }
        }
        before = Before::from(token);
    }
    None
}

fn is_punct(token: &TokenTree, characters: &[char]) -> bool {
    matches!(token, TokenTree::Punct(punct) if characters.contains(&punct.as_char()))
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
            // A sign behind it belongs to one value.
            TokenTree::Ident(ident) if is_keyword(ident) => Self::Operator,
            TokenTree::Ident(_) | TokenTree::Literal(_) => Self::Word,
            TokenTree::Group(_) => Self::Group,
        }
    }
}

/// Whether a word begins or joins expressions or types, and is no value.
fn is_keyword(ident: &Ident) -> bool {
    const KEYWORDS: [&str; 26] = [
        "as", "async", "await", "become", "box", "break", "const", "do", "dyn", "else", "fn",
        "for", "if", "in", "let", "loop", "match", "move", "mut", "raw", "ref", "return", "static",
        "unsafe", "while", "yield",
    ];
    KEYWORDS.iter().any(|keyword| ident == keyword)
}

#[cfg(test)]
mod tests {
    use super::{Excess, LIMIT, LIMIT_OF_TEXT, too_deep};
    use proc_macro2::TokenStream;

    fn excess(text: &str) -> Option<Excess> {
        let tokens: TokenStream = text.parse().expect("the text is made of tokens");
        too_deep(tokens, LIMIT).map(|(_, excess)| excess)
    }

    fn is_too_deep(text: &str) -> bool {
        excess(text).is_some()
    }

    #[test]
    fn chains_and_brackets_are_counted() {
        assert!(!is_too_deep(&format!("x{}", " + x".repeat(LIMIT))));
        let sum = format!("x{}", " + x".repeat(2 * LIMIT));
        assert_eq!(excess(&sum), Some(Excess::Terms(2 * LIMIT + 1)));
        assert!(is_too_deep(&format!("x{}", " * x".repeat(2 * LIMIT))));
        let brackets = |n| format!("{}x{}", "(".repeat(n), ")".repeat(n));
        assert!(!is_too_deep(&brackets(100)));
        assert_eq!(excess(&brackets(1000)), Some(Excess::Nesting));
        assert!(is_too_deep(&"-".repeat(LIMIT)));
        assert!(is_too_deep(&format!("x{}", "[0]".repeat(LIMIT))));
        assert!(is_too_deep(&format!("x{}", " as f64".repeat(LIMIT))));
        assert!(is_too_deep(&"return ".repeat(LIMIT)));
        // One inside of the other, whatever the signs in between.
        assert!(is_too_deep(&"return *x * return -x + ".repeat(LIMIT / 20)));
        assert!(is_too_deep(&"|x| x + ".repeat(LIMIT / 2)));
        assert!(is_too_deep(&format!("x{}", " = x + x".repeat(LIMIT))));
    }

    #[test]
    fn sums_inside_of_one_another_are_added() {
        let sum = " + x".repeat(LIMIT / 3);
        let sum = |inner: &str| format!("(({inner}) * 2{sum})");
        assert!(!is_too_deep(&sum(&sum("x"))));
        assert!(is_too_deep(&sum(&sum(&sum("x")))));
    }

    #[test]
    fn what_terms_and_factors_contain_is_not_added() {
        let term = " + k[0] * ln(x / 2).powi(2) * -(x - 1)";
        for count in [LIMIT_OF_TEXT - 50, LIMIT - 50] {
            assert!(!is_too_deep(&format!("x{}", term.repeat(count))));
        }
        let factor = " * ln(x / 2).powi(2)";
        assert!(!is_too_deep(&format!("x{}", factor.repeat(LIMIT - 50))));
    }

    #[test]
    fn statements_and_arguments_start_anew() {
        assert!(!is_too_deep(&"let y = x + x + x; ".repeat(LIMIT)));
        assert!(!is_too_deep(&"x + x + x, ".repeat(LIMIT)));
    }
}
