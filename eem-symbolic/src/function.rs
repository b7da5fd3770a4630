//! The table of elementary functions: one row per function, and a rule for every function in every column.

use crate::graph::Graph;
use crate::node::ExprId;
use crate::number::{Number, Rational};

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

    /// `f′(x)`, in a form that keeps its relative accuracy wherever `f′` is well conditioned.
    pub(crate) fn derivative(self, graph: &mut Graph, x: ExprId) -> ExprId {
        match self {
            Function::Exp | Function::ExpM1 => graph.apply(Function::Exp, x),
            Function::Ln => graph.recip(x),
            Function::Ln1p => {
                let shifted = one_plus(graph, x);
                graph.recip(shifted)
            }
            Function::Log2 => logarithm_derivative(graph, x, 2),
            Function::Log10 => logarithm_derivative(graph, x, 10),
            Function::Sin => graph.apply(Function::Cos, x),
            Function::Cos => {
                let sine = graph.apply(Function::Sin, x);
                graph.neg(sine)
            }
            Function::Tan => {
                let tangent = graph.apply(Function::Tan, x);
                let square = graph.powi(tangent, 2);
                one_plus(graph, square)
            }
            Function::Sinh => graph.apply(Function::Cosh, x),
            Function::Cosh => graph.apply(Function::Sinh, x),
            // 1 − tanh² cancels for large arguments, 1/cosh² does not.
            Function::Tanh => {
                let cosine = graph.apply(Function::Cosh, x);
                graph.powi(cosine, -2)
            }
            Function::Asinh => {
                let square = graph.powi(x, 2);
                let radicand = one_plus(graph, square);
                let root = graph.sqrt(radicand);
                graph.recip(root)
            }
            Function::Atan => {
                let square = graph.powi(x, 2);
                let denominator = one_plus(graph, square);
                graph.recip(denominator)
            }
            Function::Atanh => atanh_derivative(graph, x),
            Function::Cbrt => {
                let root = graph.apply(Function::Cbrt, x);
                let power = graph.powi(root, -2);
                graph.scale(Number::ONE / Number::from(3_i64), power)
            }
            Function::Abs => {
                let magnitude = graph.apply(Function::Abs, x);
                graph.div(x, magnitude)
            }
        }
    }
}

/// `1 + x`.
fn one_plus(graph: &mut Graph, x: ExprId) -> ExprId {
    graph.weighted_sum(Number::ONE, &[(Number::ONE, x)])
}

/// `1/(x ln base)`; the logarithm stays symbolic, so that no digits of it are lost.
fn logarithm_derivative(graph: &mut Graph, x: ExprId, base: i64) -> ExprId {
    let base = graph.integer(base);
    let scale = graph.apply(Function::Ln, base);
    graph.power_product(&[(x, Rational::MINUS_ONE), (scale, Rational::MINUS_ONE)])
}

/// `1/((1 − x)(1 + x))`; the expanded form `1 − x²` loses digits next to ±1.
fn atanh_derivative(graph: &mut Graph, x: ExprId) -> ExprId {
    let above = one_plus(graph, x);
    let below = graph.weighted_sum(Number::ONE, &[(Number::MINUS_ONE, x)]);
    graph.power_product(&[(above, Rational::MINUS_ONE), (below, Rational::MINUS_ONE)])
}
