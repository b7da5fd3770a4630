//! Quotes an expression in a message, on one line and not too long.

use proc_macro2::{Delimiter, TokenStream, TokenTree};
use quote::ToTokens;

/// Characters of a quotation.
const LONGEST: usize = 48;

/// The expression as a person would write it; the middle of a long one is left out.
pub(crate) fn excerpt(expr: &syn::Expr) -> String {
    let mut text = String::new();
    write(expr.to_token_stream(), &mut text);
    let length = text.chars().count();
    if length <= LONGEST {
        return text;
    }
    let half = LONGEST / 2 - 1;
    let start: String = text.chars().take(half).collect();
    let end: String = text.chars().skip(length - half).collect();
    format!("{} … {}", start.trim_end(), end.trim_start())
}

fn write(tokens: TokenStream, text: &mut String) {
    // Whether an operator here has an operand on its left.
    let mut operand = false;
    for token in tokens {
        match token {
            TokenTree::Group(group) => {
                let (open, close) = match group.delimiter() {
                    Delimiter::Parenthesis => ("(", ")"),
                    Delimiter::Bracket => ("[", "]"),
                    Delimiter::Brace => ("{ ", " }"),
                    Delimiter::None => ("", ""),
                };
                text.push_str(open);
                write(group.stream(), text);
                text.push_str(close);
                operand = true;
            }
            TokenTree::Punct(punct) => {
                match punct.as_char() {
                    '.' => text.push('.'),
                    c @ (',' | ';') => {
                        text.push(c);
                        text.push(' ');
                    }
                    c if operand => {
                        text.push(' ');
                        text.push(c);
                        text.push(' ');
                    }
                    c => text.push(c),
                }
                operand = false;
            }
            TokenTree::Ident(ident) if ident == "let" => text.push_str("let "),
            other => {
                text.push_str(&other.to_string());
                operand = true;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::excerpt;

    fn quoted(text: &str) -> String {
        excerpt(&syn::parse_str(text).unwrap())
    }

    #[test]
    fn formulas_are_quoted_as_they_are_written() {
        for formula in [
            "-k * (lambda - length).powi(2)",
            "a / -b + ln(x / y)",
            "diff(psi, lambda)",
            "{ let x = -1; x.powf(2.5) }",
        ] {
            assert_eq!(quoted(formula), formula);
        }
    }

    #[test]
    fn long_formulas_lose_their_middle() {
        let sum = (0..40).map(|i| format!("x{i}")).collect::<Vec<_>>();
        let text = quoted(&sum.join(" + "));
        assert!(text.starts_with("x0 + x1") && text.ends_with("x39") && text.contains(" … "));
    }
}
