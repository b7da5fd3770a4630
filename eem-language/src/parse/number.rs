//! Literals, read exactly.

use eem_symbolic::{Number, Rational};
use syn::Lit;

use crate::ast::ExprKind;
use crate::ctxt::Ctxt;
use crate::message::expression::{self as message, syntax};

/// The number types of Rust that a literal may not have as its suffix.
const RUST_NUMBERS: [&str; 14] = [
    "f32", "f16", "i8", "i16", "i32", "i64", "i128", "isize", "u8", "u16", "u32", "u64", "u128",
    "usize",
];

/// The value of a numeric literal; reports every other literal.
pub(super) fn literal<'a>(cx: &Ctxt, literal: &Lit) -> ExprKind<'a> {
    let (digits, suffix) = match literal {
        Lit::Int(int) => (int.base10_digits(), int.suffix()),
        Lit::Float(float) => (float.base10_digits(), float.suffix()),
        other => {
            cx.error(other, &syntax::not_allowed(kind(other)));
            return ExprKind::Wrong(Vec::new());
        }
    };
    if RUST_NUMBERS.contains(&suffix) {
        cx.error(literal, &message::number_suffix(suffix));
    } else if !matches!(suffix, "" | "f64") {
        cx.error(literal, &message::number_and_name(digits, suffix));
        return ExprKind::Wrong(Vec::new());
    }
    if let Some(number) = number(digits) {
        return ExprKind::Number(number);
    }
    cx.error(literal, &message::number_out_of_range());
    ExprKind::Wrong(Vec::new())
}

/// The value of decimal digits: exact if 128-bit rationals can hold it, else the nearest `f64`.
fn number(digits: &str) -> Option<Number> {
    if let Some(rational) = Rational::parse_decimal(digits) {
        return Some(Number::Exact(rational));
    }
    let float: f64 = digits.parse().ok()?;
    // `1e-999` is not zero: an exact zero has been read above.
    float.is_normal().then_some(Number::Float(float))
}

fn kind(literal: &Lit) -> &'static str {
    match literal {
        Lit::Bool(_) => "a truth value",
        Lit::Char(_) | Lit::Byte(_) => "a character",
        _ => "a string",
    }
}
