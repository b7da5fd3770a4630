//! The table of elementary functions: one row per function.
//!
//! Their derivatives are in [`derivative`](crate::derivative).

use crate::number::Number;

/// An elementary function of one real argument.
///
/// The methods match exhaustively: a function without a derivative does not compile.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Function {
    /// `eˣ`.
    Exp,
    /// `eˣ − 1`.
    ExpM1,
    /// Natural logarithm.
    Ln,
    /// `ln(1 + x)`.
    Ln1p,
    /// Logarithm to base 2.
    Log2,
    /// Logarithm to base 10.
    Log10,
    /// Sine.
    Sin,
    /// Cosine.
    Cos,
    /// Tangent.
    Tan,
    /// Hyperbolic sine.
    Sinh,
    /// Hyperbolic cosine.
    Cosh,
    /// Hyperbolic tangent.
    Tanh,
    /// Inverse hyperbolic sine.
    Asinh,
    /// Inverse tangent.
    Atan,
    /// Inverse hyperbolic tangent.
    Atanh,
    /// Cube root, odd.
    Cbrt,
    /// `|x|`. Not differentiable at 0, where derivative and divided difference are NaN.
    Abs,
}

impl Function {
    /// Every function, in the order of the enumeration.
    pub const ALL: &'static [Function] = &[
        Function::Exp,
        Function::ExpM1,
        Function::Ln,
        Function::Ln1p,
        Function::Log2,
        Function::Log10,
        Function::Sin,
        Function::Cos,
        Function::Tan,
        Function::Sinh,
        Function::Cosh,
        Function::Tanh,
        Function::Asinh,
        Function::Atan,
        Function::Atanh,
        Function::Cbrt,
        Function::Abs,
    ];

    /// Name of the method of `f64`: `"exp_m1"`, `"ln_1p"`, …
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Function::Exp => "exp",
            Function::ExpM1 => "exp_m1",
            Function::Ln => "ln",
            Function::Ln1p => "ln_1p",
            Function::Log2 => "log2",
            Function::Log10 => "log10",
            Function::Sin => "sin",
            Function::Cos => "cos",
            Function::Tan => "tan",
            Function::Sinh => "sinh",
            Function::Cosh => "cosh",
            Function::Tanh => "tanh",
            Function::Asinh => "asinh",
            Function::Atan => "atan",
            Function::Atanh => "atanh",
            Function::Cbrt => "cbrt",
            Function::Abs => "abs",
        }
    }

    /// The function whose [`name`](Function::name) is `name`.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Function> {
        Function::ALL
            .iter()
            .copied()
            .find(|function| function.name() == name)
    }

    /// The value where it is an exact number; everything else stays symbolic.
    pub(crate) fn exact_value(self, argument: Number) -> Option<Number> {
        let (zero, one) = (argument.is_zero(), argument == Number::ONE);
        match self {
            Function::Exp | Function::Cos | Function::Cosh => zero.then_some(Number::ONE),
            Function::Ln | Function::Log2 | Function::Log10 => one.then_some(Number::ZERO),
            Function::ExpM1
            | Function::Ln1p
            | Function::Sin
            | Function::Tan
            | Function::Sinh
            | Function::Tanh
            | Function::Asinh
            | Function::Atan
            | Function::Atanh => zero.then_some(Number::ZERO),
            Function::Cbrt => (zero || one || argument == Number::MINUS_ONE).then_some(argument),
            Function::Abs => Some(argument.abs()),
        }
    }
}
